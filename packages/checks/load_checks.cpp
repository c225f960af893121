#include <algorithm>
#include <cmath>

#include "checks/setup.hpp"
#include "integrator/overlap.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

using Condition = Setup::ConditionEntry;

std::string called(const Condition& condition) { return "condition '" + condition.name + "': "; }

bool is_load(const Condition& condition) { return condition.type == "traction" || condition.type == "pressure"; }

/// The entries of a condition that are functions of time and place.
std::vector<std::string> components(const Condition& condition) {
  if (condition.type == "pressure" || condition.type == "pore pressure" || condition.type == "flux" ||
      condition.type == "value")
    return {"value"};
  return {"x", "y", "z"};
}

/// Range of a component's values over the stages in which the condition acts, on its set, or anywhere in the mesh.
Span over_stages(const Setup& setup, const Condition& condition, const std::string& component, bool anywhere = false) {
  Span all;
  const auto& stages = setup.model().stages();
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (!Setup::acts(condition.name, *stages[i])) continue;
    const Span span = setup.given(condition.entry, component, setup.begin(i), setup.begin(i + 1),
                                  anywhere ? nullptr : &setup.set(condition.set));
    if (!span.known()) continue;
    all.add(span.low);
    all.add(span.high);
  }
  return all;
}

/// Largest absolute value over the condition's components, and whether any is given.
std::pair<double, bool> largest(const Setup& setup, const Condition& condition) {
  double size = 0;
  bool given = false;
  for (const std::string& component : components(condition)) {
    const Span span = over_stages(setup, condition, component);
    if (!span.known()) continue;
    given = true;
    size = std::max(size, std::abs(span.largest()));
  }
  return {size, given};
}

void load_size(const Setup& setup, const Judge& judge) {
  if (setup.scales()) return;
  for (const Condition& condition : setup.conditions()) {
    if (!is_load(condition)) continue;
    const auto [size, given] = largest(setup, condition);
    if (given && size > 0)
      judge(size, called(condition) + "its largest size", "give it in Pa (50 may be kPa, 0.1 MPa)");
  }
}

void load_at_all(const Setup& setup, const Judge& judge) {
  for (const Condition& condition : setup.conditions()) {
    if (!is_load(condition) && condition.type != "flux" && condition.type != "velocity") continue;
    const auto [size, given] = largest(setup, condition);
    // a zero is meant where the deck writes it as a number, or as a function that is not zero elsewhere
    bool written = false, elsewhere = false;
    for (const std::string& component : components(condition)) {
      const auto value = setup.function(condition.entry, component);
      written = written || (value && !value->is_constant());
      const Span span = over_stages(setup, condition, component, true);
      elsewhere = elsewhere || (span.known() && span.largest() != 0);
    }
    if (given && size == 0 && written && !elsewhere)
      judge(size, called(condition) + "the largest size of its function, in the stages in which it acts,",
            "the time of functions is that of the whole run: look at their times and at the stages' "
            "'conditions'");
  }
}

void load_over_stiffness(const Setup& setup, const Judge& judge) {
  for (const Condition& condition : setup.conditions()) {
    if (!is_load(condition) || !(setup.soil().modulus > 0)) continue;
    const double size = largest(setup, condition).first;
    if (size > 0)
      judge(size / setup.soil().modulus,
            called(condition) + "its largest size, " + readable(size, "Pa", 3) + ", over the soil's stiffness, " +
                readable(setup.soil().modulus, "Pa", 3) + ",",
            "give loads and moduli in Pa");
  }
}

/// Largest load into the soil over its largest size, for soil that bears by friction or is saturated.
void load_direction(const Setup& setup, const Judge& judge) {
  bool loose = setup.porous();
  for (const Section& entry : setup.materials())
    loose = loose || setup.given(entry.section("skeleton"), "friction angle [deg]").known();
  for (const Condition& condition : setup.conditions()) {
    if (!is_load(condition) || !loose) continue;
    const Setup::SetFigures& set = setup.set(condition.set);
    if (length(set.normal) < 0.9) continue;  // the set is no plane
    double most = 0;                         // largest load into the soil
    double size = 0;
    for (const std::string& component : components(condition)) {
      const Span span = over_stages(setup, condition, component);
      if (!span.known()) continue;
      const double along = component == "value" ? 1 : -set.normal[component[0] - 'x'];
      if (std::abs(along) < 0.9) continue;
      most = std::max({most, along * span.low, along * span.high});
      size = std::max(size, std::abs(span.largest()));
    }
    if (size > 0)
      judge(most / size, called(condition) + "its largest part into the soil, over its size,",
            "it only pulls: a 'pressure' presses where it is positive, a 'traction' where it points into "
            "the soil");
  }
}

