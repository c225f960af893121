#include "simulation/results/cone_test.hpp"

#include <cmath>

#include "core/pi.hpp"
#include "simulation/excess_pressure.hpp"
#include "simulation/model.hpp"
#include "simulation/results/dissipation.hpp"
#include "simulation/results/result_table.hpp"

namespace mudline {

namespace {

constexpr const char *net_resistance = "net cone resistance", *factor = "cone factor", *ratio = "pore pressure ratio",
                     *filter_pressure = "excess pore pressure at the filter",
                     *consolidation = "coefficient of consolidation";

/// Time factor c_h t / (a^2 sqrt(I_r)) of half the dissipation behind the shoulder of a cone (Teh and Houlsby 1991).
constexpr double half_dissipated = 0.245;

}  // namespace

void ConeTest::parameters(Parameters& p) {
  p.required("body", body_, "the cone, in axisymmetry, with one contact");
  p.add(
      "overburden", overburden_, "Pa",
      "total vertical stress at the tip where the reaction of the soil contains it: the net resistance is without it. "
      "0 where it acts on the cone from above, too");
  p.add("strength", strength_, "Pa", "undrained strength of the soil at the tip, for the cone factor; 0: none");
  p.add("filter", filter_, "m", "place of the filter (u2) at the start, which moves with the cone; not given: none");
  p.add("rigidity index", rigidity_, "-", non_negative(),
        "shear modulus over undrained strength, for the coefficient of consolidation; 0: none");
  if (p.documenting()) return;
  has_filter_ = p.given("filter");
  if (p.given("rigidity index") && !has_filter_) p.deck().fail("has no effect without a 'filter'", "rigidity index");
}

void ConeTest::bind(const Model& model, const Section& section) {
  const RigidBody& body = model.body(body_, section, "body");
  if (model.mesh().geometry() != Geometry::axisymmetric)
    section.fail("a cone penetration test is axisymmetric; the mesh is not", "type");
  area_ = body.properties().frontal_area;
  if (!(area_ > 0) || !std::isfinite(area_)) section.fail("body '" + body_ + "' has no section", "body");
  int contacts = 0;
  for (const auto& [name, contact] : model.contacts()) {
    if (contact->partners().body != &body) continue;
    reaction_ = "contact/" + name + "/tip reaction y";
    ++contacts;
  }
  if (contacts != 1)
    section.fail("body '" + body_ + "' has " + std::to_string(contacts) + " contacts; allowed is one", "body");
  if (has_filter_ && !(model.soil() && model.soil()->pressure >= 0))
    section.fail("the model has no pore pressure", "filter");
}

void ConeTest::begin_run(const RunView& run) { remeshed(run); }

void ConeTest::remeshed(const RunView& run) {
  if (has_filter_)
    probes_ = std::make_unique<Probes>(run.model, std::vector<ProbeSettings>{{"filter", filter_, false, body_}});
}

double ConeTest::pressure_at_filter(const RunView& run) const {
  const auto row = probes_->values(
      run.state, [&] { return run.pressure.values(); }, nullptr);
  const HistoryValue* const found = find_value(row, "probe/filter/excess pore pressure");
  return found != nullptr ? found->value : 0.0;
}

void ConeTest::report(const RunView& run, Report& to) {
  const auto reaction = to.find(reaction_);
  const Point tip = run.model.bodies().at(body_)->position(run.state);
  const double force = reaction == to.end() ? 0.0 : reaction->second.value;
  const double net = force / area_ - overburden_(run.state.time, tip), strength = strength_(run.state.time, tip);
  to[column(net_resistance)] = {"Pa", net};
  if (!strength_.is_zero()) to[column(factor)] = {"-", strength > 0 ? net / strength : 0.0};
  if (!probes_) return;
  const double pressure = pressure_at_filter(run);
  to[column(filter_pressure)] = {"Pa", pressure};
  to[column(ratio)] = {"-", net > 0 ? pressure / net : 0.0};
}

void ConeTest::results(const RunView& run, ResultTable& to) {
  const bool moves = length(run.model.bodies().at(body_)->velocity(run.state)) > 0;
  for (const char* quantity : {net_resistance, factor, ratio}) {
    const auto found = run.report.find(column(quantity));
    if (moves && found != run.report.end())
      to.set(run.stage.name, name, quantity, found->second.unit, found->second.value);
  }
  const auto pressure = run.report.find(column(filter_pressure));
  if (pressure != run.report.end()) follow_dissipation(run, pressure->second.value, moves, to);
}

void ConeTest::follow_dissipation(const RunView& run, double pressure, bool moves, ResultTable& to) const {
  const std::string& stage = run.stage.name;
  Dissipation dissipation(stage, name, filter_pressure, to);
  // what falls while the cone moves does not tell how fast the soil consolidates
  if (moves) dissipation.forget();
  if (dissipation.follow(run.state.time - run.stage_start, run.dt, pressure) || moves)
    to.remove(stage, name, consolidation);
  const Result* const half = to.find(stage, name, std::string(filter_pressure) + " half dissipated after");
  if (half == nullptr || !(half->value > 0) || !(rigidity_ > 0)) return;
  to.set(stage, name, consolidation, "m2/s", half_dissipated * area_ / pi * std::sqrt(rigidity_) / half->value);
}

}  // namespace mudline
