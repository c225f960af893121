#include <algorithm>
#include <cmath>

#include "checks/setup.hpp"
#include "core/pi.hpp"
#include "discretisation/shapes.hpp"
#include "integrator/overlap.hpp"
#include "physics/soil_points.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

constexpr const char* take_quadratic_cells = "take quadratic cells (tri6 or quad9, tet10, wedge15 or hex27)";

/// A loaded or pressed part of the upper surface: footing, embankment.
struct Patch {
  std::string name;   // of the condition
  double half = 0;    // [m] half width
  double reach = 1;   // reach of its collapse mechanism over that of a strip
  double beside = 0;  // [m] from its edge to the nearest side of the mesh that is no plane of symmetry
  double cells = 0;   // number over the half width; quadratic cells count twice
  std::array<Span, 3> box;
};

bool moves(const Setup& setup, const Setup::ConditionEntry& condition) {
  for (const char* component : {"value", "x", "y", "z"}) {
    const Span span = setup.given(condition.entry, component, 0, setup.end(), &setup.set(condition.set));
    if (span.known() && span.largest() != 0) return true;
  }
  return false;
}

/// Whether the upper surface has nodes outside of a box. Collective.
bool goes_on(const Setup& setup, const std::array<Span, 3>& box) {
  const int up = setup.vertical();
  const Bounds& mesh = setup.mesh().bounds();
  const double slack = 1e-6 * mesh.extent();
  int outside = 0;
  for (int node = 0; node < setup.mesh().num_owned_nodes(); ++node) {
    const Point x = setup.mesh().place(node);
    bool beside = false;
    for (int i = 0; i < up; ++i) beside = beside || x[i] < box[i].low - slack || x[i] > box[i].high + slack;
    if (beside && x[up] > mesh.high[up] - slack) ++outside;
  }
  return sum_over_ranks(*setup.mesh().comm(), outside) > 0;
}

/// Loaded or pressed parts of the upper surface that end within the mesh along a horizontal axis; the axis in which
/// they are narrowest counts.
std::vector<Patch> patches(const Setup& setup) {
  std::vector<Patch> found;
  const int up = setup.vertical();
  const Bounds& mesh = setup.mesh().bounds();
  for (const auto& condition : setup.conditions()) {
    const bool presses = condition.type == "pressure" || condition.type == "traction" ||
                         condition.type == "displacement" || condition.type == "velocity";
    if (!presses || !setup.mesh().has_side_set(condition.set) || !moves(setup, condition)) continue;
    const Setup::SetFigures& set = setup.set(condition.set);
    if (set.sides == 0 || set.normal[up] < 0.9 || set.box[up].high < mesh.high[up] - 1e-6 * mesh.extent()) continue;
    int narrow = -1;
    for (int i = 0; i < up; ++i)
      if (set.box[i].length() < 0.9 * setup.extent(i) && (narrow < 0 || set.box[i].length() < set.box[narrow].length()))
        narrow = i;
    if (narrow < 0 || !goes_on(setup, set.box)) continue;
    const Span& width = set.box[narrow];
    const double slack = 1e-6 * mesh.extent();
    const bool low = width.low <= mesh.low[narrow] + slack, high = width.high >= mesh.high[narrow] - slack;
    const bool half = low || high;  // the other half lies beyond a plane or axis of symmetry
    Patch patch;
    patch.name = condition.name;
    patch.half = half ? width.length() : 0.5 * width.length();
    const double left = low ? 1e300 : width.low - mesh.low[narrow],
                 right = high ? 1e300 : mesh.high[narrow] - width.high;
    patch.beside = std::min(left, right);
    patch.cells = set.side[narrow] > 0 ? patch.half / set.side[narrow] * set.order : any_size;
    patch.box = set.box;
    bool round = setup.mesh().geometry() == Geometry::axisymmetric;  // or square
    for (int i = 0; i < up; ++i) round = round || (i != narrow && set.box[i].length() < 0.9 * setup.extent(i));
    if (round) patch.reach = 0.5;
    found.push_back(patch);
  }
  return found;
}

/// Friction angle [rad] of the strength that a limit load would need: the largest of the materials; 0: undrained.
double friction(const Setup& setup) {
  double largest = 0;
  for (const Section& entry : setup.materials()) {
    const Span given = setup.given(entry.section("skeleton"), "friction angle [deg]");
    if (given.known()) largest = std::max(largest, given.high * pi / 180);
  }
  return largest;
}

void cells_under_load(const Setup& setup, const Judge& judge) {
  for (const Patch& patch : patches(setup))
    judge(patch.cells,
          "condition '" + patch.name + "': the number of cells under its half width of " +
              readable(patch.half, "m", 3) + ", those of quadratic cells counted twice,",
          "refine there: stresses change most at its edge");
}