/// Times [s] from the stage's start at which its steps end when none is cut.
std::vector<double> step_ends(const Stage& stage) {
  std::vector<double> ends{0};
  double dt = stage.control.initial;
  while (ends.back() < stage.duration * (1 - 1e-9) && ends.size() < 5000) {
    ends.push_back(std::min(stage.duration, ends.back() + dt));
    dt = std::min(dt * stage.control.growth, stage.control.maximum);
  }
  return ends;
}

/// Whether most of a function's change between two moments happens at once, which no step resolves.
bool jumps(const Function& f, const Point& x, double from, double to, double change) {
  double first = f(from, x), last = f(to, x);
  for (int halving = 0; halving < 30; ++halving) {
    const double middle = 0.5 * (from + to), value = f(middle, x);
    if (std::abs(value - first) > 0.5 * std::abs(last - first)) {
      to = middle;
      last = value;
    } else {
      from = middle;
      first = value;
    }
  }
  return std::abs(last - first) > 0.5 * change;
}

/// Largest deviation of a function from the straight line between a step's ends, over its range in the stage; sampled
/// within each step. Without inertia a load may rise early or late in a step, so only values beyond both ends count.
double unresolved(const Function& f, const Point& x, double begin, const std::vector<double>& ends, bool inertia) {
  constexpr int parts = 8;
  Span range;
  double most = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double from = begin + ends[i], to = begin + ends[i + 1], first = f(from, x), last = f(to, x);
    range.add(first);
    double before = first, away = 0, change = 0, at = from;  // the sample with the largest change begins at `at`
    for (int k = 1; k <= parts; ++k) {
      const double share = static_cast<double>(k) / parts, now = f(from + (to - from) * share, x);
      range.add(now);
      const double line =
          inertia ? first + share * (last - first) : std::clamp(now, std::min(first, last), std::max(first, last));
      away = std::max(away, std::abs(now - line));
      if (std::abs(now - before) > change) {
        change = std::abs(now - before);
        at = from + (to - from) * (k - 1) / parts;
      }
      before = now;
    }
    if (away > most && !jumps(f, x, at, at + (to - from) / parts, change)) most = away;
  }
  return range.length() > 0 ? most / range.length() : 0;
}

void load_steps(const Setup& setup, const Judge& judge) {
  const auto& stages = setup.model().stages();
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const Stage& stage = *stages[i];
    if (stage.type == Stage::Type::geostatic || stage.control.error_tolerance > 0) continue;
    const std::vector<double> ends = step_ends(stage);
    for (const Condition& condition : setup.conditions(stage)) {
      double worst = 0;
      for (const std::string& component : components(condition)) {
        const auto f = setup.function(condition.entry, component);
        if (!f || f->steady()) continue;
        Point x{};
        for (int k = 0; k < setup.dimension(); ++k) {
          const Span& box = setup.set(condition.set).box[k];
          x[k] = box.known() ? 0.5 * (box.low + box.high) : 0;
        }
        worst = std::max(worst, unresolved(*f, x, setup.begin(i), ends, stage.type == Stage::Type::dynamic));
      }
      if (worst > 0)
        judge(worst,
              "stage '" + stage.name + "', condition '" + condition.name +
                  "': the part of its function that the steps pass over, of its range,",
              "take steps of a tenth of its shortest rise or period; the first is " +
                  readable(stage.control.initial, "s", 3) + ", the largest " + readable(stage.control.maximum, "s", 3));
    }
  }
}

