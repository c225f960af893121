#include "ale/ale.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ale/quality.hpp"

namespace mudline {

namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace

void AleParameters::parameters(Parameters& p) {
  p.add("every", every, "-", closed(1, 1000000), "the mesh is moved after every so many steps");
  p.add("when quality below", quality_below, "-", positive(), "and only when its smallest scaled Jacobian is below this; above 1: always");
  p.add("lowest quality", lowest_quality, "-", open(0, 1), "a motion to a smaller scaled Jacobian than this, and than before, is refused and the step cut");
  p.add("mass tolerance", mass_tolerance, "-", positive(), "a remap that changes the mass of grains or water by more than this share is refused and the step cut");
}

void Ale::document(Parameters& p) {
  AleParameters().parameters(p);
  BoundaryMotion boundary;
  p.passes_on("interior", "motion of the inside; see the mesh motion types; by default optimisation");
  p.section("boundary", boundary, "how boundary nodes slide");
  p.passes_on("remap", "how the state is carried over; see the remap types; by default convection");
}

Ale::Ale(const Space& space, const Soil& soil, const std::map<std::string, std::shared_ptr<RigidBody>>& bodies,
         const Section& section, const MeshMotionRegistries& registries)
    : space_(space), soil_(soil), mesh_(space.mesh()), source_(mesh_.gather(space.mesh().coordinates())), corners_(mesh_, {}) {
  section.allow_sections({"interior", "boundary", "remap"});
  Parameters p(section);
  deck_.parameters(p);
  p.passes_on("interior", "motion of the inside; see the mesh motion types");
  p.section("boundary", boundary_, "how boundary nodes slide");
  p.passes_on("remap", "how the state is carried over; see the remap types");
  p.finish();
  const auto with_default = [&](const std::string& name, const std::string& type) {
    const Section part = section.section(name);
    if (!part.has_parameter("type")) part.list().set("type", type);
    return part;
  };
  interior_ = registries.motions.create(with_default("interior", "optimisation"));
  remap_ = registries.remaps.create(with_default("remap", "convection"));
  boundary_.bind(mesh_, source_, bodies, section.section("boundary"));
  corners_ = CornerTriangles(mesh_, boundary_.paths());
  corners_.add_tangents(source_, source_);
  on_path_.assign(mesh_.num_nodes(), 0);
  movable_.assign(mesh_.num_nodes(), 0);
  for (const MeshPath& path : boundary_.paths())
    for (int node : path.nodes) on_path_[node] = 1;
  for (int node = 0; node < mesh_.num_nodes(); ++node) movable_[node] = mesh_.is_vertex(node) && !on_path_[node];
}

bool Ale::due(int step, const State& committed) const {
  return step % deck_.every == 0 && (deck_.quality_below > 1 || quality(committed) < deck_.quality_below);
}

double Ale::quality(const State& state) const { return lowest_quality(mesh_, mesh_.gather(state.coordinates)); }

bool Ale::folded(const Positions& x) const {
  for (const auto& t : corners_.triangles)
    if (!(twice_area(t, x) > 0)) return true;
  return false;
}

void Ale::place_middles(const Positions& boundary, Positions& x) const {
  for (const auto& element : mesh_.elements()) {
    if (order(element.shape) == 1) continue;
    const int corners = num_corners(element.shape);
    const auto& n = element.nodes;
    for (int s = 0; s < corners; ++s) {
      const int middle = n[corners + s];
      for (int d = 0; d < 2; ++d)
        x[middle][d] = on_path_[middle] ? boundary[middle][d] : 0.5 * (x[n[s]][d] + x[n[(s + 1) % corners]][d]);
    }
    if (corners == 3) continue;
    for (int d = 0; d < 2; ++d) {  // transfinite: exact for straight sides
      double sides = 0, ends = 0;
      for (int s = 0; s < 4; ++s) {
        sides += x[n[4 + s]][d];
        ends += x[n[s]][d];
      }
      x[n[8]][d] = 0.5 * sides - 0.25 * ends;
    }
  }
}

std::string Ale::new_positions(const Positions& x_old, const State& state, Positions& x) const {
  const Positions boundary = boundary_.move(x_old, state);
  Positions before = x_old;
  corners_.add_tangents(x_old, before);
  x = before;
  // The boundary moves in as few parts as it can without running over the vertices inside, which follow each part.
  for (double done = 0, part = 1; done < 1;) {
    Positions next = x, curve = boundary;
    const double share = done + part;
    for (int node = 0; node < mesh_.num_nodes(); ++node) {
      if (!on_path_[node]) continue;
      for (int d = 0; share < 1 && d < 2; ++d) curve[node][d] = x_old[node][d] + share * (boundary[node][d] - x_old[node][d]);
      next[node] = curve[node];
    }
    corners_.add_tangents(curve, next);
    if (!folded(next)) {
      interior_->move({corners_, source_, before, movable_, state.time}, next);
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
  place_middles(boundary, x);
  double largest = 0;
  for (const auto& place : x_old) largest = std::max({largest, std::abs(place[0]), std::abs(place[1])});
  for (int node = 0; node < mesh_.num_nodes(); ++node)  // what only rounding moved stays
    if (std::hypot(x[node][0] - x_old[node][0], x[node][1] - x_old[node][1]) < 1e-14 * largest) x[node] = x_old[node];
  return "";
}

void Ale::carry_points(StateStore& store, const Positions& x_old, const Positions& x_new, State& to) const {
  for (const SoilBlock& b : soil_.blocks)
    for (int handle : {b.stress, b.void_ratio, b.law}) {
      const PointView rows = to.arrays[handle];
      const int columns = static_cast<int>(rows.extent(1));
      if (columns == 0) continue;
      const std::vector<double> old = mesh_.gather_points(b.block, b.points, rows);
      std::vector<double> now = old;
      remap_->transfer({mesh_, b, x_old, x_new, store.info(handle).variables, columns, old, now});
      const ElementBlock& elements = space_.mesh().blocks()[b.block];
      for (int e = 0; e < b.elements; ++e)
        for (int q = 0; q < b.points; ++q)
          for (int c = 0; c < columns; ++c)
            rows(e * b.points + q, c) =
                now[static_cast<std::size_t>(mesh_.first_row(static_cast<int>(elements.global_ids[e]), b.points) + q) * columns + c];
    }
}

void Ale::carry_nodes(const Positions& x_old, const Positions& x_new, State& to) const {
  const NodalRemap nodal(mesh_, boundary_.paths(), x_old, x_new);
  for (int f = 0; f < space_.num_fields(); ++f) {
    if (space_.field(f).support == Support::apart) continue;
    for (const NodalView& values : {to.value, to.rate, to.acceleration})
      mesh_.scatter(space_, f, nodal.apply(mesh_.gather(space_, f, values), space_.field(f).components, space_.field(f).support), values);
  }
}

MeshReceipt Ale::relocate(StateStore& store) const {
  MeshReceipt receipt;
  State& state = store.committed();
  const Positions x_old = mesh_.gather(state.coordinates);
  receipt.quality_before = receipt.quality = lowest_quality(mesh_, x_old);
  Positions x_new;
  receipt.veto = new_positions(x_old, state, x_new);
  if (!receipt.veto.empty()) return receipt;
  int worst = 0;
  receipt.quality = lowest_quality(mesh_, x_new, &worst);
  // a mesh that was no better is not made worse by moving it
  if (receipt.quality < std::min(deck_.lowest_quality, 0.9 * receipt.quality_before)) {
    const auto& at = x_new[mesh_.elements()[worst].nodes[0]];
    receipt.veto = "the moved mesh has a scaled Jacobian of " + number(receipt.quality) + " at (" + number(at[0]) + ", " + number(at[1]) + ")";
    return receipt;
  }
  for (int i = 0; i < corners_.of_elements; ++i) {
    const auto& t = corners_.triangles[i];
    for (int node : t)
      receipt.largest_motion = std::max(receipt.largest_motion, std::hypot(x_new[node][0] - x_old[node][0], x_new[node][1] - x_old[node][1]) /
                                                                    std::sqrt(twice_area(t, x_old)));
  }
  receipt.before = take_inventory(soil_, state);
  // The trial state is free between steps: it takes the new state, so that the committed one survives a veto.
  store.begin();
  State& moved = store.trial();
  carry_points(store, x_old, x_new, moved);
  carry_nodes(x_old, x_new, moved);
  mesh_.scatter(x_new, moved.coordinates);
  receipt.after = take_inventory(soil_, moved);
  const auto changed = [&](double before, double after) { return before != 0 && std::abs(after / before - 1) > deck_.mass_tolerance; };
  if (changed(receipt.before.solid, receipt.after.solid))
    receipt.veto = "the remap changes the mass of grains by a share of " + number(receipt.after.solid / receipt.before.solid - 1);
  else if (changed(receipt.before.water, receipt.after.water))
    receipt.veto = "the remap changes the pore water by a share of " + number(receipt.after.water / receipt.before.water - 1);
  if (!receipt.veto.empty()) return receipt;
  store.accept();
  receipt.moved = true;
  return receipt;
}

}  // namespace mudline
