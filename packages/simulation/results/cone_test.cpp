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
                     *consolidation = "coefficient of consolidation";

/// Time factor c_h t / (a^2 sqrt(I_r)) of half the dissipation behind the shoulder of a cone (Teh and Houlsby 1991).
constexpr double half_dissipated = 0.245;

/// The filters that a cone may have, by their names in the deck.
constexpr struct {
  const char *name, *place;
} places[] = {{"u1", "on the face"}, {"u2", "behind the shoulder"}, {"u3", "behind the sleeve"}};

std::string filter_pressure(const std::string& filter) { return "excess pore pressure " + filter; }

}  // namespace

void ConeTest::parameters(Parameters& p) {
  p.required("body", body_, "the cone, in axisymmetry, with one contact");
  p.add(
      "overburden", overburden_, "Pa",
      "total vertical stress at the tip where the reaction of the soil contains it: the net resistance is without it. "
      "0 where it acts on the cone from above, too");
  p.add("strength", strength_, "Pa", "undrained strength of the soil at the tip, for the cone factor; 0: none");
  for (const auto& [filter, place] : places) {
    FilterSettings settings{filter, body_};
    p.add(filter, settings.position, "m", any(),
          std::string("height of the middle of the filter ") + place +
              " above the body's reference point; not given: none");
    if (!p.documenting() && p.given(filter)) settings_.push_back(settings);
  }
  p.add("filter height", height_, "m", positive(), "extent of every filter along the body's axis");
  p.add("rigidity index", rigidity_, "-", non_negative(),
        "shear modulus over undrained strength, for the coefficient of consolidation; 0: none");
  if (p.documenting()) return;
  for (FilterSettings& filter : settings_) filter.height = height_;
  if (settings_.empty() && p.given("filter height"))
    p.deck().fail("has no effect without a filter 'u1', 'u2' or 'u3'", "filter height");
  if (p.given("rigidity index") && !p.given("u2"))
    p.deck().fail("has no effect without a filter 'u2'", "rigidity index");
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
  for (const FilterSettings& filter : settings_) Filter::check(model, filter, section, filter.name);
}

void ConeTest::begin_run(const RunView& run) { remeshed(run); }

void ConeTest::remeshed(const RunView& run) {
  filters_.clear();
  for (const FilterSettings& filter : settings_) filters_.emplace_back(run.model, filter);
}

void ConeTest::report(const RunView& run, Report& to) {
  const auto reaction = to.find(reaction_);
  const Point tip = run.model.bodies().at(body_)->position(run.state);
  const double force = reaction == to.end() ? 0.0 : reaction->second.value;
  const double net = force / area_ - overburden_(run.state.time, tip), strength = strength_(run.state.time, tip);
  to[column(net_resistance)] = {"Pa", net};
  if (!strength_.is_zero()) to[column(factor)] = {"-", strength > 0 ? net / strength : 0.0};
  if (filters_.empty()) return;
  const std::vector<Filter::Value> values = Filter::values(filters_, run.state, run.pressure.values());
  for (std::size_t k = 0; k < filters_.size(); ++k) {
    const Filter::Value& value = values[k];
    const std::string& which = filters_[k].settings().name;
    to[column(filter_pressure(which))] = {"Pa", value.excess};
    to[column(filter_pressure(which) + " error")] = {"Pa", value.error};
    if (which == "u2") to[column(ratio)] = {"-", net > 0 ? value.excess / net : 0.0};
  }
}

void ConeTest::results(const RunView& run, ResultTable& to) {
  const bool moves = length(run.model.bodies().at(body_)->velocity(run.state)) > 0;
  for (const char* quantity : {net_resistance, factor, ratio}) {
    const auto found = run.report.find(column(quantity));
    if (moves && found != run.report.end())
      to.set(run.stage.name, name, quantity, found->second.unit, found->second.value);
  }
  for (const FilterSettings& filter : settings_) follow_dissipation(run, filter.name, moves, to);
}

void ConeTest::follow_dissipation(const RunView& run, const std::string& filter, bool moves, ResultTable& to) const {
  const std::string &stage = run.stage.name, quantity = filter_pressure(filter);
  const auto pressure = run.report.find(column(quantity));
  if (pressure == run.report.end() || pressure->second.value == 0) return;  // no soil touches the filter
  Dissipation dissipation(stage, name, quantity, to);
  // what falls while the cone moves does not tell how fast the soil consolidates
  if (moves) dissipation.forget();
  const bool new_peak = dissipation.follow(run.state.time - run.stage_start, run.dt, pressure->second.value);
  if (filter != "u2") return;
  if (new_peak || moves) to.remove(stage, name, consolidation);
  const Result* const half = to.find(stage, name, quantity + " half dissipated after");
  if (half == nullptr || !(half->value > 0) || !(rigidity_ > 0)) return;
  to.set(stage, name, consolidation, "m2/s", half_dissipated * area_ / pi * std::sqrt(rigidity_) / half->value);
}

}  // namespace mudline
