#include "discretisation/msh_elements.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <tuple>

namespace mudline {

const MshElement& MshElements::type(long long type) const {
  const MshElement* const known = type > 0 && type < 1000 ? msh_element(static_cast<int>(type)) : nullptr;
  const bool lower = known != nullptr && (type == 1 || type == 8 || type == 15);
  if (known != nullptr && (lower || cell_of(known->type) || known->dimension > dimension_)) return *known;
  in_.fail("an element of the type " + std::to_string(type) +
           (known == nullptr ? ", which is unknown" : " ('" + std::string(known->name) + "')") +
           "; allowed: points, lines of 2 or 3 nodes, triangles of 3 or 6, quadrilaterals of 4, 8 or 9, tetrahedra of "
           "4 or 10, hexahedra of 8, 20 or 27, prisms of 6, 15 or 18");
}

void MshElements::name_group(int dimension, long long group, const std::string& name) {
  const auto [known, added] = names_.emplace(std::pair{dimension, group}, name);
  if (!added && known->second != name)
    in_.fail("the physical group " + std::to_string(group) + " has two names, '" + known->second + "' and '" + name +
             "'");
}

bool MshElements::add_node(Tag tag, const Point& place) {
  const auto [known, added] = places_.emplace(tag, place);
  if (added) order_.push_back(tag);
  return added || known->second == place;
}

void MshElements::add(const MshElement& type, const Tags& tags, std::size_t place, const long long* nodes) {
  if (type.dimension > dimension_) return;
  elements_.push_back({&type, tags, place, nodes_.size()});
  nodes_.insert(nodes_.end(), nodes, nodes + type.nodes);
}

std::string MshElements::group_name(const Element& e) const {
  if (e.tags.group == 0) return "";
  const auto name = names_.find({e.type->dimension, e.tags.group});
  return name == names_.end() || name->second.empty() ? std::to_string(e.tags.group) : name->second;
}

TaggedMesh MshElements::mesh() {
  check_nodes();
  leave_out_interfaces();
  remove_duplicates();
  TaggedMesh mesh;
  for (const Tag tag : order_) mesh.nodes.push_back({tag, places_.at(tag)});
  add_cells(mesh);
  add_sides(mesh);
  add_points(mesh);
  return mesh;
}

void MshElements::check_nodes() const {
  for (const Element& e : elements_)
    for (int a = 0; a < e.type->nodes; ++a)
      if (places_.count(nodes(e)[a]) == 0)
        in_.fail_at(e.place, "an element has the node " + std::to_string(nodes(e)[a]) + ", which is not among the " +
                                 std::to_string(places_.size()) + " nodes of the file");
}

/// Leaves out the lines, faces and points that Gmsh may write between partitions. They have no partition of their own,
/// they have the physical tag of the elements that they divide, and two partitions of those meet at their nodes.
void MshElements::leave_out_interfaces() {
  std::map<long long, int> divided;  // group -> the highest dimension of its elements that have a partition
  for (const Element& e : elements_)
    if (e.tags.part != 0 && e.tags.group != 0) {
      int& highest = divided[e.tags.group];
      highest = std::max(highest, e.type->dimension);
    }
  const auto may_be = [&](const Element& e) {
    const auto group = divided.find(e.tags.group);
    return e.tags.part == 0 && group != divided.end() && group->second > e.type->dimension;
  };
  if (std::none_of(elements_.begin(), elements_.end(), may_be)) return;
  constexpr long long several = -1;
  std::map<long long, std::unordered_map<Tag, long long>> parts;  // group -> node -> partition, or several
  for (const Element& e : elements_) {
    const auto group = divided.find(e.tags.group);
    if (e.tags.part == 0 || group == divided.end() || group->second != e.type->dimension) continue;
    for (int a = 0; a < e.type->nodes; ++a) {
      const auto [known, added] = parts[e.tags.group].emplace(nodes(e)[a], e.tags.part);
      if (!added && known->second != e.tags.part) known->second = several;
    }
  }
  const auto is_interface = [&](const Element& e) {
    return may_be(e) && std::all_of(nodes(e), nodes(e) + e.type->nodes, [&, &at = parts[e.tags.group]](Tag node) {
             const auto part = at.find(node);
             return part != at.end() && part->second == several;
           });
  };
  elements_.erase(std::remove_if(elements_.begin(), elements_.end(), is_interface), elements_.end());
}

/// A file may list an element once for each of its groups; a side then belongs to all of them. A cell may have only one
/// group, and no element may be listed twice in a group.
void MshElements::remove_duplicates() {
  struct Key {
    std::uint64_t hash;
    std::size_t element;
  };
  std::vector<Key> keys;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const Element& element = elements_[e];
    if (element.type->dimension < dimension_ - 1 || element.tags.group == 0) continue;
    std::uint64_t sum = 0;  // the same for every order of the nodes
    for (int a = 0; a < element.type->nodes; ++a) {
      std::uint64_t mixed = static_cast<std::uint64_t>(nodes(element)[a]) + 0x9e3779b97f4a7c15ULL;
      mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9ULL;
      mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebULL;
      sum += mixed ^ (mixed >> 31);
    }
    keys.push_back({sum, e});
  }
  std::sort(keys.begin(), keys.end(),
            [](const Key& a, const Key& b) { return std::tie(a.hash, a.element) < std::tie(b.hash, b.element); });
  std::set<std::size_t> doubles;
  for (std::size_t first = 0; first < keys.size(); ++first)
    for (std::size_t next = first + 1; next < keys.size() && keys[next].hash == keys[first].hash; ++next)
      if (is_duplicate(elements_[keys[next].element], elements_[keys[first].element]))
        doubles.insert(keys[next].element);
  std::size_t kept = 0;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (doubles.count(e) == 0) elements_[kept++] = elements_[e];
  elements_.resize(kept);
}

