#include "simulation/results/resistance.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "integrator/overlap.hpp"
#include "simulation/model.hpp"
#include "simulation/results/result_table.hpp"

namespace mudline {

namespace {

constexpr const char* mudline_height = "height of the mudline";
constexpr const char* start_depth = "depth of the tip at the start";

/// The sum of a column over the contacts of a body; nothing where none of them has it.
std::optional<double> over_contacts(const RunView& run, const RigidBody& body, const std::string& column) {
  std::optional<double> sum;
  for (const auto& [name, contact] : run.model.contacts()) {
    if (contact->partners().body != &body) continue;
    const auto found = run.report.find("contact/" + name + "/" + column);
    if (found != run.report.end()) sum = sum.value_or(0.0) + found->second.value;
  }
  return sum;
}

bool has_contact(const Model& model, const RigidBody& body) {
  const auto& contacts = model.contacts();
  return std::any_of(contacts.begin(), contacts.end(),
                     [&](const auto& entry) { return entry.second->partners().body == &body; });
}

/// Height of the lowest point [m].
double tip_height(const RigidBody& body, const BodyPlacement& placement) {
  const int up = body.dimension() - 1;
  double lowest = HUGE_VAL;
  for (const Point& x : body.outline(placement)) lowest = std::min(lowest, x[up]);
  return lowest;
}

/// A force at the end of the stage and its highest and lowest values, each with a remark: where or when it was.
void add_force(const RunView& run, const std::string& of, const std::string& name, double force, const Result& remark,
               ResultTable& to) {
  const std::string& stage = run.stage.name;
  to.set(stage, of, name, "N", force);
  for (const auto& [extreme, sign] : {std::pair("highest ", 1), std::pair("lowest ", -1)}) {
    const Result* const old = to.find(stage, of, extreme + name);
    if (old != nullptr && sign * force <= sign * old->value) continue;
    to.set(stage, of, extreme + name, "N", force);
    to.set(stage, of, remark.quantity + " the " + extreme + name, remark.unit, remark.value);
  }
}

void add_reactions(const RunView& run, const Condition& condition, ResultTable& to) {
  const Result since{"", "", "time of", "s", run.state.time - run.stage_start};
  for (const char* axis : axis_names) {
    const std::string what = std::string("reaction ") + axis;
    const auto found = run.report.find("reaction/" + condition.name + " " + axis);
    if (found != run.report.end()) add_force(run, condition.name, what, found->second.value, since, to);
  }
}

/// Area of the body's largest section across the vertical [m2], in plane strain by one metre; 0 where it is unknown or
/// the body has turned.
double section(const RunView& run, const RigidBody& body) {
  const BodyProperties& properties = body.properties();
  if (body.dimension() == 2) return properties.frontal_area;
  constexpr double least = 1e-6;  // [rad]
  return !properties.turned && length(body.rotation(run.state)) < least ? properties.frontal_areas[2] : 0.0;
}

}  // namespace

void ResistanceResults::take_start(const RunView& run) {
  const Mesh& mesh = run.model.mesh();
  double highest = -HUGE_VAL;
  for (int node = 0; node < mesh.num_nodes(); ++node)
    highest = std::max(highest, run.state.coordinates(node, mesh.dimension() - 1));
  mudline_ = max_over_ranks(*mesh.comm(), highest);
}

void ResistanceResults::add_start(const std::string& name, const RigidBody& body, Geometry geometry,
                                  ResultTable& to) const {
  const double tip = tip_height(body, body.initial_placement());
  if (!std::isfinite(tip)) return;
  to.set("", name, mudline_height, "m", *mudline_);
  to.set("", name, start_depth, "m", *mudline_ - tip);
  // forces in plane strain are those of the half that is modelled, by one metre
  if (geometry == Geometry::plane_strain && body.contour().extent() == ContourExtent::half)
    to.set("", name, modelled_share, "-", 0.5);
}

void ResistanceResults::add_body(const RunView& run, const std::string& name, const RigidBody& body,
                                 ResultTable& to) const {
  const std::string& stage = run.stage.name;
  const int up = body.dimension() - 1;
  const Result* const mudline = to.find("", name, mudline_height);
  Result remark{"", "", "time of", "s", run.state.time - run.stage_start};
  if (mudline != nullptr) {
    remark = {"", "", "depth at", "m", mudline->value - tip_height(body, body.placement(run.state))};
    to.set(stage, name, "depth of the tip", "m", remark.value);
  }
  if (body.unknowns().count > 0) to.set(stage, name, "speed", "m/s", length(body.velocity(run.state)));
  for (int axis = up; axis >= 0; --axis) {
    const auto force = over_contacts(run, body, std::string("reaction ") + axis_names[axis]);
    // the horizontal forces on both halves of a symmetric body cancel
    const bool none = axis < up && up == 1 && body.contour().extent() == ContourExtent::half;
    if (force && !none)
      add_force(run, name, axis == up ? "resistance" : std::string("force ") + axis_names[axis], *force, remark, to);
  }
  const Result* const resistance = to.find(stage, name, "resistance");
  const double area = section(run, body);
  if (resistance != nullptr && area > 0 && std::isfinite(area))
    to.set(stage, name, "resistance over its section", "Pa", resistance->value / area);
  if (!(body.tip_height() > 0)) return;  // its shape has no tip apart from a shaft
  for (const char* part : {"tip", "shaft"})
    if (const auto force = over_contacts(run, body, std::string(part) + " reaction " + axis_names[up]))
      to.set(stage, name, std::string(part) + " resistance", "N", *force);
}

void ResistanceResults::results(const RunView& run, ResultTable& to) {
  for (const auto& [name, body] : run.model.bodies()) {
    if (!has_contact(run.model, *body)) continue;
    if (mudline_ && to.find("", name, mudline_height) == nullptr)
      add_start(name, *body, run.model.mesh().geometry(), to);
    add_body(run, name, *body, to);
  }
  for (const auto& condition : run.model.conditions())
    if (condition->drives()) add_reactions(run, *condition, to);
}

}  // namespace mudline
