#include "ale/ale.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ale/conservation.hpp"
#include "ale/quality.hpp"
#include "core/guarded.hpp"
#include "core/told.hpp"
#include "discretisation/agree.hpp"
#include "discretisation/mesh_quality.hpp"
#include "discretisation/mesh_topology.hpp"
#include "framework/surface_points.hpp"

namespace mudline {

void AleParameters::parameters(Parameters& p) {
  p.add("every", every, "-", closed(1, 1000000), "the mesh is moved after every so many steps");
  p.add("when quality below", quality_below, "-", positive(),
        "and only when its smallest scaled Jacobian is below this; above 1: always");
  p.add("lowest quality", lowest_quality, "-", open(0, 1),
        "a motion to a smaller scaled Jacobian than this, and than before, is refused and the step cut");
  p.add("mass tolerance", mass_tolerance, "-", positive(),
        "a remap that changes the mass of grains or water by more than this share is refused and the step cut");
  p.add("largest motion", largest_motion, "-", positive(),
        "a motion by more than this share of an element's size is made and remapped in parts");
  p.add("conserve mass", conserve,
        "the free boundary makes up for the volume that nodes sliding on a curved one change, the void ratio for the "
        "grains that a remap changes");
  p.passes_on("interior", "motion of the inside; see the mesh motion types; by default optimisation");
  p.section("boundary", boundary, "how boundary nodes slide");
  p.passes_on("remap", "how the state is transferred; see the remap types; by default convection");
  p.section("remeshing", remeshing,
            "when and how the region, of triangles or tetrahedra, is remeshed; absent: it is not");
}

void Ale::document(Parameters& p) { AleParameters().parameters(p); }

namespace {

/// The mesh with as many layers of ghosts as the recovery around this rank's own elements needs: two, and more where
/// corners of the mesh have few elements. In the plane layers are cheap, and more of them make communication rarer.
GhostedMesh with_patches(const Mesh& mesh, const Soil& soil) {
  for (int layers = mesh.dimension() == 2 ? 4 : 2;; ++layers) {
    GhostedMesh result(mesh, layers);
    const bool cut = std::any_of(soil.blocks.begin(), soil.blocks.end(),
                                 [&](const SoilBlock& b) { return RecoveryPatches(result, b).cut(); });
    if (!result.any(cut)) return result;
  }
}

}  // namespace

Ale::Ale(const Space& space, const Soil& soil, const std::map<std::string, std::shared_ptr<RigidBody>>& bodies,
         const Section& section, const MeshMotionRegistries& registries, const RemeshedMesh* remeshed)
    : space_(space),
      soil_(soil),
      mesh_(with_patches(space.mesh(), soil)),
      source_(mesh_.gather(space.mesh().coordinates())),
      corners_(mesh_) {
  section.allow_sections({"interior", "boundary", "remap", "remeshing"});
  Parameters p(section);
  deck_.parameters(p);
  p.finish();
  interior_ = registries.motions.create(section.section_of_type("interior", "optimisation"));
  for (const SoilBlock& b : soil_.blocks) patches_.emplace_back(mesh_, b);
  remap_ = registries.remaps.create(section.section_of_type("remap", "convection"));
  deck_.boundary.bind(mesh_, source_, bodies, section.section("boundary"), remeshed);
  if (section.has_section("remeshing"))
    remesher_ = std::make_unique<Remesher>(mesh_, deck_.boundary, deck_.remeshing, section.section("remeshing"));
  if (remeshed) {
    remeshings_ = remeshed->number;
    remeshed_after_ = remeshed->step;
  }
  corners_.add_tangents(source_, source_);
  for (int node = 0; node < mesh_.num_nodes(); ++node)
    movable_.push_back(mesh_.is_vertex(node) && !mesh_.on_boundary(node));
  colours_ = vertex_colours(mesh_, movable_);
}

std::string Ale::problem_at_points(const StateStore& store, int handle) const {
  const ArrayInfo& info = store.info(handle);
  const SoilBlock& b = soil_.blocks[info.block];
  if (info.points_per_element != b.points)
    return "the point data '" + info.name + "' have " + std::to_string(info.points_per_element) +
           " points per element where the soil has " + std::to_string(b.points) +
           ": they cannot be transferred; declare them on the soil's points";
  if (b.made_of.size() == 1) return "";
  for (const StateVariable& v : info.variables) {
    const bool of_law = handle == b.law && v.transfer != Transfer::value;
    if (of_law || (v.transfer == Transfer::mass && handle != b.void_ratio))
      return "in layered soil the variable '" + v.name + "' of '" + info.name +
             "' cannot be transferred by its rule; there only values can be";
  }
  return "";
}

std::string Ale::problem(const StateStore& store) const {
  std::string problem;
  for (int handle = 0; handle < store.num_arrays(); ++handle) {
    const ArrayInfo& info = store.info(handle);
    if (info.on == ArrayInfo::On::points) problem = problem_at_points(store, handle);
    const auto in_set = [&](const auto& line) { return line.sets.count(info.surface->side_set()) > 0; };
    if (info.on == ArrayInfo::On::surface && std::none_of(paths().begin(), paths().end(), in_set) &&
        std::none_of(surfaces().faces.begin(), surfaces().faces.end(), in_set))
      problem = "the state '" + info.name + "' is on the side set '" + info.surface->side_set() +
                "', which is no boundary of a region: it cannot be transferred";
    bool moves = false;  // a node that keeps a part of a sum, in a remeshing
    if (remesher_ && info.on == ArrayInfo::On::nodes &&
        std::any_of(info.variables.begin(), info.variables.end(),
                    [](const StateVariable& v) { return v.transfer == Transfer::total; }))
      moves = std::any_of(info.nodes.begin(), info.nodes.end(),
                          [&](int node) { return !remesher_->fixed(mesh_.number_of(node)); });
    if (problem.empty() && mesh_.any(moves))
      problem = "the state '" + info.name +
                "' has parts of a sum at nodes that a remeshing would move; name their set in boundary/material sides";
    if (!problem.empty()) return problem;
  }
  return "";
}

bool Ale::due(int step, const State& committed) const {
  return step % deck_.every == 0 && (deck_.quality_below > 1 || quality(committed) < deck_.quality_below);
}

double Ale::quality(const State& state) const { return mesh_quality(mesh_.mesh(), state.coordinates).lowest; }

bool Ale::folded(const Positions& x) const {
  return mesh_.any(std::any_of(corners_.simplices.begin(), corners_.simplices.end(),
                               [&](const Simplex& t) { return !(determinant(t, x) > 0); }));
}

void Ale::place_mid_side_nodes(Positions& x) const {
  int all[27];
  std::iota(all, all + 27, 0);
  for (const auto& element : mesh_.elements()) {
    if (order(element.shape) == 1) continue;
    const CellShape shape = element.shape;
    const auto& n = element.nodes;
    const int corners = num_corners(shape), mid_side_nodes = corners + num_edges(shape);
    const auto sum = [&](const int* first, const int* last, int d) {
      double all = 0;
      for (; first != last; ++first) all += x[n[*first]][d];
      return all;
    };
    for (int a = corners; a < mid_side_nodes; ++a) {
      const auto [from, to] = edge_corners(shape, a - corners);
      if (!mesh_.on_boundary(n[a]))
        for (int d = 0; d < place_size; ++d) x[n[a]][d] = 0.5 * (x[n[from]][d] + x[n[to]][d]);
    }
    // centres are transfinite: exact for straight edges
    const auto centre = [&](const int* quadrilateral) {  // its corners, mid-side nodes and centre
      const int* edges = quadrilateral + 4;
      const int at = n[quadrilateral[8]];
      if (!mesh_.on_boundary(at))
        for (int d = 0; d < place_size; ++d)
          x[at][d] = 0.5 * sum(edges, edges + 4, d) - 0.25 * sum(quadrilateral, edges, d);
    };
    if (shape == CellShape::quad9) centre(all);
    for (int s = 0; s < num_sides(shape); ++s)
      if (side_shape(shape, s) == CellShape::quad9) centre(side_nodes(shape, s).data());
    if (shape != CellShape::hex27) continue;
    for (int d = 0; d < place_size; ++d)
      x[n[26]][d] = 0.5 * sum(all + 20, all + 26, d) - 0.25 * sum(all + 8, all + 20, d) + 0.125 * sum(all, all + 8, d);
  }
}

std::string Ale::new_positions(const Positions& x_old, const State& state, const Constraints& constraints,
                               Positions& x) const {
  Positions boundary = deck_.boundary.move(x_old, state);
  Positions before = x_old;
  corners_.add_tangents(x_old, before);
  x = before;
  // The boundary moves in as few parts as it can without folding elements; the inner vertices follow each part.
  for (double done = 0, part = 1; done < 1;) {
    Positions next = x, curve = boundary;
    const double share = done + part;
    for (int node = 0; node < mesh_.num_nodes(); ++node) {
      if (!mesh_.on_boundary(node)) continue;
      if (share < 1)
        for (int d = 0; d < place_size; ++d)
          curve[node][d] = x_old[node][d] + share * (boundary[node][d] - x_old[node][d]);
      next[node] = curve[node];
    }
    corners_.add_tangents(curve, next);
    if (!folded(next)) {
      interior_->move({mesh_, corners_, source_, before, movable_, colours_, state.time}, next);
      if (!folded(next)) {
        done = share;
        x.swap(next);
        continue;
      }
    }
    part *= 0.5;
    if (part < 1.0 / 64) return "the moved boundary folds elements";
  }
  x.resize(mesh_.num_nodes());
  place_mid_side_nodes(x);
  if (deck_.conserve) keep_volume(soil_volume(mesh_, soil_, x_old), state, constraints, x);
  double largest = 0;
  for (const Point& place : x_old)
    largest = std::max({largest, std::abs(place[0]), std::abs(place[1]), std::abs(place[2])});
  largest = mesh_.largest(largest);
  for (int node = 0; node < mesh_.num_nodes(); ++node)  // undoes motions by rounding
    if (distance(x[node], x_old[node]) < 1e-14 * largest) x[node] = x_old[node];
  return "";
}

std::vector<double> Ale::prescribed(int field, const Constraints& constraints) const {
  const NodalView mask("", constraints.mask.extent(0));
  for (std::size_t i = 0; i < mask.extent(0); ++i) mask(i) = constraints.mask(i);
  return mesh_.gather(space_, field, mask);
}

void Ale::keep_volume(double volume, const State& state, const Constraints& constraints, Positions& x) const {
  const auto missing = [&] { return volume - soil_volume(mesh_, soil_, x); };
  const auto matters = [&](double part) { return std::abs(part) > 1e-14 * volume; };
  double part = missing();
  if (!matters(part)) return;
  const FreeBoundary free(mesh_, soil_, deck_.boundary.freedom(x, state), prescribed(soil_.displacement, constraints),
                          x);
  if (!(free.area > 0)) return;
  for (int k = 0; k < 4; ++k) {
    if (!matters(part)) break;
    for (const auto& mover : free.movers)
      for (int d = 0; d < place_size; ++d) x[mover.node][d] += part / free.area * mover.normal[d];
    mesh_.fill(x);
    place_mid_side_nodes(x);
    part = missing();
  }
}

double Ale::largest_motion(const Positions& x_old, const Positions& x_new) const {
  double largest = 0;
  for (int i = 0; i < corners_.of_elements; ++i) {
    const Simplex& t = corners_.simplices[i];
    for (int node : t) largest = std::max(largest, distance(x_new[node], x_old[node]) / size(t, x_old));
  }
  return mesh_.largest(largest);
}

void Ale::keep_compression(double before, const Constraints& constraints, State& to) const {
  if (soil_.pressure < 0) return;
  const std::vector<double> transferred = mesh_.gather(space_, soil_.pressure, to.value);
  const std::vector<double> held = prescribed(soil_.pressure, constraints);
  const auto scale = [&](double share) {
    std::vector<double> scaled = transferred;
    for (std::size_t node = 0; node < scaled.size(); ++node)
      if (held[node] == 0) scaled[node] += share * std::abs(transferred[node]);
    mesh_.scatter(space_, soil_.pressure, scaled, to.value);
  };
  const double now = take_inventory(soil_, to).compression;
  scale(1);  // the compression is linear in the pressures
  const double most = take_inventory(soil_, to).compression - now, share = most > 0 ? (before - now) / most : 0.0;
  scale(std::abs(share) < deck_.mass_tolerance ? share : 0.0);
}

void Ale::take_stock(const State& state, MeshReceipt& receipt) const {
  Inventory& after = receipt.after;
  after = take_inventory(soil_, state);
  for (std::size_t k = 0; k < receipt.unresolved_grains.size(); ++k) {
    after.grains[k] += receipt.unresolved_grains[k];
    after.solid += receipt.unresolved_grains[k];
  }
  if (soil_.pressure < 0) return;
  after.water -= receipt.unresolved_volume;
  after.pore_volume -= receipt.unresolved_volume;
}

std::string Ale::lost_mass(const MeshReceipt& receipt) const {
  const auto changed = [&](double share) { return std::abs(share) > deck_.mass_tolerance; };
  const auto share = [](double before, double after) { return before != 0 ? after / before - 1 : 0.0; };
  const double solid = share(receipt.before.solid, receipt.after.solid),
               water = share(receipt.before.water, receipt.after.water);
  if (changed(solid) || changed(receipt.restored_solid))
    return "the remap changes the mass of grains by a share of " +
           told(changed(solid) ? solid : -receipt.restored_solid);
  return changed(water) ? "the remap changes the pore water by a share of " + told(water) : "";
}

MeshReceipt Ale::relocate(StateStore& store, const Constraints& constraints) const {
  MeshReceipt receipt;
  State& state = store.committed();
  const Positions x_old = mesh_.gather(state.coordinates);
  receipt.quality_before = receipt.quality = lowest_quality(mesh_, x_old);
  Positions x_new;
  receipt.veto = new_positions(x_old, state, constraints, x_new);
  if (!receipt.veto.empty()) return receipt;
  Point at{};
  receipt.quality = lowest_quality(mesh_, x_new, &at);
  // A mesh that was already below the limit is accepted unless moving it makes it worse.
  if (receipt.quality < std::min(deck_.lowest_quality, 0.9 * receipt.quality_before)) {
    receipt.veto =
        "the moved mesh has a scaled Jacobian of " + told(receipt.quality) + " at " + place_text(at, mesh_.dimension());
    return receipt;
  }
  receipt.largest_motion = largest_motion(x_old, x_new);
  const int parts = std::max(1, static_cast<int>(std::ceil(receipt.largest_motion / deck_.largest_motion)));
  receipt.before = take_inventory(soil_, state);
  // The trial state is free between steps: it takes the new state, so that the committed one survives a veto.
  store.begin();
  State& moved = store.trial();
  Positions from = x_old, to = x_new;
  for (int part = 1; part <= parts; ++part) {
    const double share = static_cast<double>(part) / parts;
    for (std::size_t node = 0; node < to.size(); ++node)
      for (int d = 0; d < place_size; ++d)
        to[node][d] = part == parts ? x_new[node][d] : x_old[node][d] + share * (x_new[node][d] - x_old[node][d]);
    MeshTransfer(*this, from, to).transfer(store, moved, store, moved, receipt);
    if (!receipt.veto.empty()) return receipt;
    from = to;
  }
  mesh_.scatter(x_new, moved.coordinates);
  MeshTransfer::follow_surfaces(store, state.coordinates, moved);
  if (deck_.conserve) keep_compression(receipt.before.compression, constraints, moved);
  take_stock(moved, receipt);
  receipt.veto = lost_mass(receipt);
  if (!receipt.veto.empty()) return receipt;
  store.accept();
  receipt.moved = true;
  return receipt;
}

}  // namespace mudline
