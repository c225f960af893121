#include "simulation/output/field_layout.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/errors.hpp"
#include "discretisation/cells/cell.hpp"

namespace mudline::field_layout {

namespace {

/// Reorders columns as XDMF wants them: z = 0 for plane vectors, tensors from xx yy zz yz xz xy to xx xy xz yy yz zz.
std::vector<double> stored_columns(const std::vector<double>& values, int components) {
  static constexpr int tensor_source[6] = {0, 5, 4, 1, 3, 2};
  if (components == 1 || components == 3) return values;
  const int columns = stored_components(components);
  const std::size_t rows = values.size() / components;
  std::vector<double> result(rows * columns, 0.0);
  for (std::size_t row = 0; row < rows; ++row)
    for (int c = 0; c < components; ++c)
      result[row * columns + c] = values[row * components + (components == 6 ? tensor_source[c] : c)];
  return result;
}

constexpr int before_nodes = 3;

/// Length of an element's row as it is sent to its slab: numbers of its cell in XDMF and in VTK, region, then its
/// nodes, filled up with -1.
int row_width(const Mesh& mesh) {
  int nodes = 0;
  for (const auto& block : mesh.blocks()) nodes = std::max(nodes, num_nodes(block.shape));
  return before_nodes + nodes;
}

std::vector<long long> element_rows(const Mesh& mesh) {
  const int max_nodes = row_width(mesh) - before_nodes;
  std::vector<long long> rows;
  for (const auto& block : mesh.blocks()) {
    const int count = num_nodes(block.shape);
    const auto nodes = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), block.nodes);
    const auto& regions = mesh.regions();
    const long long region = std::find(regions.begin(), regions.end(), block.region) - regions.begin();
    for (int e = 0; e < block.num_elements; ++e) {
      rows.push_back(cell(block.shape).xdmf);
      rows.push_back(cell(block.shape).vtk);
      rows.push_back(region);
      for (int i = 0; i < max_nodes; ++i) rows.push_back(i < count ? mesh.node_ids()[nodes(e, i)] : -1);
    }
  }
  return rows;
}

}  // namespace

std::vector<long long> element_ids(const Mesh& mesh) {
  std::vector<long long> ids;
  for (const auto& block : mesh.blocks()) ids.insert(ids.end(), block.global_ids.begin(), block.global_ids.end());
  return ids;
}

std::vector<long long> owned_ids(const Mesh& mesh) {
  return {mesh.node_ids().begin(), mesh.node_ids().begin() + mesh.num_owned_nodes()};
}

int stored_components(int components) { return components == 2 ? 3 : components; }

h5::Handle write_rows(hid_t parent, const std::string& name, const std::vector<double>& values, int components,
                      const IdOrder& order) {
  const int columns = stored_components(components);
  const h5::Slab slab{hsize_t(order.global_count()), hsize_t(columns == 1 ? 0 : columns), hsize_t(order.first()),
                      hsize_t(order.count())};
  return h5::write(parent, name, stored_columns(order.gather(values, components), components), slab);
}

FileSize mesh_size(const Mesh& mesh) {
  FileSize size{3 * sizeof(double) * mesh.num_owned_nodes(), 9};
  for (const auto& block : mesh.blocks())
    size.bytes += 2 * (row_width(mesh) + 2) * sizeof(long long) * block.num_elements;
  for (const std::string& region : mesh.regions()) size.bytes += region.size() + 1;
  return size;
}

long long write_mesh(hid_t file, MPI_Comm comm, const Mesh& mesh, const IdOrder& nodes, const IdOrder& elements) {
  const int width = row_width(mesh);
  const std::vector<long long> rows = elements.gather(element_rows(mesh), width);
  std::vector<long long> topology, offsets, connectivity, ends;
  std::vector<int> region;
  std::vector<unsigned char> types;
  for (std::size_t row = 0; row < rows.size(); row += width) {
    offsets.push_back(static_cast<long long>(topology.size()));
    topology.push_back(rows[row]);
    types.push_back(static_cast<unsigned char>(rows[row + 1]));
    region.push_back(static_cast<int>(rows[row + 2]));
    for (int i = before_nodes; i < width && rows[row + i] >= 0; ++i) connectivity.push_back(rows[row + i]);
    topology.insert(topology.end(), connectivity.begin() + (ends.empty() ? 0 : ends.back()), connectivity.end());
    ends.push_back(static_cast<long long>(connectivity.size()));
  }
  const long long length = static_cast<long long>(topology.size());
  long long end = 0, total = 0;
  MPI_Scan(&length, &end, 1, MPI_LONG_LONG, MPI_SUM, comm);
  MPI_Allreduce(&length, &total, 1, MPI_LONG_LONG, MPI_SUM, comm);
  const long long first = end - length, first_node = first - elements.first();
  for (auto& offset : offsets) offset += first;
  for (auto& cell_end : ends) cell_end += first_node;

  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  const hsize_t cells = elements.global_count(), first_cell = elements.first(), own_cells = elements.count();
  const auto group = h5::create_group(file, "mesh");
  const h5::Slab by_element{cells, 0, first_cell, own_cells};
  h5::write(group, "topology", topology, {hsize_t(total), 0, hsize_t(first), hsize_t(length)});
  h5::write(group, "offset", offsets, by_element);
  h5::write(group, "region", region, by_element);
  h5::write_text(group, "region names", join(mesh.regions(), "\n"), rank);
  // the same cells as VTK wants them: the end of each in the nodes of all, after a leading 0
  h5::write(group, "connectivity", connectivity,
            {hsize_t(total) - cells, 0, hsize_t(first_node), hsize_t(connectivity.size())});
  if (rank == 0) ends.insert(ends.begin(), 0);
  h5::write(group, "offsets", ends, {cells + 1, 0, first_cell + (rank == 0 ? 0 : 1), hsize_t(ends.size())});
  h5::write(group, "types", types, by_element);

  std::vector<double> reference;
  const auto coordinates = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), mesh.coordinates());
  for (int n = 0; n < mesh.num_owned_nodes(); ++n)
    for (int d = 0; d < mesh.dimension(); ++d) reference.push_back(coordinates(n, d));
  write_rows(group, "coordinates", reference, mesh.dimension(), nodes);
  return total;
}

}  // namespace mudline::field_layout