/// Prandtl's mechanism of a strip reaches B tan(45 + phi/2) exp(pi/2 tan phi) beyond its edges.
void domain_width(const Setup& setup, const Judge& judge) {
  const double phi = friction(setup);
  for (const Patch& patch : patches(setup)) {
    const double reach =
        patch.reach * 2 * patch.half * std::tan(0.25 * pi + 0.5 * phi) * std::exp(0.5 * pi * std::tan(phi));
    judge(patch.beside / reach,
          "condition '" + patch.name + "': the distance from its edge to the side of the mesh, " +
              readable(patch.beside, "m", 3) + ", over the reach of a collapse, " + readable(reach, "m", 3) + ",",
          "widen the mesh: the sides hold what should move");
  }
}

void domain_depth(const Setup& setup, const Judge& judge) {
  const double phi = friction(setup);
  for (const Patch& patch : patches(setup)) {
    const double reach = patch.reach * patch.half * std::cos(phi) / std::cos(0.25 * pi + 0.5 * phi) *
                         std::exp((0.25 * pi + 0.5 * phi) * std::tan(phi));
    judge(setup.extent(setup.vertical()) / reach,
          "condition '" + patch.name + "': the depth of the mesh, " + readable(setup.extent(setup.vertical()), "m", 3) +
              ", over that of a collapse, " + readable(reach, "m", 3) + ",",
          "deepen the mesh, where the base is no rock");
  }
}

void absorbing_distance(const Setup& setup, const Judge& judge) {
  const std::vector<Patch> loaded = patches(setup);
  for (const auto& condition : setup.conditions()) {
    if (condition.type != "absorbing") continue;
    const Setup::SetFigures& set = setup.set(condition.set);
    for (const Patch& patch : loaded) {
      double square = 0;
      for (int i = 0; i < setup.dimension(); ++i) {
        const double away = std::max({0.0, set.box[i].low - patch.box[i].high, patch.box[i].low - set.box[i].high});
        square += away * away;
      }
      judge(std::sqrt(square) / (2 * patch.half),
            "condition '" + condition.name + "': its distance from the loaded '" + patch.name +
                "', over that load's width,",
            "dashpots absorb plane waves that meet them head on: put them farther away");
    }
  }
}

/// Whether the cells of a block are linear ones that lock where the soil keeps its volume.
bool locks(const SoilBlock& block) { return order(block.shape) == 1 && block.dilatation_terms == 0; }

/// Linear cells lock where the soil keeps its volume: by its elasticity, or where it yields without change of volume.
void linear_cells(const Setup& setup, const Judge& judge) {
  if (setup.porous()) return;  // its volume is kept by the pore pressure
  const Soil& soil = *setup.model().soil();
  const State& state = setup.model().store().committed();
  double stiffest = 0;
  for (const SoilBlock& b : soil.blocks) {
    if (!locks(b)) continue;
    const SoilPoints points(soil, b, state);
    for (int row = 0; row < b.elements * b.points; ++row) {
      const ElasticModuli m = points.moduli(row);
      stiffest = std::max(stiffest, m.bulk / m.shear);
    }
  }
  stiffest = max_over_ranks(*setup.mesh().comm(), stiffest);
  if (stiffest == 0) return;
  judge(stiffest, "K/G of soil in linear cells",
        std::string("they lock where the volume is kept, and are up to some times too stiff: ") + take_quadratic_cells);
}

/// Laws of constant volume in plastic flow.
void linear_cells_that_yield(const Setup& setup, const Judge& judge) {
  if (setup.porous()) return;
  bool linear = false;
  for (const SoilBlock& b : setup.model().soil()->blocks) linear = linear || locks(b);
  if (!linear) return;
  for (const Section& entry : setup.materials()) {
    const std::string law = Setup::word(entry.section("skeleton"), "type");
    const Span dilation = setup.given(entry.section("skeleton"), "dilation angle [deg]");
    const bool frictional = law == "mohr-coulomb" || law == "drucker-prager";
    const bool keeps =
        law == "tresca" || law == "von mises" || (frictional && !(dilation.known() && dilation.high > 0));
    if (keeps)
      judge(1, "material '" + entry.name() + "': the number of laws that yield at constant volume in linear cells",
            std::string("collapse loads come out far too high there: ") + take_quadratic_cells);
  }
}

/// Number of stages with inertia.
int dynamic_stages(const Setup& setup) {
  const auto& stages = setup.model().stages();
  return static_cast<int>(std::count_if(stages.begin(), stages.end(),
                                        [](const auto& stage) { return stage->type == Stage::Type::dynamic; }));
}

