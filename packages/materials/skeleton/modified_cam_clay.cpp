#include "materials/skeleton/modified_cam_clay.hpp"

#include <cmath>
#include <sstream>

#include "materials/earth_pressure.hpp"

namespace mudline {

void ModifiedCamClay::parameters(Parameters& p) {
  p.required("critical stress ratio", ratio, "-", open(0.0, 3.0),
             "M = q/p' at the critical state in triaxial compression");
  p.required("compression slope", compression, "-", positive(), "lambda, slope of virgin compression in v over ln p'");
  p.required("swelling slope", swelling, "-", positive(), "kappa, slope of elastic unloading in v over ln p'");
  p.add("Poisson's ratio", poisson, "-", half_open(0.0, 0.5),
        "Constant drained ratio; give this, the shear modulus or the shear modulus ratio");
  p.add("shear modulus", shear_modulus, "Pa", non_negative(),
        "Constant elastic shear modulus; give this, Poisson's ratio or the shear modulus ratio");
  p.add("shear modulus ratio", shear_ratio, "-", non_negative(),
        "g = G/p' of elasticity that stores energy: closed elastic paths of strain neither give nor take any; give "
        "this, Poisson's ratio or the shear modulus");
  p.choice("specific volume", volume, {{"current", Volume::current}, {"initial", Volume::initial}},
           "Which specific volume enters bulk modulus and hardening");
  p.choice("lode dependence", lode, {{"none", Lode::none}, {"sheng", Lode::sheng}},
           "Strength in triaxial extension: that of compression, or that of the same friction angle");
  p.add("normal compression volume", normal_volume, "-", non_negative(),
        "N, specific volume of isotropic virgin compression at the reference pressure; the preconsolidation pressure "
        "then "
        "follows from the initial void ratio, or the void ratio from the overconsolidation ratio ('void ratio from "
        "law')");
  p.add("critical state volume", critical_volume, "-", non_negative(),
        "Gamma, specific volume at the critical state at the reference pressure; instead of the normal compression "
        "volume");
  p.add("reference pressure", reference_pressure, "Pa", positive(),
        "Mean effective stress at which the normal compression or critical state volume is read");
  p.add("spacing ratio", spacing, "-", non_negative(),
        "r of the yield surface of CASM: preconsolidation pressure over mean stress at the critical state; without it "
        "the surface is the ellipse, where the ratio is 2");
  p.add("stress state coefficient", exponent, "-", closed(2.0, 5.0),
        "n, shape of the yield surface of CASM; larger: lower peaks on the dry side");
  p.add("minimum mean stress", minimum_mean_stress, "Pa", non_negative(),
        "The mean effective stress is held at this value where the soil would loosen further");
  integration.parameters(p, "the preconsolidation pressure squared");
}

void ModifiedCamClay::check(const Section& section) const {
  integration.check(section);
  if (!(swelling < compression))
    section.fail("the swelling slope must be smaller than the compression slope", "swelling slope");
  if (section.has_parameter("Poisson's ratio") + section.has_parameter("shear modulus") +
          section.has_parameter("shear modulus ratio") !=
      1)
    section.fail("exactly one of 'Poisson's ratio', 'shear modulus' and 'shear modulus ratio' must be given");
  for (const char* volume : {"normal compression volume", "critical state volume"})
    if (section.has_parameter(volume) && !((volume[0] == 'n' ? normal_volume : critical_volume) > 1.0))
      section.fail("a specific volume is greater than 1", volume);
  if (normal_volume > 0.0 && critical_volume > 0.0)
    section.fail("contradictory: give 'normal compression volume' or 'critical state volume', not both",
                 "critical state volume");
  if (section.has_parameter("reference pressure") && !(normal_line() > 0.0))
    section.fail("plays no role without 'normal compression volume' or 'critical state volume'; remove it",
                 "reference pressure");
  if (section.has_parameter("spacing ratio") && !(spacing > 1.0))
    section.fail(
        "the preconsolidation pressure is greater than the mean stress at the critical state; give more than 1",
        "spacing ratio");
  if (section.has_parameter("stress state coefficient") && !(spacing > 0.0))
    section.fail("plays no role without 'spacing ratio'; remove it", "stress state coefficient");
  if (section.has_parameter("shear modulus") && !(shear_modulus > 0.0))
    section.fail("the shear modulus must be positive", "shear modulus");
  if (section.has_parameter("shear modulus ratio") && !(shear_ratio > 0.0))
    section.fail("the ratio must be positive", "shear modulus ratio");
  if (shear_ratio > 0.0 && section.has_section("small-strain stiffness"))
    section.fail(
        "contradictory with a 'shear modulus ratio', whose energy its strings would not keep; remove one of "
        "them, or give the 'shear modulus'",
        "small-strain stiffness");
  if (shear_ratio > 0.0 && critical_volume > 0.0)
    section.fail(
        "with a 'shear modulus ratio' shear dilates elastically, so that the critical state line is no fixed "
        "distance away; give 'normal compression volume'",
        "critical state volume");
  if (lode == Lode::sheng && ratio > 2.0)
    section.fail("the yield surface of 'lode dependence' = sheng is convex only for a critical stress ratio up to 2",
                 "critical stress ratio");
}

std::vector<StateVariable> ModifiedCamClay::state() {
  return {{"preconsolidation pressure", 1, "Pa", Transfer::value, 0.0, 1e300},
          {"plastic shear strain", 1, "-", Transfer::value, 0.0, 1e300},
          {"initial specific volume", 1, "-", Transfer::value, 1.0, 1e300}};
}

std::string ModifiedCamClay::cannot_start(const InitialPoint& point) const {
  const double p = sym6::mean_pressure(point.stress.data());
  std::ostringstream reason;
  if (!(p > 0.0)) {
    reason << "Modified Cam Clay needs a compressive initial stress; the mean effective stress here is " << p << " Pa";
  } else if (p < minimum_mean_stress) {
    reason << "the initial mean effective stress, " << p << " Pa, is below the minimum mean stress of "
           << minimum_mean_stress << " Pa";
  } else if (!(point.overconsolidation_ratio >= 1.0)) {
    reason << "the overconsolidation ratio must be at least 1; it is " << point.overconsolidation_ratio;
  } else if (!(point.void_ratio > 0.0)) {
    reason << "the initial void ratio must be positive; it is " << point.void_ratio;
  }
  return reason.str();
}

std::string ModifiedCamClay::initialise(const InitialPoint& point, double* state) const {
  if (const std::string reason = cannot_start(point); !reason.empty()) return reason;
  return start(point, through(point.stress.data()), state);
}

std::string ModifiedCamClay::start(const InitialPoint& point, double on_surface, double* state) const {
  const double p = sym6::mean_pressure(point.stress.data()), normal = normal_line();
  std::ostringstream reason;
  state[preconsolidation] = point.overconsolidation_ratio * on_surface;
  if (normal > 0.0) {
    const double dilation = dilated(point.stress.data()), v = (1.0 + point.void_ratio) / dilation;
    const double exponent = (normal - v - swelling * std::log(p / reference_pressure)) / (compression - swelling);
    const double line = reference_pressure * std::exp(exponent);
    if (!(line >= on_surface * (1.0 - 1e-9))) {
      reason << "a void ratio of " << point.void_ratio << " at this stress is looser than the normal compression line, "
             << "which gives " << point.void_ratio + dilation * (compression - swelling) * std::log(line / on_surface);
      return reason.str();
    }
    if (point.overconsolidation_ratio != 1.0 && std::abs(line / state[preconsolidation] - 1.0) > 1e-6)
      return "with a normal compression line the overconsolidation follows from the void ratio; leave the ratio at 1, "
             "or let "
             "the void ratio follow ('void ratio from law')";
    state[preconsolidation] = std::fmax(line, on_surface);
  }
  state[plastic_shear_strain] = 0.0;
  state[initial_specific_volume] = 1.0 + point.void_ratio;
  return "";
}

double ModifiedCamClay::dilated(const double* stress) const {
  if (!(shear_ratio > 0.0)) return 1.0;
  double s[6];
  const double p = sym6::deviator(stress, s), h = dilation(sym6::norm_squared(s), p);
  return volume == Volume::current ? std::exp(h) : 1.0 / (1.0 - h);
}

double ModifiedCamClay::normal_line() const {
  return critical_volume > 0.0 ? critical_volume + (compression - swelling) * std::log(critical_spacing())
                               : normal_volume;
}

double ModifiedCamClay::through(const double* stress) const {
  // f with pc = 0 is q^2/M(S)^2 + p'^2 in units of 1/scale, that is p' times the pc of the surface through the stress.
  const double p = sym6::mean_pressure(stress);
  if (spacing > 0.0) {  // f with pc = p' is what ln pc adds to ln p'
    const double h[2] = {p, 0.0};
    return p * std::exp(CasmModel<SixComponents>(*this, {}, 1.0, p).yield(stress, h));
  }
  const ModifiedCamClayModel<SixComponents> model(*this, {}, 1.0, p);
  const double h[2] = {0.0, 0.0};
  return p * model.yield(stress, h);
}

double ModifiedCamClay::void_ratio(const InitialPoint& point) const {
  const double p = sym6::mean_pressure(point.stress.data());
  return p > 0.0 ? void_ratio(point, through(point.stress.data())) : Skeleton::no_void_ratio;
}

double ModifiedCamClay::void_ratio(const InitialPoint& point, double on_surface) const {
  if (!(normal_line() > 0.0)) return Skeleton::no_void_ratio;
  const double p = sym6::mean_pressure(point.stress.data()), pc = point.overconsolidation_ratio * on_surface;
  const double at_rest = normal_line() - compression * std::log(pc / reference_pressure) + swelling * std::log(pc / p);
  return dilated(point.stress.data()) * at_rest - 1.0;
}

double ModifiedCamClay::k0(double overconsolidation_ratio) const {
  const double elastic = shear_modulus > 0.0 || shear_ratio > 0.0 ? 0.0 : swelling / (3.0 * shear_to_bulk());
  const auto excess = [&](double eta) {
    const double plastic = 2.0 * eta * (compression - swelling) / (ratio * ratio - eta * eta);
    if (shear_ratio > 0.0 && volume == Volume::current)  // the swelling line holds for v exp(-h)
      return plastic - 2.0 / 3.0 * (compression + swelling * std::expm1(dilation(2.0 / 3.0 * eta * eta, 1.0)));
    return plastic + eta * elastic - 2.0 / 3.0 * compression;
  };
  double low = 0.0, high = ratio;  // the excess increases from negative to infinite
  for (int i = 0; i < 200; ++i) {
    if (!(high - low > 1e-15 * ratio)) break;
    const double middle = 0.5 * (low + high);
    (excess(middle) < 0.0 ? low : high) = middle;
  }
  const double eta = 0.5 * (low + high), sine = 3.0 * ratio / (6.0 + ratio);
  return (3.0 - eta) / (3.0 + 2.0 * eta) * std::pow(overconsolidation_ratio, sine);
}

SoilState ModifiedCamClay::soil_state(const double* stress, double void_ratio, const double* state) const {
  double s[6];
  const double p = std::max(sym6::deviator(stress, s), minimum_mean_stress), pc = state[preconsolidation];
  const double q2 = 1.5 * sym6::norm_squared(s),
               through_stress = spacing > 0.0 ? through(stress) : p + q2 / (ratio * ratio * p);
  const double to_critical = pc / (critical_spacing() * p);
  double strength = 0.5 * ratio * p * std::pow(to_critical, (compression - swelling) / compression);
  if (shear_ratio > 0.0) {
    const double more = dilation(2.0 / 3.0 * ratio * ratio, 1.0) - dilation(2.0 / 3.0 * q2, p);
    strength *= std::exp(specific_volume(void_ratio, state) * more / compression);
  }
  return {strength, pc / through_stress};
}

EarthPressures ModifiedCamClay::earth_pressures(double vertical, double) const {
  const double root3 = std::sqrt(3.0), sine = 3.0 * ratio / (6.0 + ratio);
  const double extension = lode == Lode::sheng ? ratio * (3.0 - sine) / (3.0 + sine) : ratio;
  return {cone_earth_pressures(vertical, ratio / root3, 0.0).active,
          cone_earth_pressures(vertical, extension / root3, 0.0).passive};
}

template class PointwiseSkeleton<ModifiedCamClay>;

}  // namespace mudline
