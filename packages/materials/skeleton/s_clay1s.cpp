#include "materials/skeleton/s_clay1s.hpp"

#include <cmath>
#include <sstream>

#include "materials/earth_pressure.hpp"

namespace mudline {

namespace {

/// eta0 = q/p' at rest for K0 = 1 - sin phi.
double ratio_at_rest(double critical_ratio) {
  const double sine = 3.0 * critical_ratio / (6.0 + critical_ratio), k0 = 1.0 - sine;
  return 3.0 * (1.0 - k0) / (1.0 + 2.0 * k0);
}

}  // namespace

double SClay1s::virgin_inclination() const {
  const double eta = ratio_at_rest(clay.ratio);
  return (eta * eta + 3.0 * eta - clay.ratio * clay.ratio) / 3.0;
}

double SClay1s::virgin_weight() const {
  const double eta = ratio_at_rest(clay.ratio), m2 = clay.ratio * clay.ratio;
  return 0.375 * (4.0 * m2 - 4.0 * eta * eta - 3.0 * eta) / (eta * eta - m2 + 2.0 * eta);
}

void SClay1s::parameters(Parameters& p) {
  clay.parameters(p);
  p.add("fabric rotation rate", rotation, "-", non_negative(),
        "omega, how fast the fabric turns with plastic strain; 0: no fabric, the surface is not inclined");
  p.add("fabric shear weight", shear_weight, "-", non_negative(),
        "omega_d, weight of shear strain in that; 0: the value with which K0 = 1 - sin phi keeps its fabric");
  p.add("initial inclination", inclination, "-", non_negative(),
        "Inclination q/p' of the surface at the start; 0: that of one-dimensional virgin compression");
  p.choice(
      "fabric axis", axis, {{"stress", Axis::stress}, {"x", Axis::x}, {"y", Axis::y}, {"z", Axis::z}},
      "Direction of the fabric at the start: along the initial stress deviator, or across the bedding as deposited "
      "along an axis");
  p.add("initial bonding", initial_bonding, "-", non_negative(),
        "chi, by which the surface is larger than that of the remoulded clay: about the sensitivity less 1; 0: none");
  p.add("bond degradation rate", degradation, "-", non_negative(), "xi, loss of bonding with plastic strain");
  p.add("bond shear weight", degradation_shear, "-", non_negative(), "xi_d, weight of shear strain in that");
  p.add("creep slope", creep_slope, "-", non_negative(),
        "mu, slope of virgin creep in void ratio over ln t, C_alpha/ln 10; 0: no creep");
  p.add("reference time", reference_time, "s", positive(),
        "tau, duration of the load steps in which the preconsolidation was measured: one day as a rule");
}

void SClay1s::check(const Section& section) const {
  clay.check(section);
  const auto needs = [&](const char* name, bool given, const char* part) {
    if (section.has_parameter(name) && !given)
      section.fail(std::string("plays no role without '") + part + "'; remove it", name);
  };
  for (const char* name : {"fabric shear weight", "initial inclination", "fabric axis"})
    needs(name, rotation > 0.0, "fabric rotation rate");
  for (const char* name : {"bond degradation rate", "bond shear weight"})
    needs(name, initial_bonding > 0.0, "initial bonding");
  needs("reference time", creep_slope > 0.0, "creep slope");
  if (plain()) return;
  if (clay.spacing > 0.0)
    section.fail("the surface of CASM has no fabric, bonding or creep; remove it or the parts", "spacing ratio");
  if (clay.critical_volume > 0.0 && rotation > 0.0)
    section.fail("with a fabric the critical state line is no fixed distance away; give 'normal compression volume'",
                 "critical state volume");
  if (creep_slope > 0.0) {
    if (section.has_section("small-strain stiffness"))
      section.fail("contradictory with a 'creep slope', whose strain it would make smaller; remove one of them",
                   "small-strain stiffness");
    for (const char* name : {"integration", "yield tolerance"})
      if (section.has_parameter(name))
        section.fail("plays no role with a 'creep slope', for there is no yield surface; remove it", name);
    if (!(creep_slope < clay.compression - clay.swelling))
      section.fail("must be below the compression slope less the swelling slope", "creep slope");
  }
  if (!(rotation > 0.0)) return;
  const double published = virgin_inclination(), weight = virgin_weight();
  if (!(inclination > 0.0) && !(published > 0.0))
    section.fail("must be given, for at this critical stress ratio that of virgin compression is not positive",
                 "initial inclination");
  if (!(shear_weight > 0.0) && !(weight > 0.0 && std::isfinite(weight)))
    section.fail("must be given, for at this critical stress ratio no positive one keeps K0 = 1 - sin phi",
                 "fabric shear weight");
  SClay1s prepared = *this;
  prepared.prepare();
  if (!(prepared.start_ < prepared.largest_inclination())) {
    std::ostringstream range;
    range << "the surface leans too far; allowed: below " << prepared.largest_inclination()
          << ", the critical stress ratio in extension less a margin";
    section.fail(range.str(), "initial inclination");
  }
}

void SClay1s::prepare() {
  const double m2 = clay.ratio * clay.ratio;
  weakest_ = clay.lode == ModifiedCamClay::Lode::sheng ? m2 * std::sqrt(clay.lode_ratio_4()) : m2;
  const bool inclined = rotation > 0.0;
  start_ = !inclined ? 0.0 : inclination > 0.0 ? inclination : virgin_inclination();
  weight_ = !inclined ? 0.0 : shear_weight > 0.0 ? shear_weight : virgin_weight();
  const double rest = k0(1.0), eta = 3.0 * (1.0 - rest) / (1.0 + 2.0 * rest),
               virgin = inclined ? virgin_inclination() : 0.0;
  creep_rate_ = creep_slope / reference_time * (m2 - virgin * virgin) / (m2 - eta * eta);
}

std::vector<StateVariable> SClay1s::state() {
  std::vector<StateVariable> all = ModifiedCamClay::state();
  all.push_back({"bonding", 1, "-", Transfer::value, 0.0, 1e300});
  all.push_back({"fabric", 6, "-", Transfer::value, -2.0, 2.0});
  return all;
}

double SClay1s::size(const double* stress, const double* a) const {
  const double p = sym6::mean_pressure(stress);
  InclinedEllipse<double> at;
  SClay1sModel(*this, 1.0, p).evaluate(stress, a, at);
  return at.p + at.shear / at.p;
}

std::string SClay1s::start_fabric(const double* stress, double* a) const {
  for (int i = 0; i < 6; ++i) a[i] = 0.0;
  if (!(rotation > 0.0)) return "";
  if (axis != Axis::stress) {
    for (int i = 0; i < 3; ++i) a[i] = start_ * (i + 1 == static_cast<int>(axis) ? -2.0 : 1.0) / 3.0;
    return "";
  }
  double s[6];
  const double p = sym6::deviator(stress, s), q = std::sqrt(1.5 * sym6::norm_squared(s));
  if (!(q > 1e-6 * p))
    return "the fabric takes its direction from the initial stress, which has no deviator here; give 'fabric axis'";
  for (int i = 0; i < 6; ++i) a[i] = start_ * s[i] / q;
  return "";
}

std::string SClay1s::initialise(const InitialPoint& point, double* state) const {
  for (int i = bonding; i < state_size; ++i) state[i] = 0.0;
  if (plain()) return clay.initialise(point, state);
  if (const std::string reason = clay.cannot_start(point); !reason.empty()) return reason;
  if (const std::string reason = start_fabric(point.stress.data(), state + fabric); !reason.empty()) return reason;
  state[bonding] = initial_bonding;
  return clay.start(point, size(point.stress.data(), state + fabric) / (1.0 + initial_bonding), state);
}

double SClay1s::void_ratio(const InitialPoint& point) const {
  if (plain()) return clay.void_ratio(point);
  double a[6];
  if (!(sym6::mean_pressure(point.stress.data()) > 0.0) || !start_fabric(point.stress.data(), a).empty())
    return Skeleton::no_void_ratio;
  return clay.void_ratio(point, size(point.stress.data(), a) / (1.0 + initial_bonding));
}

double SClay1s::k0(double overconsolidation_ratio) const {
  if (!(rotation > 0.0)) return clay.k0(overconsolidation_ratio);
  const double sine = 3.0 * clay.ratio / (6.0 + clay.ratio);
  return earth_pressure_within_strength(sine, overconsolidation_ratio);
}

SoilState SClay1s::soil_state(const double* stress, double void_ratio, const double* state) const {
  if (plain()) return clay.soil_state(stress, void_ratio, state);
  if (!(sym6::mean_pressure(stress) > 0.0)) return {};
  return {std::nullopt, (1.0 + state[bonding]) * state[preconsolidation] / size(stress, state + fabric)};
}

template class PointwiseSkeleton<SClay1sByParts>;

}  // namespace mudline