void damping_of_inertia(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.physics())
    if (setup.given(entry, "mass damping").high > 0)
      judge(dynamic_stages(setup),
            "physics '" + entry.name() + "': the number of dynamic stages for its 'mass damping'",
            "without inertia it has no effect");
}

void damping(const Setup& setup, const Judge& judge) {
  const auto& soil = setup.soil();
  if (dynamic_stages(setup) == 0 || !(soil.density > 0) || !(soil.shear > 0)) return;
  for (const Section& entry : setup.physics()) {
    const Span mass = setup.given(entry, "mass damping"), stiffness = setup.given(entry, "stiffness damping");
    const double a = mass.known() ? mass.high : 0, b = stiffness.known() ? stiffness.high : 0;
    if (a == 0 && b == 0) continue;
    const double omega = 0.5 * pi * std::sqrt(soil.shear / soil.density) / setup.extent(setup.vertical());
    judge(0.5 * (a / omega + b * omega),
          "physics '" + entry.name() + "': the damping ratio of the first mode, of " + told(omega) + " rad/s,",
          "Rayleigh damping is alpha/(2 omega) + beta omega/2: lower 'mass damping' or 'stiffness damping'; "
          "soils have 0.01 to 0.1");
  }
}

void mesh_size(const Setup& setup, const Judge& judge) {
  judge(setup.longest_extent(), "the largest extent of the mesh", "lengths are in m (10000 may be mm, 0.001 km)");
}

void tolerance(const Setup& setup, const char* name, const Judge& judge) {
  const Span given = setup.given(setup.deck().section("solver"), name);
  if (!given.known()) return;
  judge(given.high, std::string("solver: '") + name + "'", "steps that are not solved drift; the default serves");
}

void residual_tolerance(const Setup& setup, const Judge& judge) { tolerance(setup, "residual tolerance", judge); }
void update_tolerance(const Setup& setup, const Judge& judge) { tolerance(setup, "update tolerance", judge); }

/// Gravity that acts at once on soil without stress, in a stage with inertia: the soil falls and swings.
void sudden_weight(const Setup& setup, const Judge& judge) {
  if (setup.gravity() == 0 || setup.model().stages().front()->type != Stage::Type::dynamic) return;
  const Section& entry = *setup.gravity_entry();
  if (Setup::word(entry.section("initial state"), "type", "stress free") != "stress free") return;
  const auto factor = setup.function(entry, "gravity factor");
  const Span range = setup.given(entry, "gravity factor");
  judge(factor ? std::abs((*factor)(0, {})) / std::max(1e-300, std::abs(range.largest())) : 1.0,
        "the share of gravity that acts at once on soil without stress in the dynamic stage '" +
            setup.model().stages().front()->name + "'",
        "begin with a geostatic start or stage, or let 'gravity factor' grow slowly");
}

}  // namespace

std::vector<Check<Setup>> domain_checks() {
  return {
      {{"cells under a load",
        "-",
        {6, any_size},
        "over the half width of a loaded or pressed part of the upper surface, "
        "those of quadratic cells counted twice"},
       cells_under_load},
      {{"domain width",
        "-",
        {1, any_size},
        "from the edge of a loaded part to the side, over the reach of a collapse "
        "(Prandtl; half of it for squares and circles)"},
       domain_width},
      {{"domain depth", "-", {1, any_size}, "of the mesh below a loaded part, over that of a collapse (Prandtl)"},
       domain_depth},
      {{"absorbing distance", "-", {2, any_size}, "of an absorbing side from a load, over the load's width"},
       absorbing_distance},
      {{"linear cells", "-", {0, 20}, "largest K/G of single-phase soil in linear cells; 20 is Poisson's ratio 0.476"},
       linear_cells},
      {{"yielding linear cells", "-", {0, 0}, "number of laws that yield at constant volume in linear cells"},
       linear_cells_that_yield},
      {{"damping ratio", "-", {0, 0.3}, "of the first shear mode of the soil's height, by Rayleigh damping"}, damping},
      {{"damping of inertia", "-", {1, any_size}, "number of dynamic stages, where a physics has mass damping"},
       damping_of_inertia},
      {{"mesh size", "m", {0.02, 3000}, "largest extent of the mesh"}, mesh_size},
      {{"residual tolerance", "-", {1e-14, 1e-3}, "of the solver, as given"}, residual_tolerance},
      {{"update tolerance", "-", {1e-14, 5e-2}, "of the solver, as given"}, update_tolerance},
      {{"sudden weight",
        "-",
        {0, 0.1},
        "share of gravity that a dynamic first stage puts at once on soil without stress"},
       sudden_weight},
  };
}

}  // namespace mudline