void wave_step(const Setup& setup, const Judge& judge) {
  const double longest = setup.longest_extent();
  for (const auto& stage : setup.model().stages())
    if (stage->type == Stage::Type::dynamic && setup.soil().density > 0 && setup.model().bodies().empty())
      judge(stage->control.initial * std::sqrt(setup.soil().modulus / setup.soil().density) / longest,
            "stage '" + stage->name + "': its first step, over the time in which a wave crosses the mesh,",
            "give times in s, and steps that resolve the waves; without them the stage is quasi-static");
}

/// Prescribed displacements, those from velocities too, over the largest extent of the mesh.
void prescribed_displacement(const Setup& setup, const Judge& judge) {
  const double longest = setup.longest_extent();
  const auto& stages = setup.model().stages();
  for (const Condition& condition : setup.conditions()) {
    if (condition.type != "displacement" && condition.type != "velocity") continue;
    double distance = 0;
    for (std::size_t i = 0; i < stages.size(); ++i) {
      if (!Setup::acts(condition.name, *stages[i])) continue;
      for (const std::string& component : components(condition)) {
        const Span span =
            setup.given(condition.entry, component, setup.begin(i), setup.begin(i + 1), &setup.set(condition.set));
        if (!span.known()) continue;
        const double size = std::abs(span.largest());
        distance = std::max(distance, condition.type == "velocity" ? size * stages[i]->duration : size);
      }
    }
    if (distance > 0)
      judge(distance / longest,
            called(condition) + "its largest displacement, " + readable(distance, "m", 3) +
                ", over the largest extent of the mesh,",
            "give m and m/s (-5 may be mm)");
  }
}

/// Displacements that a condition prescribes as a stage begins, after the stage before has set all to zero.
void displacement_after_reset(const Setup& setup, const Judge& judge) {
  const auto& stages = setup.model().stages();
  for (std::size_t i = 1; i < stages.size(); ++i) {
    if (!stages[i - 1]->reset_displacements) continue;
    for (const Condition& condition : setup.conditions(*stages[i])) {
      if (condition.type != "displacement") continue;
      double jump = 0;
      for (const std::string& component : components(condition)) {
        const double begin = setup.begin(i);
        const Span span = setup.given(condition.entry, component, begin, begin, &setup.set(condition.set));
        const auto value = setup.function(condition.entry, component);
        if (span.known() && value && !value->steady()) jump = std::max(jump, std::abs(span.largest()));
      }
      judge(jump, "stage '" + stages[i]->name + "', " + called(condition) + "its displacement at the stage's begin",
            "stage '" + stages[i - 1]->name +
                "' sets the displacements to zero at its end, and this one jumps: let its function begin at 0 there");
    }
  }
}

/// Prescribed pore pressures that are not zero.
void prescribed_pressure(const Setup& setup, const Judge& judge) {
  if (setup.scales()) return;
  for (const Condition& condition : setup.conditions()) {
    if (condition.type != "pore pressure") continue;
    const Span span = over_stages(setup, condition, "value");
    if (span.known() && span.largest() != 0)
      judge(span.largest(), called(condition) + "its largest value",
            "give the pore pressure in Pa, compression positive (50 may be kPa, 5 a height of water)");
  }
}

void prescribed_temperature(const Setup& setup, const Judge& judge) {
  for (const Condition& condition : setup.conditions()) {
    if (condition.type != "value" || Setup::word(condition.entry, "field") != "temperature") continue;
    const Span span = over_stages(setup, condition, "value");
    for (double value : span.ends())
      judge(value, called(condition) + "its temperature", "give degrees Celsius (293 may be kelvins)");
  }
}

void hydrostatic_weight(const Setup& setup, const Judge& judge) {
  for (const Condition& condition : setup.conditions()) {
    const Span span = setup.given(condition.entry, "unit weight");
    if (condition.type == "hydrostatic pressure" && span.known())
      judge(span.high, called(condition) + "'unit weight'", "give it in N/m3, as 9810 (9.81 is kN/m3)");
  }
}