bool MshElements::is_duplicate(const Element& e, const Element& before) const {
  if (e.type != before.type) return false;
  std::vector<Tag> a(nodes(e), nodes(e) + e.type->nodes), b(nodes(before), nodes(before) + e.type->nodes);
  const bool cell = e.type->dimension == dimension_;
  if (cell) {  // only cells are compared without regard to order: a side differs from the same side seen from the other
               // element
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
  }
  if (a != b) return false;
  const std::string group = group_name(e), other = group_name(before), first = in_.place_text(before.place);
  if (e.tags.group == before.tags.group)
    in_.fail_at(e.place, "an element is listed twice in the physical group '" + group + "', first in " + first);
  if (cell)
    in_.fail_at(e.place, "an element is in two physical groups, '" + group + "' and in " + first + " '" + other +
                             "'; each element needs exactly one");
  return group == other;
}

void MshElements::add_groups_of_entities(GroupsOfEntities& groups) const {
  std::map<std::pair<std::pair<int, long long>, std::vector<Tag>>, std::set<std::string>> of_elements;
  for (const Element& e : elements_) {
    std::vector<Tag> sorted(nodes(e), nodes(e) + e.type->nodes);
    std::sort(sorted.begin(), sorted.end());
    of_elements[{{e.type->dimension, e.tags.entity}, std::move(sorted)}].insert(group_name(e));
  }
  for (const auto& [element, names] : of_elements) groups[element.first].insert(names);
}

void MshElements::add_cells(TaggedMesh& mesh) const {
  std::map<std::tuple<long long, int, std::string>, std::vector<Tag>> lists;  // by entity, type, region
  for (const Element& e : elements_) {
    if (e.type->dimension != dimension_) continue;
    std::vector<Tag>& list = lists[{e.tags.entity, e.type->type, group_name(e)}];
    list.insert(list.end(), nodes(e), nodes(e) + e.type->nodes);
  }
  for (auto& [key, list] : lists) {
    const auto& [entity, type, region] = key;
    mesh.cells.push_back(
        {type, region, (dimension_ == 2 ? "surface " : "volume ") + std::to_string(entity), std::move(list)});
  }
}

void MshElements::add_sides(TaggedMesh& mesh) const {
  std::map<std::tuple<std::string, long long, int>, TaggedMesh::Sides> lists;  // by set, entity, type
  for (const Element& e : elements_) {
    if (e.type->dimension != dimension_ - 1 || e.tags.group == 0) continue;
    const std::string set = group_name(e);
    TaggedMesh::Sides& sides = lists[{set, e.tags.entity, e.type->type}];
    sides.set = set;
    sides.corners = e.type->corners;
    sides.nodes.insert(sides.nodes.end(), nodes(e), nodes(e) + e.type->corners);
  }
  for (auto& item : lists) mesh.sides.push_back(std::move(item.second));
}

void MshElements::add_points(TaggedMesh& mesh) const {
  for (const Element& e : elements_) {
    if (e.type->dimension >= dimension_ - 1 || e.tags.group == 0) continue;
    std::vector<Tag>& list = (e.type->dimension == 0 ? mesh.points : mesh.curves)[group_name(e)];
    list.insert(list.end(), nodes(e), nodes(e) + e.type->nodes);
  }
}

}  // namespace mudline
