#include "checks/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "checks/body_setup.hpp"
#include "checks/penetration_watch.hpp"
#include "checks/setup.hpp"
#include "checks/stretch_watch.hpp"
#include "core/log.hpp"
#include "discretisation/element_map.hpp"
#include "integrator/overlap.hpp"
#include "physics/soil_points.hpp"

namespace mudline {

namespace {

/// The quantities of the checks in this file. Where a quantity varies over the mesh, its largest value counts.
const Usual own_quantities[] = {
    {"undrained strength", "Pa", {200, 2e6}, "of a material, its largest: soft seabed to weak rock"},
    {"shear modulus", "Pa", {2e4, 2e11}, "of a material, its largest"},
    {"mean effective stress", "Pa", {0, 1e8}, "of a material, its largest"},
    {"overconsolidation ratio", "-", {1 - 1e-6, 200}, "of a material, its largest"},
    {"void ratio", "-", {0.05, 15}, "of a saturated material, its largest"},
    {"hydraulic conductivity", "m/s", {1e-14, 1}, "of a material, its largest"},
    {"consolidation coefficient", "m2/s", {1e-11, 1e3}, "k M / unit weight of a material, its largest"},
    {"body density", "kg/m3", {1000, 20000}, "mass over volume of a body that may move freely"},
    {"first gap", "-", {0, 5}, "distance of a body from the soil over its largest width"},
    {"speed", "m/s", {0, 100}, "of a body where it meets the soil"},
    {"corner",
     "-",
     {0.9, 1.25},
     "radius of the corner that the mesh has on the contact's surface, over that of the body"},
    {"sides under a body", "-", {1, any_size}, "sides of the contact's surface that the body covers"},
    {"drained hole",
     "-",
     {0, 1},
     "depth of a hole under water whose wall a condition of the surface drains, over the body's largest width"},
    {"layer depth", "-", {10, any_size}, "depth of a layer below a released body, over the body's largest width"},
    {"pressure step",
     "-",
     {1, any_size},
     "first step of a stage over h^2/(6 c_v) of the elements at a surface that is drained and suddenly loaded"},
    {"steps", "-", {1, 1e6}, "expected of a stage"}};

std::string text(const char* pattern, double a, double b = 0, double c = 0, double d = 0) {
  char buffer[300];
  std::snprintf(buffer, sizeof buffer, pattern, a, b, c, d);
  return buffer;
}

/// The quantities of all checks.
Doubts all_quantities() {
  Doubts result;
  for (const Usual& quantity : own_quantities) result.declare(quantity);
  PenetrationWatch::declare(result);
  StretchWatch::declare(result);
  for (const auto& check : setup_checks())
    if (*check.quantity.meaning) result.declare(check.quantity);  // one without is declared by another check
  declare_body_checks(result);
  return result;
}

}  // namespace

/// Figures of an element of soil, as means over its points.
struct Plausibility::Element {
  const SoilBlock& block;
  const SoilPoints& points;
  int number;
  double shortest, longest;  // [m] edges
  double height;             // [m] area over the longest side; in space volume over the largest face
  double shear, modulus;     // [Pa] G, drained constrained modulus
  double wave;               // [m/s] fastest wave
  double consolidation;      // [m2/s] c_v; 0 without pore fluid
};

template <class F>
void Plausibility::for_each_element(F&& f) const {
  const State& state = model_.store().committed();
  for (const SoilBlock& b : model_.soil()->blocks) {
    const SoilPoints points(*model_.soil(), b, state);
    for (int e = 0; e < b.elements; ++e) {
      const ElementSize size = ElementMap(b.shape, [&](int a) { return &state.coordinates(b.nodes(e, a), 0); }).size();
      Element at{b, points, e, size.shortest_edge, size.longest_edge, size.height, 0, 0, 0, 0};
      for (int q = 0; q < b.points; ++q) {
        const int row = e * b.points + q;
        const double share = 1.0 / b.points;
        const SoilFigures figures = points.figures(row);
        at.shear += share * figures.shear;
        at.modulus += share * figures.modulus;
        at.wave += share * figures.wave;
        at.consolidation += share * figures.consolidation;
      }
      f(at);
    }
  }
}

EntryDoc Plausibility::document() {
  Parameters p;
  all_quantities().parameters(p);
  return {"section", "plausibility", "what is usual: outside of it the program doubts the deck, and goes on", p.docs(),
          p.sections()};
}

Plausibility::Plausibility(Model& model, const Section& deck) : model_(model), usual_(all_quantities()) {
  Parameters p(deck.section("plausibility"));
  usual_.parameters(p);
  p.finish();
  if (!model.soil()) return;
  if (!model.bodies().empty() && model.mesh().dimension() == 2) {
    const GhostedMesh mesh(model.mesh(), 1);  // one layer of ghosts shows where regions end
    const Positions positions = mesh.gather(model.mesh().coordinates());
    for (const auto& [name, body] : model.bodies()) {
      const BodyPath path({model, *body, deck}, model, mesh, positions);
      const std::string crossed = path.crossing();
      if (!crossed.empty())
        deck.section("bodies").section(name).fail("its prescribed path crosses the boundary between the regions " +
                                                  crossed +
                                                  ": a body cannot pass from one region to another, a film of the "
                                                  "first would stay under its tip; end its path before, or make "
                                                  "them one region, of one material or of layers by the 'top' of "
                                                  "each material, which a body may cross");
      tell_body(path);
      doubt_hole(path, positions, deck);
    }
  }
  tell_materials();
  tell_mesh();
  tell_stages(deck);
  const Setup setup(model, deck);
  look(setup_checks(), setup, usual_);
  look_at_bodies(setup, usual_);
}

void Plausibility::print() const {
  for (const std::string& fact : facts_) log::info(fact);
  for (const std::string& doubt : doubts()) log::warn(doubt);
}

void Plausibility::tell_materials() {
  enum { strength, shear, mean, ocr, voids, k, cv, count };
  const char* const quantity[count] = {"undrained strength",       "shear modulus", "mean effective stress",
                                       "overconsolidation ratio",  "void ratio",    "hydraulic conductivity",
                                       "consolidation coefficient"};
  const char* const symbol[count] = {"s_u", "G", "p'", "OCR", "e", "k", "c_v"};
  std::map<std::string, std::array<Span, count>> found;  // by material; every rank has the same names
  for (const auto& material : model_.soil()->materials) found[material->name];
  for_each_element([&](const Element& at) {
    const int first = at.number * at.block.points;
    bool one = true;  // there is one material only
    for (int q = 1; q < at.block.points; ++q) one = one && &at.points.material(first + q) == &at.points.material(first);
    for (int q = 0; q < at.block.points; ++q) {
      const int row = first + q;
      auto& of = found[at.points.material(row).name];
      of[shear].add(at.points.moduli(row).shear);
      if (at.block.porous() && one) of[cv].add(at.consolidation);
      const double* stress = at.points.stress(row);
      const SoilState soil = at.points.soil_state(row);
      if (soil.undrained_strength) of[strength].add(*soil.undrained_strength);
      if (soil.overconsolidation_ratio) of[ocr].add(*soil.overconsolidation_ratio);
      of[mean].add(0.0 - (stress[0] + stress[1] + stress[2]) / 3);  // 0 without stress, not -0
      if (!at.block.porous()) continue;
      of[voids].add(at.points.void_ratio(row));
      of[k].add(at.points.conductivity(row));
    }
  });
  const Comm& comm = *model_.mesh().comm();
  for (auto& [name, of] : found) {
    std::string line;
    for (int i = 0; i < count; ++i) {
      of[i] = {min_over_ranks(comm, of[i].low), max_over_ranks(comm, of[i].high)};
      if (!of[i].known()) continue;
      line += (line.empty() ? " " : ", ") + std::string(symbol[i]) + " " +
              readable_range(of[i].low, of[i].high, usual_.unit(quantity[i]), 3);
      if (i == mean) stressed_ = stressed_ || of[i].high > 0;
      usual_.judge(quantity[i], of[i].high, "material '" + name + "': the " + quantity[i]);
    }
    facts_.push_back("material '" + name + "':" + line);
  }
}

void Plausibility::tell_mesh() {
  Span side, wave, diffusion;
  for_each_element([&](const Element& at) {
    side.add(at.shortest);
    side.add(at.longest);
    wave.add(at.height / at.wave);
    if (at.consolidation > 0) diffusion.add(at.height * at.height / at.consolidation);
  });
  const Comm& comm = *model_.mesh().comm();
  for (Span* extent : {&side, &wave, &diffusion})
    *extent = {min_over_ranks(comm, extent->low), max_over_ranks(comm, extent->high)};
  shortest_wave_ = wave.low;
  std::string line = "elements: sides of " + readable_range(side.low, side.high, "m", 3) + "; a wave crosses one in " +
                     readable_range(wave.low, wave.high, "s", 2);
  if (diffusion.known())
    line += ", pore pressure spreads through one in " + readable_range(diffusion.low, diffusion.high, "s", 2);
  facts_.push_back(line);
}

void Plausibility::tell_body(const BodyPath& path) {
  const RigidBody& body = path.body;
  const BodyProperties& properties = body.properties();
  const std::string name = "body '" + body.name() + "'";
  const char* const per = properties.geometry == Geometry::plane_strain ? " per metre" : "";
  std::string line = name + ": " + readable(2 * path.radius(), "m", 3) + " wide";
  if (properties.volume > 0) line += text(", volume %.3g m3", properties.volume) + per;
  if (properties.mass > 0) line += ", mass " + readable(properties.mass, "kg") + per;
  if (properties.mass > 0 && properties.volume > 0) {
    const double density = properties.mass / properties.volume, lost = 1000.0 * properties.volume;
    line += ", " + readable(density, "kg/m3") + ", weight in water " + readable(9.81 * (properties.mass - lost), "N");
    if (path.release) usual_.judge("body density", density, name + ": mass over volume");
  }
  if (path.touches_anything()) {
    const double gap = path.first_gap(), rounding = 1e-9 * path.radius();
    line += gap > rounding ? ", " + readable(gap, "m", 3) + " from the soil" : ", on the soil";
  }
  facts_.push_back(line);
  if (!path.touches_anything()) return;
  doubt_body(path, name);
  doubt_shape(path, name);
}

void Plausibility::doubt_body(const BodyPath& path, const std::string& name) {
  const double gap = std::max(0.0, path.first_gap()), width = 2 * path.radius();
  if (width > 0) usual_.judge("first gap", gap / width, name + ": its distance from the soil, in widths,");
  if (path.leaves()) {
    usual_.tell(name + " moves away from the soil: down is negative");
    return;
  }
  const auto arrival = path.arrival();
  if (!arrival && !path.release && path.largest_speed() > 0) usual_.tell(name + " never reaches the soil");
  double speed = path.largest_speed();
  if (path.release && (!arrival || path.places.size() == 1)) {
    const auto [velocity, acceleration] = path.start_of_fall();
    const double square = velocity * velocity - 2 * acceleration * gap;
    speed = std::sqrt(std::max(0.0, square));
    const double time = velocity != 0 || acceleration < 0 ? 2 * gap / std::max(1e-300, std::abs(velocity) + speed) : 0;
    if (gap > 0 && time > path.free_time)
      usual_.tell(name + " needs " + readable(time, "s", 3) + " to reach the soil, and is free for " +
                  readable(path.free_time, "s", 3));
  }
  if (speed > 0) {
    const bool prescribed = speed == path.largest_speed();
    facts_.push_back(name + (prescribed ? ": moved at up to " + readable(speed, "m/s", 3)
                                        : ": " + readable(speed, "m/s", 3) + " where it meets the soil"));
    usual_.judge("speed", speed, name + (prescribed ? ": its largest speed" : ": its speed at the soil"));
  }
  const std::string layer = path.crossing_below(usual_.lowest("layer depth") * width);
  if (!layer.empty())
    usual_.tell(name + " may come to the boundary between the regions " + layer +
                ", which a body cannot cross (plausibility/layer depth)");
}

void Plausibility::doubt_shape(const BodyPath& path, const std::string& name) {
  const RigidBody& body = path.body;
  if (body.of_revolution() && body.properties().geometry == Geometry::plane_strain)
    usual_.tell(name +
                " is a body of revolution by its contour, but the mesh is in plane strain, where it is a wedge "
                "or a wall: 'mesh/geometry' = axisymmetric?");
  if (path.surface_corner() > 0)
    usual_.judge("corner", path.surface_corner() / path.radius(),
                 name + ": the mesh has a corner of the surface at " + readable(path.surface_corner(), "m") +
                     ", the body's radius is " + readable(path.radius(), "m") + "; their ratio");
  if (path.release || path.largest_speed() > 0)
    usual_.judge("sides under a body", static_cast<double>(path.sides_under().size()),
                 name + ": the number of sides of the surface that it covers");
}

/// A pore pressure prescribed on a surface is also prescribed in the hole that a body opens.
void Plausibility::doubt_hole(const BodyPath& path, const Positions& positions, const Section& deck) {
  const Soil& soil = *model_.soil();
  if (soil.pressure < 0 || soil.excess || !path.touches_anything()) return;
  const double lowest = path.lowest(), depth = path.surface_top() - lowest;
  double water = -1e300;  // [Pa] largest pore pressure at the start above `lowest`
  const auto& dof = soil.space->node_dof(soil.pressure);
  for (int node = 0; node < model_.mesh().num_nodes(); ++node)
    if (dof(node) >= 0 && model_.mesh().place(node)[1] >= lowest)
      water = std::max(water, model_.store().committed().value(dof(node)));
  water = max_over_ranks(*model_.mesh().comm(), water);
  for (const auto& condition : model_.conditions()) {
    const bool acts = std::any_of(model_.stages().begin(), model_.stages().end(), [&](const auto& stage) {
      return stage->type != Stage::Type::geostatic && Setup::acts(condition->name, *stage);
    });
    const Section entry = deck.section("boundary conditions").section(condition->name);
    if (!acts || entry.text("type") != "pore pressure") continue;
    const Function value = Setup::function(entry, "value").value_or(Function());
    Span held;
    for (const auto* side : path.sides_under())
      if (side->sets.count(entry.text("set")) > 0)
        for (int node : side->nodes) held.add(value(0, positions[node]));
    if (!held.known() || water <= held.high) continue;
    usual_.judge(
        "drained hole", depth / (2 * path.radius()),
        "body '" + path.body.name() + "': condition '" + condition->name + "' holds " + readable(held.high, "Pa") +
            " on the wall of the hole that it opens too, where down to " + readable(depth, "m", 3) +
            " water at rest has " + readable(water, "Pa") +
            ": count from water at rest ('pore pressure' = excess in the physics biot); the hole's depth, in widths,");
  }
}

/// A load of a stage on one side set.
struct Plausibility::Load {
  std::string set;
  std::vector<Function> components;
  bool anew;              // it did not act in the stage before
  double time, duration;  // [s] begin and duration of the stage
  /// Whether the first step brings more than a tenth of the load's change in the stage.
  bool sudden(double dt, const Point& x) const {
    for (const Function& f : components) {
      const double before = anew ? 0.0 : f(time, x), first = std::abs(f(time + dt, x) - before);
      double most = first;
      for (int i = 1; i <= 20; ++i) most = std::max(most, std::abs(f(time + duration * i / 20, x) - before));
      if (first > 0.1 * most) return true;
    }
    return false;
  }
};

std::vector<Plausibility::Load> Plausibility::loads(const Section& deck, std::size_t number) const {
  const Stage& stage = *model_.stages()[number];
  double time = 0;
  for (std::size_t i = 0; i < number; ++i) time += model_.stages()[i]->duration;
  std::vector<Load> result;
  for (const std::string& name : stage.conditions) {
    const Section entry = deck.section("boundary conditions").section(name);
    const std::string type = entry.text("type");
    if (type != "traction" && type != "pressure") continue;
    Load load{entry.text("set"), {}, number == 0 && !stressed_, time, stage.duration};
    if (number > 0) {
      const auto& before = model_.stages()[number - 1]->conditions;
      load.anew = std::find(before.begin(), before.end(), name) == before.end();
    }
    for (const char* component : {"x", "y", "z", "value"})
      load.components.push_back(Setup::function(entry, component).value_or(Function()));
    result.push_back(load);
  }
  return result;
}

double Plausibility::pressure_time(const Section& deck, std::size_t number) const {
  const Stage& stage = *model_.stages()[number];
  const Space& space = model_.space();
  const int p = space.find("pore pressure"), n = space.dofs()->num_overlap_dofs();
  Constraints held(n);
  model_.prescribe(stage, 0, stage.duration, model_.store().committed(), held);
  std::set<std::pair<int, int>> beside;  // (block, element)
  for (const Load& load : loads(deck, number))
    for (const Side& side : model_.mesh().side_sets().at(load.set)) {
      const ElementBlock& block = model_.mesh().blocks()[side.block];
      const std::vector<int> local = side_nodes(block.shape, side.side);
      const int corners = num_corners(side_shape(block.shape, side.side));
      bool drained = true;
      for (int c = 0; c < corners; ++c)
        drained = drained && held.given(space.node_dof(p)(block.nodes(side.element, local[c])));
      if (drained && load.sudden(stage.control.initial, middle_of(model_.mesh(), side)))
        beside.insert({side.block, side.element});
    }
  double longest = 0;
  for_each_element([&](const Element& at) {
    if (at.consolidation > 0 && beside.count({at.block.block, at.number}))
      longest = std::max(longest, at.height * at.height / (6 * at.consolidation));
  });
  return max_over_ranks(*model_.mesh().comm(), longest);
}

void Plausibility::tell_stages(const Section& deck) {
  const bool porous = model_.soil()->pressure >= 0;
  for (std::size_t i = 0; i < model_.stages().size(); ++i) {
    const Stage& stage = *model_.stages()[i];
    if (stage.type == Stage::Type::geostatic) continue;
    const std::string name = "stage '" + stage.name + "'";
    const double dt = stage.control.initial, steps = stage.control.steps_for(stage.duration, dt);
    std::string line = name + text(": about %.0f steps, the first of ", steps) + readable(dt, "s", 3);
    if (stage.type == Stage::Type::dynamic)
      line += ", " + readable(dt / shortest_wave_, "-") + " times that of a wave through an element";
    facts_.push_back(line);
    usual_.judge("steps", steps, name + ": the expected number of steps");
    const double time = porous ? pressure_time(deck, i) : 0;
    if (time > 0)
      usual_.judge("pressure step", dt / time,
                   name + ": the first step of " + readable(dt, "s", 3) +
                       " at a drained surface that is loaded, over h^2/(6 c_v) = " + readable(time, "s", 3) +
                       " (refine there, or pore pressures oscillate),");
  }
}

}  // namespace mudline