/// Discharge over the conductivity: the hydraulic gradient that it needs.
void flux_gradient(const Setup& setup, const Judge& judge) {
  for (const Condition& condition : setup.conditions()) {
    if (condition.type != "flux" || Setup::word(condition.entry, "field", "pore pressure") != "pore pressure") continue;
    const auto [size, given] = largest(setup, condition);
    if (given && size > 0 && setup.soil().conductivity > 0)
      judge(size / setup.soil().conductivity, called(condition) + "the hydraulic gradient that its discharge needs",
            "give m/s (1 may be mm a day, 1.2e-8 m/s)");
  }
}

/// Largest jump of the pore pressure that a condition makes at a geostatic start.
void drawdown(const Setup& setup, const Judge& judge) {
  const Soil& soil = *setup.model().soil();
  if (!setup.porous() || soil.excess || setup.gravity() == 0 || !Setup::starts_geostatic(setup.deck())) return;
  const State& state = setup.model().store().committed();
  const auto& dof = soil.space->node_dof(soil.pressure);
  const auto& stages = setup.model().stages();
  for (const auto& condition : setup.model().conditions()) {
    const Stage* first = nullptr;
    double begin = 0;
    for (std::size_t i = 0; i < stages.size(); ++i) {
      if (stages[i]->type == Stage::Type::geostatic || !Setup::acts(condition->name, *stages[i])) continue;
      first = stages[i].get();
      begin = setup.begin(i);
      break;
    }
    if (!first) continue;
    Constraints held(setup.model().space().dofs()->num_overlap_dofs());
    condition->prescribe(begin, begin + 1e-6 * first->duration, state, held);
    double most = 0;
    for (int node = 0; node < setup.mesh().num_nodes(); ++node)
      if (dof(node) >= 0 && held.given(dof(node)))
        most = std::max(most, std::abs(held.value(dof(node)) - state.value(dof(node))));
    most = max_over_ranks(*setup.mesh().comm(), most);
    if (most > 0)
      judge(most,
            "condition '" + condition->name + "': the jump of the pore pressure that it brings to stage '" +
                first->name + "'",
            "it does not fit the start's 'water level'; give pressures of that level, or let them change "
            "with time where the water is drawn down");
  }
}

/// Number of nodes at which a stage prescribes pore pressures.
int drained_nodes(const Setup& setup, const Stage& stage, double begin) {
  Constraints held(setup.model().space().dofs()->num_overlap_dofs());
  setup.model().prescribe(stage, begin, begin + stage.duration, setup.model().store().committed(), held);
  const auto& dof = setup.model().soil()->space->node_dof(setup.model().soil()->pressure);
  int count = 0;
  for (int node = 0; node < setup.mesh().num_owned_nodes(); ++node)
    if (dof(node) >= 0 && held.given(dof(node))) ++count;
  return sum_over_ranks(*setup.mesh().comm(), count);
}

/// Longest drainage path [m]: from the corners and the middle of the mesh's box to the nearest box of a drained set.
double drainage_path(const Setup& setup, const Stage& stage) {
  const Bounds& box = setup.mesh().bounds();
  const int n = setup.dimension();
  double longest = 0;
  for (int corner = 0; corner <= 1 << n; ++corner) {
    double nearest = 1e300;
    for (const Condition& condition : setup.conditions(stage)) {
      if (condition.type != "pore pressure" && condition.type != "hydrostatic pressure") continue;
      const Setup::SetFigures& set = setup.set(condition.set);
      double square = 0;
      for (int i = 0; i < n; ++i) {
        const double x = corner == 1 << n  ? 0.5 * (box.low[i] + box.high[i])
                         : corner >> i & 1 ? box.high[i]
                                           : box.low[i];
        const double away = std::max({0.0, set.box[i].low - x, x - set.box[i].high});
        square += away * away;
      }
      nearest = std::min(nearest, std::sqrt(square));
    }
    if (nearest < 1e300) longest = std::max(longest, nearest);
  }
  return longest;
}

