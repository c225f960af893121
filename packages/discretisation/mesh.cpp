#include "discretisation/mesh.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "core/errors.hpp"
#include "core/guarded.hpp"
#include "discretisation/agree.hpp"
#include "discretisation/distribute.hpp"
#include "discretisation/mesh_topology.hpp"

namespace mudline {

namespace {

/// A view of the default memory space filled from host values in row order.
template <class T>
Kokkos::View<T**, Kokkos::LayoutRight> filled(const std::string& label, const std::vector<T>& values,
                                              std::size_t columns) {
  Kokkos::View<T**, Kokkos::LayoutRight> view(label, values.size() / columns, columns);
  const auto host = Kokkos::create_mirror_view(view);
  for (std::size_t i = 0; i < values.size(); ++i) host(i / columns, i % columns) = values[i];
  Kokkos::deep_copy(view, host);
  return view;
}

std::vector<std::string> names_of(const std::map<std::string, std::vector<Side>>& sets) {
  std::vector<std::string> names;
  for (const auto& item : sets) names.push_back(item.first);
  return names;
}

}  // namespace

int dimension(Geometry geometry) { return geometry == Geometry::space ? 3 : 2; }

Bounds Bounds::nothing() {
  constexpr double huge = std::numeric_limits<double>::max();
  return {{huge, huge, huge}, {-huge, -huge, -huge}};
}

void Bounds::enclose(const Point& place) {
  for (int i = 0; i < 3; ++i) {
    low[i] = std::min(low[i], place[i]);
    high[i] = std::max(high[i], place[i]);
  }
}

double Bounds::extent() const { return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}); }

namespace {

MeshPart checked_part(const Teuchos::Comm<int>& comm, Geometry geometry, GlobalMesh global) {
  agree(comm, [&] {
    if (comm.getRank() == 0) check_mesh(global, geometry);
  });
  return distribute(comm, global);
}

}  // namespace

Mesh::Mesh(Teuchos::RCP<const Teuchos::Comm<int>> comm, Geometry geometry, GlobalMesh global)
    : Mesh(comm, geometry, checked_part(*comm, geometry, std::move(global))) {}

Mesh::Mesh(Teuchos::RCP<const Teuchos::Comm<int>> comm, Geometry geometry, MeshPart part)
    : comm_(std::move(comm)), geometry_(geometry) {
  num_owned_nodes_ = part.num_owned_nodes;
  num_global_nodes_ = part.num_global_nodes;
  num_global_elements_ = part.num_global_elements;
  node_ids_ = std::move(part.node_ids);
  coordinates_ = filled("coordinates", part.coordinates, dimension());
  is_vertex_ = std::move(part.is_vertex);
  for (MeshPart::Block& block : part.blocks) {
    const int n = mudline::num_nodes(block.shape), elements = static_cast<int>(block.ids.size());
    blocks_.push_back({block.region, block.shape, elements, filled("nodes", block.nodes, n), std::move(block.ids)});
  }
  side_sets_ = std::move(part.side_sets);
  node_sets_ = std::move(part.node_sets);
  set_nodes_ = std::move(part.set_nodes);
  regions_ = std::move(part.regions);
  bounds_ = part.bounds;
  region_bounds_ = std::move(part.region_bounds);
}

Point Mesh::place(int node) const {
  Point x{};
  for (int i = 0; i < dimension(); ++i) x[i] = coordinates_(node, i);
  return x;
}

const std::vector<int>& Mesh::nodes_of_set(const std::string& name) const {
  const auto found = set_nodes_.find(name);
  if (found == set_nodes_.end()) throw std::logic_error("the mesh has no set '" + name + "'");
  return found->second;
}

std::vector<std::string> Mesh::set_names() const {
  std::vector<std::string> names;
  for (const auto& item : set_nodes_) names.push_back(item.first);
  return names;
}

std::vector<std::string> Mesh::side_set_names() const { return names_of(side_sets_); }

void require_side_set(const Mesh& mesh, const Section& section, const std::string& entry, const std::string& name) {
  if (mesh.has_side_set(name)) return;
  if (mesh.has_set(name))
    section.fail("'" + name + "' is a set of points, a set of sides is needed; allowed: " + join(mesh.side_set_names()),
                 entry);
  const std::vector<std::string> known = mesh.side_set_names();
  section.fail("unknown side set '" + name + "'" + (known.empty() ? "; the mesh has none" : suggestion(name, known)),
               entry);
}

