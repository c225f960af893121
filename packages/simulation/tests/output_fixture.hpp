#pragma once

// Fixtures of the tests of output files: a temporary folder, and a small mesh of both quadratic shapes.
#include <gtest/gtest.h>
#include <hdf5.h>
#include <unistd.h>
#include <Teuchos_DefaultMpiComm.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "discretisation/mesh.hpp"

namespace mudline::output_test {

inline Teuchos::RCP<const Teuchos::Comm<int>> world() {
  return Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_WORLD));
}

/// A folder that all ranks of the test share and rank 0 removes.
class Folder {
 public:
  Folder() {
    int process = static_cast<int>(getpid());
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Bcast(&process, 1, MPI_INT, 0, MPI_COMM_WORLD);
    path_ = std::filesystem::temp_directory_path() / ("mudline_output_" + std::to_string(process));
    if (rank_ == 0) std::filesystem::create_directories(path_);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  ~Folder() {
    MPI_Barrier(MPI_COMM_WORLD);
    std::error_code ignored;
    if (rank_ == 0) std::filesystem::remove_all(path_, ignored);
  }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  int rank_ = 0;
  std::filesystem::path path_;
};

inline std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// `columns` x 2 quad9 in the region "clay" and, right of them, two tri6 in "sand"; on [0, columns + 1] x [0, 2].
inline GlobalMesh two_shapes(int columns) {
  GlobalMesh mesh;
  const int nx = 2 * (columns + 1) + 1, ny = 5;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) mesh.coordinates.push_back({0.5 * i, 0.5 * j});
  const auto node = [&](int i, int j) { return static_cast<long long>(j * nx + i); };
  GlobalMesh::Block clay{"clay", CellShape::quad9, {}}, sand{"sand", CellShape::tri6, {}};
  for (int b = 0; b < ny - 1; b += 2) {
    for (int a = 0; a < 2 * columns; a += 2)
      for (auto [i, j] : {std::pair{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}, {1, 1}})
        clay.nodes.push_back(node(a + i, b + j));
    const int a = 2 * columns;
    for (auto [i, j] : {std::pair{0, 0}, {2, 0}, {2, 2}, {1, 0}, {2, 1}, {1, 1}})
      sand.nodes.push_back(node(a + i, b + j));
    for (auto [i, j] : {std::pair{0, 0}, {2, 2}, {0, 2}, {1, 1}, {1, 2}, {0, 1}})
      sand.nodes.push_back(node(a + i, b + j));
  }
  mesh.blocks = {clay, sand};
  return mesh;
}

/// One hex8 with sides 1.
inline GlobalMesh cube() {
  GlobalMesh mesh;
  for (const double z : {0.0, 1.0})
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
      mesh.coordinates.push_back({x, y, z});
  mesh.blocks = {{"clay", CellShape::hex8, {0, 1, 2, 3, 4, 5, 6, 7}}};
  return mesh;
}

/// Coordinates (owned node, axis) and a value per owned node or element that depends on its global id only.
inline std::vector<double> owned_coordinates(const Mesh& mesh) {
  std::vector<double> values;
  for (int n = 0; n < mesh.num_owned_nodes(); ++n)
    for (int i = 0; i < mesh.dimension(); ++i) values.push_back(mesh.coordinates()(n, i));
  return values;
}
template <class F>
std::vector<double> by_node(const Mesh& mesh, int components, F&& value) {
  std::vector<double> values;
  for (int n = 0; n < mesh.num_owned_nodes(); ++n)
    for (int c = 0; c < components; ++c) values.push_back(value(mesh.node_ids()[n], c));
  return values;
}
template <class F>
std::vector<double> by_element(const Mesh& mesh, int components, F&& value) {
  std::vector<double> values;
  for (const auto& block : mesh.blocks())
    for (long long id : block.global_ids)
      for (int c = 0; c < components; ++c) values.push_back(value(id, c));
  return values;
}

/// Reads a dataset of a file through the plain serial driver, as any other program would.
inline std::vector<double> dataset(const std::string& path, const std::string& name) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) return {};
  const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
  std::vector<double> values;
  if (set >= 0) {
    const hid_t space = H5Dget_space(set);
    values.resize(H5Sget_simple_extent_npoints(space));
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(set);
  }
  H5Fclose(file);
  return values;
}

/// The numbers of an attribute of an object.
inline std::vector<double> attribute(const std::string& path, const std::string& object, const std::string& name) {
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) return {};
  const hid_t place = H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  std::vector<double> values;
  if (place >= 0) {
    const hid_t space = H5Aget_space(place);
    values.resize(H5Sget_simple_extent_npoints(space));
    H5Aread(place, H5T_NATIVE_DOUBLE, values.data());
    H5Sclose(space);
    H5Aclose(place);
  }
  H5Fclose(file);
  return values;
}

/// The message of the exception of type E that `call` throws, or a text that no test expects.
template <class E, class F>
std::string message_of(F&& call) {
  try {
    call();
  } catch (const E& error) {
    return error.what();
  } catch (const std::exception& error) {
    return std::string("another exception: ") + error.what();
  }
  return "no exception";
}

}  // namespace mudline::output_test
