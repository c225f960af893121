#pragma once

// Functions that the mesh tests share: a mesh from the text of a deck, and sums over its elements and sides.
#include <Teuchos_DefaultMpiComm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/deck.hpp"
#include "core/tests/input_error.hpp"
#include "discretisation/compiled_shapes.hpp"
#include "discretisation/element_map.hpp"
#include "discretisation/mesh.hpp"
#include "discretisation/mesh_topology.hpp"
#include "discretisation/side_map.hpp"

namespace mudline::mesh_test {

inline Teuchos::RCP<const Teuchos::Comm<int>> world() {
  return Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_WORLD));
}

inline std::string parameter(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
}

/// The section "mesh" with the given entries, in a deck in the folder of the test data.
inline Section mesh_section(const std::string& entries) {
  Deck deck;
  deck.overlay(
      "<ParameterList name=\"deck\"><ParameterList name=\"mesh\">" + entries + "</ParameterList></ParameterList>",
      std::string(MUDLINE_SOURCE_DIR) + "/packages/discretisation/tests/data/deck.xml");
  static std::vector<std::shared_ptr<Deck>> alive;  // a section refers to its deck's data
  alive.push_back(std::make_shared<Deck>(deck));
  return alive.back()->root().section("mesh");
}

inline std::unique_ptr<Mesh> make(const std::string& entries) {
  Registry<MeshSource> sources("mesh source");
  register_mesh_sources(sources);
  return make_mesh(world(), sources, mesh_section(entries));
}

inline std::string box(const std::string& cell, int nx, int ny, const std::string& more = "") {
  return parameter("type", "string", "box") + parameter("cell", "string", cell) +
         parameter("cells", "Array(int)", "{" + std::to_string(nx) + ", " + std::to_string(ny) + "}") +
         parameter("upper", "Array(double)", "{2.0, 1.0}") + more;
}

inline std::string gmsh(const std::string& file, const std::string& more = "") {
  return parameter("type", "string", "gmsh") + parameter("file", "string", file) + more;
}

/// Entries of a box mesh in space, 2 x 1 x 1.5.
inline std::string box3(const std::string& cell, int nx, int ny, int nz, const std::string& more = "") {
  return parameter("type", "string", "box") + parameter("geometry", "string", "three-dimensional") +
         parameter("cell", "string", cell) +
         parameter("cells", "Array(int)",
                   "{" + std::to_string(nx) + ", " + std::to_string(ny) + ", " + std::to_string(nz) + "}") +
         parameter("upper", "Array(double)", "{2.0, 1.0, 1.5}") + more;
}

inline std::string gmsh3(const std::string& file, const std::string& more = "") {
  return gmsh(file, parameter("geometry", "string", "three-dimensional") + more);
}

inline ElementMap map_of(const Mesh& mesh, const ElementBlock& block, int element) {
  return {block.shape, [&](int a) { return &mesh.coordinates()(block.nodes(element, a), 0); }};
}

/// Area or volume of this rank's elements, only of `region` when it is named.
inline double area(const Mesh& mesh, const std::string& region = "") {
  double sum = 0;
  for (const ElementBlock& block : mesh.blocks()) {
    if (!region.empty() && block.region != region) continue;
    const QuadratureRule rule = cell_quadrature(block.shape, 5);
    for (int e = 0; e < block.num_elements; ++e) {
      const ElementMap map = map_of(mesh, block, e);
      for (std::size_t q = 0; q < rule.points.size(); ++q)
        sum += rule.weights[q] * map.determinant(rule.points[q].data());
    }
  }
  return sum;
}

template <int Dim>
void add_side(const Mesh& mesh, const Side& side, std::array<double, 4>& sum) {
  const ElementBlock& block = mesh.blocks()[side.block];
  const std::vector<int> nodes = side_nodes(block.shape, side.side);
  const CellShape own = side_shape(block.shape, side.side);
  const QuadratureRule rule = cell_quadrature(own, own == CellShape::line2 || own == CellShape::line3 ? 9 : 6);
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    double N[9], dN[18];
    evaluate_shape(own, rule.points[q].data(), N, dN);
    SideMap<Dim> map;
    map.compute(static_cast<int>(nodes.size()), N, dN,
                [&](int a, int i) { return mesh.coordinates()(block.nodes(side.element, nodes[a]), i); });
    sum[0] += rule.weights[q] * map.stretch;
    for (int i = 0; i < Dim; ++i) sum[1 + i] += rule.weights[q] * map.normal[i];
  }
}

/// Integrals over this rank's sides of a set: length or area, and the outward normal.
inline std::array<double, 4> side_integral(const Mesh& mesh, const std::string& set) {
  std::array<double, 4> sum{};
  for (const Side& side : mesh.side_sets().at(set))
    mesh.dimension() == 2 ? add_side<2>(mesh, side, sum) : add_side<3>(mesh, side, sum);
  return sum;
}

template <int Dim, int N>
double gradient_error_of(const Mesh& mesh, const ElementBlock& block) {
  const double slope[3] = {0.7, -0.3, 0.4};
  const ShapeTable table = tabulate(block.shape, cell_quadrature(block.shape, 4));
  double worst = 0;
  for (int e = 0; e < block.num_elements; ++e) {
    double x[N][Dim], u[N] = {}, g[N][Dim];
    for (int a = 0; a < N; ++a)
      for (int i = 0; i < Dim; ++i) {
        x[a][i] = mesh.coordinates()(block.nodes(e, a), i);
        u[a] += slope[i] * x[a][i];
      }
    for (int q = 0; q < table.points; ++q) {
      CellMap<Dim> map;
      map.compute(x, &table.dN(q, 0, 0));
      map.gradients(&table.dN(q, 0, 0), g);
      for (int i = 0; i < Dim; ++i) {
        double sum = 0;
        for (int a = 0; a < N; ++a) sum += g[a][i] * u[a];
        worst = std::max(worst, std::abs(sum - slope[i]));
      }
    }
  }
  return worst;
}

/// The largest error of the gradient of a linear field that is interpolated on a mesh in space.
inline double gradient_error(const Mesh& mesh) {
  double worst = 0;
  for (const ElementBlock& block : mesh.blocks())
    with_node_counts<void>(SpaceCells{}, num_nodes(block.shape), [&](auto counts) {
      worst = std::max(worst, gradient_error_of<3, decltype(counts)::nodes>(mesh, block));
    });
  return worst;
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The error message of check_seams(), or "".
inline std::string seams(const GlobalMesh& mesh, const std::vector<std::string>& cracks = {}) {
  try {
    check_seams(mesh, cracks);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace mudline::mesh_test

#define EXPECT_CONTAINS(text, part) EXPECT_TRUE(mudline::mesh_test::contains(text, part)) << text
