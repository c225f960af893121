#include "contact/contact_laws.hpp"

#include "contact/laws/slope_check.hpp"
#include "core/log.hpp"

namespace mudline {

namespace {

/// Warns of a law whose slopes are wrong: Newton's method would fail far from where the fault is.
template <class Law>
void warn_of_slopes(const ContactContext& context, const Section& entry, const Law& law) {
  if (context.remeshed) return;  // checked before the remeshing
  const std::string problem = slope_problem(law);
  if (!problem.empty())
    log::warn(entry.source("type") + ": " + entry.path() + "/type: the law '" + entry.text("type") +
              "' does not conform: " + problem +
              "; steps will hardly converge (`mudline point --conformance` checks it again)");
}

}  // namespace

void ContactLaws::declare_normal_law(Parameters& p) {
  p.passes_on("normal law", "pressure over penetration; see the normal law types; by default linear");
}

void ContactLaws::read(const ContactContext& context, const Section& section) {
  space_ = &context.space;
  pressure_ = space_->find("pore pressure");
  temperature_ = space_->find("temperature");
  strength_ = context.undrained_strength;
  if (section.has_section("friction")) {
    const Section law = section.section("friction");
    friction_ = context.frictions.create(law);
    warn_of_slopes(context, law, *friction_);
    note(friction_->reads(), law);
    if (friction_->effective()) read_.pore_pressure = true;
  }
  if (section.has_section("normal law")) {
    const Section law = section.section("normal law");
    normal_ = context.normal_laws.create(law);
    warn_of_slopes(context, law, *normal_);
    note(normal_->reads(), law);
  }
}

void ContactLaws::note(const SoilQuantities& asked, const Section& law) {
  if (asked.temperature && temperature_ < 0)
    law.fail("this law reads the soil's temperature; it needs a model with the field 'temperature'", "type");
  if (asked.undrained_strength && !strength_)
    law.fail("this law reads the soil's undrained strength, of which the model keeps none", "type");
  if (asked.mean_stress) stress_reader_ = law;
  if (asked.undrained_strength && !asked.strength_if_any) strength_reader_ = law;
  read_.pore_pressure = read_.pore_pressure || asked.pore_pressure;
  read_.temperature = read_.temperature || asked.temperature;
  read_.mean_stress = read_.mean_stress || asked.mean_stress;
  read_.undrained_strength = read_.undrained_strength || asked.undrained_strength;
}

void ContactLaws::check_linear(const Section& section, bool multipliers, bool conserving) const {
  if (normal_->linear()) return;
  const Section law = section.section("normal law");
  if (multipliers)
    law.fail("multipliers need pressures in proportion to the penetration; allowed here: linear", "type");
  if (conserving)
    law.fail("'impact' = conserving needs pressures in proportion to the penetration; allowed here: linear", "type");
}

void ContactLaws::declare_state(const StateStore& store) {
  if (!read_.mean_stress) return;
  stress_.assign(space_->mesh().blocks().size(), {-1, 0});
  for (int handle = 0; handle < store.num_arrays(); ++handle) {
    const ArrayInfo& array = store.info(handle);
    if (array.on == ArrayInfo::On::points && array.variables.front().name == "effective stress")
      stress_[array.block] = {handle, array.points_per_element};
  }
  for (const auto& [handle, points] : stress_)
    if (handle < 0)
      stress_reader_->fail("this law reads the soil's effective stress, of which the physics keeps none", "type");
}

ContactPointLaw ContactLaws::in_step(const StepView& view, double damping) const {
  ContactPointLaw law;
  law.normal_law = normal_.get();
  law.friction = friction_.get();
  if (friction_) {
    law.tangential_factor = friction_->tangential_factor();
  }
  law.time = view.time_end;
  law.dt = view.dt;
  law.impact_damping = view.impact.damping;
  if (view.kind != StepView::Kind::step) return law;
  law.viscous = damping;
  law.start_weight = 1 - view.end_weight;
  return law;
}

int ContactLaws::pressure_nodes(const SurfaceSide& side) const {
  if (pressure_ < 0 || !read_.pore_pressure) return 0;
  return space_->field(pressure_).support == Support::vertices ? num_corners(side.shape) : side.count;
}

const double* ContactLaws::pressure_shape(const SurfaceSide& side, const ContactRule& points, int point) const {
  return pressure_nodes(side) < points.nodes ? &points.corner(point, 0) : &points.shape(point, 0);
}

double ContactLaws::pore_pressure(const SurfaceSide& side, const ContactRule& points, int point,
                                  const ConstNodalView& values) const {
  const int nodes = pressure_nodes(side);
  if (nodes == 0) return 0;
  const double* const shape = pressure_shape(side, points, point);
  double result = 0;
  for (int a = 0; a < nodes; ++a) result += shape[a] * values(space_->node_dof(pressure_)(side.node[a]));
  return result;
}

TouchingSoil ContactLaws::soil(const State& committed, const SurfaceSide& side, const double* xi) const {
  TouchingSoil result;
  if (!read_.pore_pressure) result.pore_pressure = TouchingSoil::unknown;
  if (read_.temperature) result.temperature = temperature(committed, side, xi);
  if (read_.mean_stress) result.mean_stress = mean_stress(committed, side);
  if (read_.undrained_strength) result.undrained_strength = undrained_strength(committed, side, xi);
  return result;
}

double ContactLaws::temperature(const State& committed, const SurfaceSide& side, const double* xi) const {
  const bool corners = space_->field(temperature_).support == Support::vertices;
  const CellShape carrier = corners ? linear_partner(side.shape) : side.shape;
  double shape[max_side_nodes], slope[2 * max_side_nodes], result = 0;
  evaluate_shape(carrier, xi, shape, slope);
  for (int a = 0; a < num_nodes(carrier); ++a)
    result += shape[a] * committed.value(space_->node_dof(temperature_)(side.node[a]));
  return result;
}

double ContactLaws::undrained_strength(const State& committed, const SurfaceSide& side, const double* xi) const {
  const SideCoordinates x = side_coordinates(side, committed.coordinates);
  double shape[max_side_nodes], slope[2 * max_side_nodes];
  evaluate_shape(side.shape, xi, shape, slope);
  Point at{};
  for (int a = 0; a < side.count; ++a) at += shape[a] * x[a];
  return strength_(committed, side.block, side.element, at);
}

double ContactLaws::mean_stress(const State& committed, const SurfaceSide& side) const {
  const auto [handle, points] = stress_[side.block];
  const PointView& stress = committed.arrays[handle];
  double sum = 0;
  for (int q = 0; q < points; ++q)
    for (int i = 0; i < 3; ++i) sum -= stress(side.element * points + q, i);  // tension positive
  return sum / (3 * points);
}

}  // namespace mudline
