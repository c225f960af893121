#include "materials/point/point_test.hpp"

#include <cmath>

#include "core/text.hpp"
#include "materials/guarded_law.hpp"
#include "tensor/sym6.hpp"

namespace mudline {

namespace {

const char* const components[6] = {"xx", "yy", "zz", "yz", "xz", "xy"};
// Names in the order of the initial state of a full run.
const char* const stress_names[6] = {"effective stress xx", "effective stress yy", "effective stress zz",
                                     "shear stress yz",     "shear stress xz",     "shear stress xy"};

/// Changes tension positive to compression positive, without negative zeros.
double turned(double x) { return x == 0.0 ? 0.0 : -x; }

bool contains(const std::vector<PointValue>& values, const std::string& name) {
  for (const PointValue& v : values)
    if (v.name == name) return true;
  return false;
}

}  // namespace

void PointStart::parameters(Parameters& p) {
  p.add("mean effective stress", mean, "Pa", non_negative(),
        "isotropic start, or with K0 its mean; give this, the vertical stress or components (0: not given)");
  p.add("vertical effective stress", vertical, "Pa", non_negative(),
        "effective stress yy; the horizontal one is K0 times this (0: not given)");
  p.add("K0", k0, "-", non_negative(),
        "horizontal over vertical effective stress; 0: that of the law with the vertical stress, 1 with the mean");
  bool any_given = false;
  for (int c = 0; c < 6; ++c) {
    p.add(stress_names[c], stress[c], "Pa", any(), "component of the start, compression positive");
    any_given = any_given || p.given(stress_names[c]);
    has_components = has_components || stress[c] != 0.0;
  }
  p.add("overconsolidation ratio", ocr, "-", positive(), "scales the yield surface through the initial stress");
  p.add("place", place, "m",
        "where the soil comes from, for numbers of the law that depend on it; the last coordinate is the height");
  p.add("void ratio", void_ratio, "-", non_negative(), "initial void ratio; 0: that of the material, or of its law");
  // All components zero mean a stress-free start, unless the start is given otherwise.
  has_components = has_components || (any_given && mean == 0.0 && vertical == 0.0);
}

void PointTest::parameters(Parameters& p) {
  p.add("material", material_, "entry of 'materials' to test; may be left out where there is only one");
  p.section("initial state", start_, "stress, overconsolidation ratio and void ratio of the start");
  own_parameters(p);
}

void PointTest::begin(const PointSoil& soil, const Section& section) {
  soil_ = soil;
  const Section start = section.section("initial state");
  const int ways = (start_.mean > 0.0) + (start_.vertical > 0.0) + start_.has_components;
  if (ways != 1)
    start.fail(std::string(ways == 0 ? "no initial stress" : "contradictory") +
               ": give one of 'mean effective stress', 'vertical effective stress', or components such as 'effective "
               "stress yy'");
  if (start_.k0 > 0.0 && start_.has_components)
    start.fail("contradictory: components of the stress leave no room for 'K0'", "K0");
  initial_.position = start_.place;
  initial_.height = start_.place[section.dimension() - 1];
  initial_.element = initial_.number = 1;
  initial_.overconsolidation_ratio = start_.ocr;
  if (const std::string problem = soil.skeleton->number_out_of_range(start_.place); !problem.empty())
    start.fail("material '" + soil.name + "': " + problem, "place");
  double k0 = start_.k0 > 0.0 ? start_.k0 : 1.0;
  if (start_.vertical > 0.0 && start_.k0 == 0.0) {
    const std::string problem = guarded_k0(*soil.skeleton, initial_, k0);
    if (!problem.empty()) start.fail("material '" + soil.name + "': " + problem);
    if (k0 < 0.0) start.fail("the skeleton law of material '" + soil.name + "' has no K0 of its own; give 'K0'");
  }
  if (start_.has_components) {
    for (int c = 0; c < 6; ++c) initial_.stress[c] = turned(start_.stress[c]);
  } else {
    const double vertical = start_.vertical > 0.0 ? start_.vertical : 3.0 * start_.mean / (1.0 + 2.0 * k0);
    initial_.stress = {-k0 * vertical, -vertical, -k0 * vertical, 0.0, 0.0, 0.0};
  }
  initial_.void_ratio = start_.void_ratio > 0.0 ? start_.void_ratio : soil.void_ratio(start_.place);
  if (start_.void_ratio == 0.0 && soil.void_ratio_from_law) {
    initial_.void_ratio = soil.skeleton->void_ratio(initial_);
    if (initial_.void_ratio == Skeleton::no_void_ratio)
      start.fail("the skeleton law of material '" + soil.name +
                 "' has no void ratio of its own here; give 'void ratio'");
  } else if (!(initial_.void_ratio > 0.0))
    start.fail("neither the material '" + soil.name + "' nor the test has a 'void ratio'");
  const std::string refusal = MaterialPoint(*soil.skeleton, initial_).refusal();
  if (!refusal.empty()) start.fail("material '" + soil.name + "' cannot start here: " + refusal);
}

PointOutcome PointTest::run(const Row& row) const {
  MaterialPoint point(*soil_.skeleton, initial_, soil_.biot_coefficient);
  PointControl control(point);
  PointOutcome outcome;
  const auto report = [&] {
    outcome.last = values(control);
    outcome.time = point.time();
    row(outcome.time, outcome.last);
  };
  report();
  outcome.complete = true;
  double end = 0.0;  // [s] end of the leg
  for (const PointLeg& leg : legs()) {
    const double begin = end;
    end += leg.duration;
    const Six from = leg.tie.stress(point.stress());
    for (int step = 1; step <= leg.steps; ++step) {
      if (!outcome.complete) break;
      const double reached = static_cast<double>(step) / leg.steps;
      PointIncrement increment;
      increment.stress_controlled = leg.stress_controlled;
      increment.tie = leg.tie;
      increment.sliding = leg.sliding;
      increment.dt = begin + reached * leg.duration - point.time();
      for (int c = 0; c < 6; ++c) {
        increment.strain[c] = leg.strain[c] / leg.steps;
        increment.stress[c] = step == leg.steps ? leg.stress[c] : from[c] + reached * (leg.stress[c] - from[c]);
      }
      outcome.complete = control.advance(increment);
      if (outcome.complete) ++outcome.steps;
      if (point.time() > outcome.time) report();
    }
    if (!outcome.complete) break;
  }
  if (!outcome.complete && !control.failure().empty())
    outcome.failure = "the law of material '" + soil_.name + "' fails: " + control.failure();
  outcome.cuts = control.cuts();
  outcome.iterations = control.iterations();
  return outcome;
}

std::vector<PointValue> PointTest::values(const PointControl& control) const {
  const MaterialPoint& point = control.point();
  const Six& e = control.strain();
  const Six& s = point.stress();
  const double axial = turned(e[1]), volume = turned(sym6::trace(e.data()));
  const sym6::Invariants invariants = sym6::invariants(s.data());
  std::vector<PointValue> row{{"axial strain", "-", axial},
                              {"engineering axial strain", "-", -std::expm1(-axial)},
                              {"volumetric strain", "-", volume},
                              {"engineering volumetric strain", "-", -std::expm1(-volume)}};
  for (int c = 0; c < 6; ++c)
    row.push_back({std::string(c < 3 ? "strain " : "shear strain ") + components[c], "-", turned(e[c])});
  for (int c = 0; c < 6; ++c) row.push_back({stress_names[c], "Pa", turned(s[c])});
  row.push_back({"mean effective stress", "Pa", invariants.p});
  row.push_back({"deviatoric stress", "Pa", invariants.q});
  row.push_back({"stress difference", "Pa", s[0] - s[1]});
  row.push_back({"void ratio", "-", point.void_ratio()});
  const int total = constant_total_stress();
  if (total >= 0) row.push_back({"excess pore pressure", "Pa", s[total] - initial_.stress[total]});
  int slot = 0;
  for (const StateVariable& variable : point.law().state_variables()) {
    if (variable.hidden) {
      slot += variable.components;
      continue;
    }
    for (int c = 0; c < variable.components; ++c) {
      std::string name = variable.name;
      if (variable.components > 1)
        name += std::string(" ") + (variable.components == 6 ? components[c] : std::to_string(c + 1));
      // A law may choose any names for its state variables, including those of the columns above.
      row.push_back({(contains(row, name) ? "law/" : "") + name, variable.unit, point.state()[slot++]});
    }
  }
  return row;
}

}  // namespace mudline