void drained_sides(const Setup& setup, const Judge& judge) {
  if (!setup.porous() || !setup.model().bodies().empty()) return;
  const auto& stages = setup.model().stages();
  double smallest = 1e300;
  for (int i = 0; i < setup.dimension(); ++i) smallest = std::min(smallest, setup.extent(i));
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const Stage& stage = *stages[i];
    if (stage.type != Stage::Type::quasi_static) continue;
    const double spread = setup.soil().consolidation * stage.duration / (0.25 * smallest * smallest);
    bool flow = false;
    for (const Condition& condition : setup.conditions(stage)) flow = flow || condition.type == "flux";
    if (spread > 0.01 && !flow)
      judge(static_cast<double>(drained_nodes(setup, stage, setup.begin(i))),
            "stage '" + stage.name + "': the number of nodes with a prescribed pore pressure",
            "no water can leave although the stage lasts long enough (T_v " + told(spread) +
                "): add a condition 'pore pressure' and list it in the stage's 'conditions'");
  }
}

void consolidation_time(const Setup& setup, const Judge& judge) {
  if (!setup.porous() || !setup.model().bodies().empty() || !(setup.soil().consolidation > 0)) return;
  const auto& stages = setup.model().stages();
  double time = 0, path = 0;
  bool driven = false;
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const Stage& stage = *stages[i];
    if (stage.type == Stage::Type::dynamic) return;
    if (stage.type != Stage::Type::quasi_static || drained_nodes(setup, stage, setup.begin(i)) == 0) continue;
    const double here = drainage_path(setup, stage);
    if (here == 0) continue;
    time += stage.duration;
    path = std::max(path, here);
    for (const Condition& condition : setup.conditions(stage)) driven = driven || is_load(condition);
  }
  if (!driven || path == 0) return;
  judge(setup.soil().consolidation * time / (path * path),
        "c_v t/H^2 of the drained stages, with c_v = " + told(setup.soil().consolidation) +
            " m2/s, t = " + readable(time, "s", 3) + ", H = " + readable(path, "m", 3) + ",",
        "give durations in s and conductivities in m/s: nothing consolidates before 1e-3, all is over at 2");
}

}  // namespace

std::vector<Check<Setup>> load_checks() {
  return {
      {{"load",
        "Pa",
        {200, 1e8},
        "largest size of a pressure or traction that is not 0, on soil with weight or strength"},
       load_size},
      {{"load at all", "-", {1e-300, any_size}, "largest size of a function of time of a load, flux or velocity"},
       load_at_all},
      {{"load over stiffness", "-", {0, 0.5}, "largest size of a load over the soil's mean constrained modulus"},
       load_over_stiffness},
      {{"load direction", "-", {1e-3, 1}, "largest part of a load into a frictional or saturated soil, over its size"},
       load_direction},
      {{"load steps", "-", {0, 0.3}, "part of a load's or a prescribed value's change that lies between the steps"},
       load_steps},
      {{"wave step",
        "-",
        {0, 2},
        "first step of a dynamic stage over the time of a wave of the drained soil through the mesh; not with bodies"},
       wave_step},
      {{"prescribed displacement", "-", {0, 2}, "prescribed displacement over the largest extent of the mesh"},
       prescribed_displacement},
      {{"displacement after reset",
        "m",
        {0, 1e-9},
        "that a function of time prescribes as a stage begins, after 'reset displacements'"},
       displacement_after_reset},
      {{"prescribed pore pressure",
        "Pa",
        {500, 1e8},
        "of a condition, where it is not 0, in soil with weight or strength"},
       prescribed_pressure},
      {{"temperature", "degC", {-30, 200}, ""}, prescribed_temperature},
      {{"hydrostatic unit weight", "N/m3", {6000, 15000}, "of a condition"}, hydrostatic_weight},
      {{"hydraulic gradient", "-", {0, 30}, "that a prescribed discharge needs"}, flux_gradient},
      {{"drawdown", "Pa", {0, 5e3}, "jump of the pore pressure that a condition brings to a geostatic start"},
       drawdown},
      {{"drained nodes",
        "-",
        {1, any_size},
        "with a prescribed pore pressure in a quasi-static stage in which water "
        "could leave; not with bodies"},
       drained_sides},
      {{"consolidation time",
        "-",
        {1e-4, 1e4},
        "c_v t/H^2 of the drained quasi-static stages with loads; not with bodies"},
       consolidation_time},
  };
}

}  // namespace mudline
