#include "discretisation/gmsh_model.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cstdlib>
#include <set>

#include "core/errors.hpp"
#include "core/told.hpp"
#include "discretisation/gmsh_session.hpp"
#include "discretisation/msh_element.hpp"
#include "discretisation/triangulation.hpp"

namespace mudline {

namespace {

using Tag = TaggedMesh::Tag;

std::string group_name(int dimension, int tag) {
  std::string name;
  gmsh::model::getPhysicalName(dimension, tag, name);
  return name.empty() ? std::to_string(tag) : name;
}

std::vector<int> entities_of(int dimension) {
  gmsh::vectorpair list;
  gmsh::model::getEntities(list, dimension);
  std::vector<int> result;
  for (const auto& entity : list) result.push_back(entity.second);
  return result;
}

/// Whether an entity is a ghost: it refers to elements of another entity, for a neighbouring partition.
bool is_ghost(int dimension, int entity) {
  std::string type;
  gmsh::model::getType(dimension, entity, type);
  return type.compare(0, 5, "Ghost") == 0;
}

/// The groups of an entity by name. A piece of a partitioned entity has those of the whole. An interface between pieces
/// has none: its parent is of another dimension, and Gmsh gives it the parent's groups.
std::set<std::string> groups_of(int dimension, int entity) {
  std::set<std::string> names;
  int parent_dimension = -1, parent = -1;
  gmsh::model::getParent(dimension, entity, parent_dimension, parent);
  if (parent_dimension >= 0 && parent_dimension != dimension) return names;
  std::vector<int> tags;
  gmsh::model::getPhysicalGroupsForEntity(dimension, entity, tags);
  for (const int tag : tags) names.insert(group_name(dimension, std::abs(tag)));
  if (parent_dimension != dimension) return names;
  gmsh::model::getPhysicalGroupsForEntity(dimension, parent, tags);
  for (const int tag : tags) names.insert(group_name(dimension, std::abs(tag)));
  return names;
}

/// Name of the physical group -> its entities, for one dimension; groups of one name are one group.
std::map<std::string, std::vector<int>> groups(int dimension) {
  std::map<std::string, std::vector<int>> result;
  for (const int entity : entities_of(dimension))
    for (const std::string& name : groups_of(dimension, entity)) result[name].push_back(entity);
  return result;
}

/// Calls f(type, nodes) for the elements of an entity.
template <class F>
void for_each_type(int dimension, int entity, F&& f) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
  for (std::size_t t = 0; t < types.size(); ++t)
    if (!tags[t].empty()) f(types[t], nodes[t]);
}

const MshElement& known_element(int type) {
  const MshElement* const known = msh_element(type);
  if (known == nullptr)
    throw InputError("it has elements of Gmsh's type " + std::to_string(type) + ", which no mesh takes");
  return *known;
}

class Reader {
 public:
  explicit Reader(int dimension) : dimension_(dimension) {}
  TaggedMesh read();

 private:
  void read_nodes();
  void read_cells();
  void read_sides();
  std::map<std::string, std::vector<Tag>> read_points(int dimension) const;
  bool plane() const { return dimension_ == 2; }

