#include "discretisation/mesh_topology.hpp"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "algebra/over_ranks.hpp"
#include "algebra/raw_communicator.hpp"
#include "algebra/types.hpp"
#include "core/told.hpp"
#include "discretisation/disjoint_sets.hpp"
#include "discretisation/side_table.hpp"

namespace mudline {

namespace {

/// For each local node, the lowest global number of a node in its connected part of the whole mesh. Ranks exchange the
/// values at shared nodes until nothing changes.
std::vector<long long> leaders(const Mesh& mesh) {
  using Numbers = Tpetra::Vector<GlobalOrdinal>;
  const std::vector<long long>& ids = mesh.node_ids();
  DisjointSets sets(mesh.num_nodes());
  for (const ElementBlock& block : mesh.blocks())
    for (int e = 0; e < block.num_elements; ++e)
      for (int a = 1; a < num_nodes(block.shape); ++a) sets.join(block.nodes(e, 0), block.nodes(e, a));
  const std::vector<int> piece = sets.leaders();
  std::vector<long long> lowest(ids.size(), mesh.num_global_nodes());  // by piece on this rank

  const auto none = Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid();
  const std::vector<GlobalOrdinal> rows(ids.begin(), ids.end());
  const auto owned = rcp(new Map(none, Teuchos::arrayView(rows.data(), mesh.num_owned_nodes()), 0, mesh.comm()));
  const auto all = rcp(new Map(none, Teuchos::arrayView(rows.data(), mesh.num_nodes()), 0, mesh.comm()));
  const Import import(owned, all);
  Numbers here(all), whole(owned);
  std::vector<long long> found = ids;
  for (;;) {
    bool changed = false;
    for (std::size_t node = 0; node < ids.size(); ++node) {
      long long& leader = lowest[piece[node]];
      if (found[node] >= leader) continue;
      leader = found[node];
      changed = true;
    }
    if (!on_any_rank(*mesh.comm(), changed)) break;
    {
      const auto values = here.getLocalViewHost(Tpetra::Access::OverwriteAll);
      // ABSMAX finds a maximum: the lowest number is the farthest from the end
      for (std::size_t node = 0; node < ids.size(); ++node)
        values(node, 0) = mesh.num_global_nodes() - lowest[piece[node]];
    }
    whole.putScalar(0);
    whole.doExport(here, import, Tpetra::ABSMAX);
    here.doImport(whole, import, Tpetra::INSERT);
    const auto values = here.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t node = 0; node < ids.size(); ++node) found[node] = mesh.num_global_nodes() - values(node, 0);
  }
  for (std::size_t node = 0; node < ids.size(); ++node) found[node] = lowest[piece[node]];
  return found;
}

/// The sides of a set on all ranks, in a common order.
struct SetSides {
  std::vector<long long> keys;  // (side, 4) sorted global numbers of the corners; unused: -1
  std::vector<double> centres;  // (side, 3) mean of the corners [m]
};

SideKey key_of(const Mesh& mesh, const ElementBlock& block, int element, int side) {
  long long corners[4];
  const std::vector<int>& local = side_nodes(block.shape, side);
  const int count = num_corners(side_shape(block.shape, side));
  for (int c = 0; c < count; ++c) corners[c] = mesh.node_ids()[block.nodes(element, local[c])];
  return sorted_key(corners, count);
}

SetSides all_sides(const Mesh& mesh, const std::string& set) {
  SetSides own;
  for (const Side& side : mesh.side_sets().at(set)) {
    const ElementBlock& block = mesh.blocks()[side.block];
    const std::vector<int>& local = side_nodes(block.shape, side.side);
    const SideKey key = key_of(mesh, block, side.element, side.side);
    own.keys.insert(own.keys.end(), key.begin(), key.end());
    double middle[3] = {};
    const int corners = num_corners(side_shape(block.shape, side.side));
    for (int c = 0; c < corners; ++c)
      for (int i = 0; i < mesh.dimension(); ++i)
        middle[i] += mesh.coordinates()(block.nodes(side.element, local[c]), i) / corners;
    own.centres.insert(own.centres.end(), middle, middle + 3);
  }
  return {all_gather(*mesh.comm(), own.keys), all_gather(*mesh.comm(), own.centres)};
}

}  // namespace

SideKey sorted_key(const long long* corners, int count) {
  SideKey key{-1, -1, -1, -1};
  for (int i = 0; i < count; ++i) {
    int at = i;
    for (; at > 0 && key[at - 1] > corners[i]; --at) key[at] = key[at - 1];
    key[at] = corners[i];
  }
  return key;
}

SideKey directed_key(const long long* corners, int count) {
  SideKey key{-1, -1, -1, -1};
  std::copy(corners, corners + count, key.begin());
  if (count > 2) std::rotate(key.begin(), std::min_element(key.begin(), key.begin() + count), key.begin() + count);
  return key;
}

SideKey reversed_key(const SideKey& directed) {
  SideKey key = directed;
  const auto end = std::find(key.begin(), key.end(), -1);
  std::reverse(end - key.begin() > 2 ? key.begin() + 1 : key.begin(), end);
  return key;
}

