#pragma once

#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "discretisation/msh_element.hpp"
#include "discretisation/msh_input.hpp"
#include "discretisation/tagged_mesh.hpp"

namespace mudline {

/// Physical groups by dimension and elementary tag of an entity. Each element has a set of groups; an entity has all
/// the sets that occur among its elements.
using GroupsOfEntities = std::map<std::pair<int, long long>, std::set<std::set<std::string>>>;

/// Collects the nodes, elements and group names of a file of Gmsh's formats 1 to 2.2 and makes a mesh of one dimension
/// from them. Errors name the element's place in the file.
class MshElements {
 public:
  using Tag = TaggedMesh::Tag;
  /// Numbers of an element's physical group (0: none) and entity, and of its partition (0: none).
  struct Tags {
    long long group = 0, entity = 0, part = 0;
  };

  MshElements(const MshInput& in, int dimension) : in_(in), dimension_(dimension) {}

  /// The type of that number. Throws InputError where no mesh of this dimension may have such elements.
  const MshElement& type(long long type) const;
  void name_group(int dimension, long long group, const std::string& name);
  /// False where a node of that number is at another place.
  bool add_node(Tag tag, const Point& place);
  void add(const MshElement& type, const Tags& tags, std::size_t place, const long long* nodes);

  /// The mesh of all that was added. Throws InputError where elements have unknown nodes, or are listed twice.
  TaggedMesh mesh();
  void add_groups_of_entities(GroupsOfEntities& groups) const;

 private:
  struct Element {
    const MshElement* type;
    Tags tags;
    std::size_t place;  // line or byte
    std::size_t first;  // its first node in nodes_
  };
  const Tag* nodes(const Element& e) const { return nodes_.data() + e.first; }
  std::string group_name(const Element& e) const;
  void leave_out_interfaces();
  void check_nodes() const;
  void remove_duplicates();
  bool is_duplicate(const Element& e, const Element& before) const;
  void add_cells(TaggedMesh& mesh) const;
  void add_sides(TaggedMesh& mesh) const;
  void add_points(TaggedMesh& mesh) const;

  const MshInput& in_;
  int dimension_;
  std::map<std::pair<int, long long>, std::string> names_;
  std::unordered_map<Tag, Point> places_;
  std::vector<Tag> order_;  // nodes in the file's order
  std::vector<Element> elements_;
  std::vector<Tag> nodes_;  // nodes of all elements
};

}  // namespace mudline
