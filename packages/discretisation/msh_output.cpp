#include "discretisation/msh_output.hpp"

#include <array>
#include <fstream>
#include <iomanip>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/run_error.hpp"
#include "discretisation/mesh_topology.hpp"
#include "discretisation/msh_element.hpp"

namespace mudline {

namespace {

constexpr int point_type = 15;

/// The number that Gmsh gives to elements of a shape with so many nodes.
int type_of(CellShape shape, int nodes) {
  constexpr int complete = 19;  // numbers up to here are of the elements of first and second order
  for (int type = 1; type <= complete; ++type) {
    const MshElement& element = *msh_element(type);
    if (element.dimension == dimension(shape) && element.nodes == nodes && element.corners == num_corners(shape))
      return type;
  }
  throw std::logic_error(std::string("Gmsh has no elements for cells of ") + name(shape));
}

/// The physical groups of a file and the elements in them. An element of two sets is written twice.
class Groups {
 public:
  void open(int dimension, const std::string& name) { groups_.push_back({dimension, name}); }
  /// An element of the group that was opened last, with its nodes in the order of `shape`.
  void add(CellShape shape, const std::vector<int>& nodes) {
    const int type = type_of(shape, static_cast<int>(nodes.size()));
    const std::vector<int> order = order_of_nodes(type, shape);
    std::vector<int> in_file(nodes.size());
    for (std::size_t a = 0; a < nodes.size(); ++a) in_file[order[a]] = nodes[a];
    elements_.push_back({type, static_cast<int>(groups_.size()), std::move(in_file)});
  }
  void add_point(int node) { elements_.push_back({point_type, static_cast<int>(groups_.size()), {node}}); }

  void write(std::ostream& out) const {
    out << "$PhysicalNames\n" << groups_.size() << '\n';
    for (std::size_t k = 0; k < groups_.size(); ++k)
      out << groups_[k].first << ' ' << k + 1 << " \"" << groups_[k].second << "\"\n";
    out << "$EndPhysicalNames\n";
  }
  void write_elements(std::ostream& out) const {
    out << "$Elements\n" << elements_.size() << '\n';
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      const Element& element = elements_[k];
      out << k + 1 << ' ' << element.type << " 2 " << element.group << ' ' << element.group;
      for (int node : element.nodes) out << ' ' << node + 1;
      out << '\n';
    }
    out << "$EndElements\n";
  }

 private:
  struct Element {
    int type, group;
    std::vector<int> nodes;
  };
  std::vector<std::pair<int, std::string>> groups_;  // dimension, name; numbers from 1
  std::vector<Element> elements_;
};

}  // namespace

void write_msh(const Mesh& mesh, const Kokkos::View<const double**, Kokkos::LayoutRight>& x, const std::string& path) {
  Groups groups;
  for (const std::string& region : mesh.regions()) {
    groups.open(mesh.dimension(), region);
    for (const ElementBlock& block : mesh.blocks())
      for (int e = 0; block.region == region && e < block.num_elements; ++e) {
        std::vector<int> nodes;
        for (int a = 0; a < num_nodes(block.shape); ++a) nodes.push_back(block.nodes(e, a));
        groups.add(block.shape, nodes);
      }
  }
  for (const auto& [name, sides] : mesh.side_sets()) {
    groups.open(mesh.dimension() - 1, name);
    for (const Side& side : sides) {
      const ElementBlock& block = mesh.blocks()[side.block];
      std::vector<int> nodes;
      for (int a : side_nodes(block.shape, side.side)) nodes.push_back(block.nodes(side.element, a));
      groups.add(side_shape(block.shape, side.side), nodes);
    }
  }
  for (const auto& [name, nodes] : mesh.node_sets()) {
    groups.open(0, name);
    for (int node : nodes) groups.add_point(node);
  }
  std::ofstream out(path);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" << std::setprecision(std::numeric_limits<double>::max_digits10);
  groups.write(out);
  out << "$Nodes\n" << mesh.num_nodes() << '\n';
  for (int node = 0; node < mesh.num_nodes(); ++node) {
    std::array<double, 3> place{};
    for (int d = 0; d < mesh.dimension(); ++d) place[d] = x(node, d);
    out << node + 1 << ' ' << place[0] << ' ' << place[1] << ' ' << place[2] << '\n';
  }
  out << "$EndNodes\n";
  groups.write_elements(out);
  if (!out.flush()) throw RunError("'" + path + "' cannot be written");
}

}  // namespace mudline