std::size_t SideKeyHash::operator()(const SideKey& key) const {
  std::size_t hash = 0;
  for (const long long node : key) hash = (hash ^ static_cast<std::size_t>(node)) * 0x9e3779b97f4a7c15u;
  return hash ^ (hash >> 29);
}

std::size_t count_over_elements(const GlobalMesh& mesh, int (*per_element)(CellShape)) {
  std::size_t sum = 0;
  for (const auto& block : mesh.blocks) sum += block.nodes.size() / num_nodes(block.shape) * per_element(block.shape);
  return sum;
}

std::vector<ElementSide> boundary_sides(const GlobalMesh& mesh) {
  const std::size_t all = count_over_elements(mesh, num_sides);
  SideTable table(all / 2 + 1);
  std::vector<std::size_t> number;  // number of each side, in the order of for_each_side()
  std::vector<char> count;          // by number: how many elements have the side
  number.reserve(all);
  for_each_side(mesh, [&](const GlobalMesh::Side& place, const std::vector<long long>& nodes) {
    const CellShape shape = side_shape(mesh.blocks[place.block].shape, place.side);
    number.push_back(table.number(sorted_key(nodes.data(), num_corners(shape))));
    count.resize(table.size(), 0);
    count[number.back()] = count[number.back()] == 0 ? 1 : 2;
  });
  std::vector<ElementSide> result;
  std::size_t turn = 0;
  for_each_side(mesh, [&](const GlobalMesh::Side& place, const std::vector<long long>& nodes) {
    if (count[number[turn++]] == 1) result.push_back({place, nodes});
  });
  return result;
}

ElementMap element_map(const GlobalMesh& mesh, int block, long long element) {
  const CellShape shape = mesh.blocks[block].shape;
  const long long* nodes = mesh.blocks[block].nodes.data() + element * num_nodes(shape);
  return {shape, [&](int a) { return mesh.coordinates[nodes[a]]; }};
}

MeshParts mesh_parts(const Mesh& mesh) {
  const std::vector<long long> leader = leaders(mesh);
  std::vector<long long> firsts;  // the parts' leaders
  std::vector<double> places;
  for (int node = 0; node < mesh.num_owned_nodes(); ++node) {
    if (leader[node] != mesh.node_ids()[node]) continue;
    firsts.push_back(leader[node]);
    const Point place = mesh.place(node);
    places.insert(places.end(), place.begin(), place.end());
  }
  firsts = all_gather(*mesh.comm(), firsts);
  places = all_gather(*mesh.comm(), places);
  std::map<long long, int> number;
  for (long long first : firsts) number[first] = 0;
  MeshParts result;
  for (auto& [first, part] : number) {
    part = static_cast<int>(result.places.size());
    const auto row = 3 * (std::find(firsts.begin(), firsts.end(), first) - firsts.begin());
    result.places.push_back({places[row], places[row + 1], places[row + 2]});
  }
  for (long long first : leader) result.of_node.push_back(number.at(first));
  for (const std::string& name : mesh.set_names()) {
    std::vector<int> touched(result.places.size(), 0);
    for (int node : mesh.nodes_of_set(name)) touched[result.of_node[node]] = 1;
    touched = max_over_ranks(*mesh.comm(), touched);
    auto& parts = result.of_set[name];
    for (std::size_t part = 0; part < touched.size(); ++part)
      if (touched[part]) parts.push_back(static_cast<int>(part));
  }
  return result;
}

void require_boundary(const Mesh& mesh, const Section& section, const std::string& entry, const std::string& name) {
  require_side_set(mesh, section, entry, name);
  const SetSides sides = all_sides(mesh, name);
  const auto count = sides.keys.size() / 4;
  std::unordered_map<SideKey, int, SideKeyHash> row;
  for (std::size_t k = 0; k < count; ++k) {
    SideKey key;
    std::copy_n(sides.keys.begin() + 4 * k, 4, key.begin());
    row[key] = static_cast<int>(k);
  }
  std::vector<int> elements(count, 0);
  for (const ElementBlock& block : mesh.blocks())
    for (int s = 0; s < num_sides(block.shape); ++s)
      for (int e = 0; e < block.num_elements; ++e) {
        const auto found = row.find(key_of(mesh, block, e, s));
        if (found != row.end()) ++elements[found->second];
      }
  elements = sum_over_ranks(*mesh.comm(), elements);
  for (std::size_t k = 0; k < count; ++k)
    if (elements[k] > 1)
      section.fail(
          "side set '" + name + "' has a side between two elements, at " +
              place_text({sides.centres[3 * k], sides.centres[3 * k + 1], sides.centres[3 * k + 2]}, mesh.dimension()) +
              "; all its sides must be on the boundary of the mesh",
          entry);
}

Point middle_of(const GlobalMesh& mesh, const ElementSide& side) {
  const CellShape shape = side_shape(mesh.blocks[side.place.block].shape, side.place.side);
  double N[9], dN[18];
  evaluate_shape(shape, cell_centre(shape).data(), N, dN);
  Point middle{};
  for (std::size_t a = 0; a < side.nodes.size(); ++a)
    for (int i = 0; i < 3; ++i) middle[i] += N[a] * mesh.coordinates[side.nodes[a]][i];
  return middle;
}

}  // namespace mudline