void require_set(const Mesh& mesh, const Section& section, const std::string& entry, const std::string& name) {
  if (!mesh.has_set(name)) section.fail("unknown mesh set '" + name + "'" + suggestion(name, mesh.set_names()), entry);
}

void require_region(const Mesh& mesh, const Section& section, const std::string& entry, const std::string& name) {
  const std::vector<std::string>& known = mesh.regions();
  if (std::find(known.begin(), known.end(), name) == known.end())
    section.fail("unknown mesh region '" + name + "'" + suggestion(name, known), entry);
}

namespace {

/// The entries of the section "mesh" that make_mesh reads for every type of source.
struct Entries {
  Geometry geometry = Geometry::plane_strain;
  std::vector<std::string> cracks;
  void parameters(Parameters& p);
};

void Entries::parameters(Parameters& p) {
  p.choice(
      "geometry", geometry,
      {{name(Geometry::plane_strain), Geometry::plane_strain},
       {name(Geometry::axisymmetric), Geometry::axisymmetric},
       {name(Geometry::space), Geometry::space}},
      "What the mesh is: a cross-section of unit thickness in the x-y plane, a half-plane there turned about x = 0, "
      "or a body in space with z up");
  p.add("cracks", cracks,
        "Side sets along cracks that are meant: sides that lie beside others without common nodes, and part from them");
}

}  // namespace

const char* name(Geometry geometry) {
  switch (geometry) {
    case Geometry::plane_strain:
      return "plane strain";
    case Geometry::axisymmetric:
      return "axisymmetric";
    case Geometry::space:
      return geometry_in_space;
  }
  throw std::logic_error("unknown geometry");
}

Geometry declare_geometry(Parameters& p) {
  Entries entries;
  entries.parameters(p);
  return entries.geometry;
}

MeshRecipe::MeshRecipe(const Registry<MeshSource>& sources, const Section& section, ContactSets contacts)
    : section_(section), contacts_(std::move(contacts)), source_(sources.create(section)) {
  Entries entries;
  Parameters p(section);
  entries.parameters(p);
  geometry_ = entries.geometry;
  cracks_ = entries.cracks;
}

Point middle_of(const Mesh& mesh, const Side& side) {
  const ElementBlock& block = mesh.blocks()[side.block];
  const std::vector<int> local = side_nodes(block.shape, side.side);
  const int corners = num_corners(side_shape(block.shape, side.side));
  Point middle{};
  for (int c = 0; c < corners; ++c) middle += 1.0 / corners * mesh.place(block.nodes(side.element, local[c]));
  return middle;
}

GlobalMesh MeshRecipe::make() const {
  GlobalMesh mesh = source_->generate();
  mesh.contacts = contacts_;
  try {
    check_mesh(mesh, geometry_);
    check_seams(mesh, cracks_);
  } catch (const InputError& error) {
    section_.fail(error.what());  // the mesh itself does not know the deck
  }
  return mesh;
}

std::unique_ptr<Mesh> make_mesh(Teuchos::RCP<const Teuchos::Comm<int>> comm, const MeshRecipe& recipe) {
  GlobalMesh mesh;
  agree(*comm, [&] {
    if (comm->getRank() == 0) mesh = recipe.make();
  });
  try {
    MeshPart part = distribute(*comm, mesh);
    mesh = {};
    return std::make_unique<Mesh>(comm, recipe.geometry(), std::move(part));
  } catch (const InputError& error) {
    recipe.section().fail(error.what());
  }
}

std::unique_ptr<Mesh> make_mesh(Teuchos::RCP<const Teuchos::Comm<int>> comm, const Registry<MeshSource>& sources,
                                const Section& section, const ContactSets& contacts) {
  std::unique_ptr<MeshRecipe> recipe;
  agree(*comm, [&] { recipe = std::make_unique<MeshRecipe>(sources, section, contacts); });
  return make_mesh(comm, *recipe);
}

}  // namespace mudline