  int dimension_;
  TaggedMesh mesh_;
};

TaggedMesh Reader::read() {
  read_nodes();
  read_cells();
  read_sides();
  mesh_.points = read_points(0);
  if (!plane()) mesh_.curves = read_points(1);
  return std::move(mesh_);
}

void Reader::read_nodes() {
  std::vector<std::size_t> tags;
  std::vector<double> x, parameters;
  gmsh::model::mesh::getNodes(tags, x, parameters);
  for (std::size_t i = 0; i < tags.size(); ++i)
    mesh_.nodes.push_back({static_cast<Tag>(tags[i]), {x[3 * i], x[3 * i + 1], x[3 * i + 2]}});
}

void Reader::read_cells() {
  std::map<int, std::string> region_of;
  for (const auto& [region, entities] : groups(dimension_))
    for (const int entity : entities) {
      const auto [known, added] = region_of.emplace(entity, region);
      if (!added)
        throw InputError((plane() ? "surface " : "volume ") + std::to_string(entity) + " is in two physical groups, '" +
                         known->second + "' and '" + region + "'; each element needs exactly one");
    }
  for (const int entity : entities_of(dimension_)) {
    if (is_ghost(dimension_, entity)) continue;
    const auto known = region_of.find(entity);
    const std::string region = known == region_of.end() ? "" : known->second;
    for_each_type(dimension_, entity, [&](int type, const std::vector<std::size_t>& nodes) {
      mesh_.cells.push_back({known_element(type).type,
                             region,
                             (plane() ? "surface " : "volume ") + std::to_string(entity),
                             {nodes.begin(), nodes.end()}});
    });
  }
}

void Reader::read_sides() {
  for (const auto& [set, entities] : groups(dimension_ - 1)) {
    mesh_.sides.push_back({set, dimension_, {}});  // a group without elements is a set too
    for (const int entity : entities)
      for_each_type(dimension_ - 1, entity, [&, &name = set](int type, const std::vector<std::size_t>& nodes) {
        const MshElement& side = known_element(type);
        TaggedMesh::Sides sides{name, side.corners, {}};
        for (std::size_t first = 0; first < nodes.size(); first += side.nodes)
          sides.nodes.insert(sides.nodes.end(), nodes.begin() + first, nodes.begin() + first + side.corners);
        mesh_.sides.push_back(std::move(sides));
      });
  }
}

/// The nodes of groups of points, and in space of groups of curves.
std::map<std::string, std::vector<Tag>> Reader::read_points(int dimension) const {
  std::map<std::string, std::vector<Tag>> result;
  for (const auto& [set, entities] : groups(dimension)) {
    std::vector<Tag>& all = result[set];
    for (const int entity : entities) {
      std::vector<std::size_t> tags;
      std::vector<double> coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters, dimension, entity, true);
      all.insert(all.end(), tags.begin(), tags.end());
      // the ends of a piece of a partitioned curve may be nodes of its neighbour
      for_each_type(dimension, entity, [&](int /*type*/, const std::vector<std::size_t>& nodes) {
        all.insert(all.end(), nodes.begin(), nodes.end());
      });
    }
  }
  return result;
}

/// The mesh of the model that Gmsh has open. Throws InputError without a position.
TaggedMesh read_gmsh_model(int dimension) { return Reader(dimension).read(); }

/// Refuses the open geometry, whose curves are meshed, where their sides tell that coordinates and sizes are in
/// different units: Gmsh would fill the faces with a thousand times a thousand elements for one that is meant.
void refuse_many_sides(const GmshFile& file, const SourcePosition& position) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, 1);
  std::size_t sides = 0;
  for (const auto& of_type : tags) sides += of_type.size();
  if (sides <= most_sides) return;
  double low[3], high[3];
  gmsh::model::getBoundingBox(-1, -1, low[0], low[1], low[2], high[0], high[1], high[2]);
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  position.fail("Gmsh divides the curves of '" + short_name(file.name) + "' into " + std::to_string(sides) +
                    " sides, too many for a model that is " + readable(extent, "m", 3) +
                    " across: are its coordinates in mm and its sizes in m? Here all are in m. A mesh that is meant to "
                    "be so fine is given as .msh",
                "file");
}

void refuse_errors(const GmshFile& file, const SourcePosition& position) {
  if (const std::string error = gmsh_error(); !error.empty())
    position.fail("Gmsh, reading '" + short_name(file.name) + "': " + error, "file");
}

/// Meshes the curves alone, looks at their sides, and forgets them again.
void try_curves(const GmshFile& file, const SourcePosition& position) {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  if (!tags.empty()) return;  // of a merged mesh, which is to be kept
  gmsh::model::mesh::generate(1);
  refuse_errors(file, position);
  refuse_many_sides(file, position);
  gmsh::model::mesh::clear();
}

void generate_mesh(const GmshFile& file, int dimension, int order, const SourcePosition& position) {
  try_curves(file, position);
  gmsh::model::mesh::generate(dimension);
  refuse_errors(file, position);
  gmsh::model::mesh::setOrder(order);
  refuse_errors(file, position);
}

}  // namespace

TaggedMesh read_gmsh_mesh(const GmshFile& file, int dimension, int order, const SourcePosition& position) {
  return with_gmsh<TaggedMesh>(file, position, [&] {
    open_in_gmsh(file, position);
    if (is_gmsh_geometry(file.name)) generate_mesh(file, dimension, order, position);
    try {
      return read_gmsh_model(dimension);
    } catch (const InputError& error) {
      position.fail("'" + short_name(file.name) + "': " + error.what(), "file");
    }
  });
}

}  // namespace mudline
