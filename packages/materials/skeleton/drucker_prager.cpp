#include "materials/skeleton/drucker_prager.hpp"

#include <algorithm>
#include <cmath>

#include "core/pi.hpp"
#include "materials/earth_pressure.hpp"

namespace mudline {

void DruckerPrager::parameters(Parameters& p) {
  elasticity.parameters(p);
  p.choice("match", match,
           {{"plane strain", Match::plane_strain},
            {"compression", Match::compression},
            {"extension", Match::extension},
            {"direct", Match::direct}},
           "Where the cone has the strength of Mohr-Coulomb; or slope and intercept are given directly");
  p.add("friction angle [deg]", friction, "deg", closed(0.0, 60.0), "Of the matched Mohr-Coulomb surface");
  p.add("dilation angle [deg]", dilation, "deg", closed(0.0, 60.0),
        "Of the matched plastic flow, not above the friction angle");
  p.add("cohesion", cohesion, "Pa", non_negative(), "Of the matched Mohr-Coulomb surface");
  p.add("cone slope", slope, "-", non_negative(), "Growth of sqrt(J2) with mean stress, given directly");
  p.add("cone intercept", intercept, "Pa", non_negative(), "sqrt(J2) at failure without mean stress, given directly");
  p.add("dilation slope", dilation_slope, "-", non_negative(), "Slope of the plastic potential, given directly");
  ConeTip::parameters(p);
  integration.parameters(p, "the shear strength at the mean stress of the start");
}

void DruckerPrager::check(const Section& section) const {
  integration.check(section);
  const bool direct = match == Match::direct;
  for (const char* entry : {"friction angle [deg]", "dilation angle [deg]", "cohesion"})
    if (direct && section.has_parameter(entry))
      section.fail("has no effect with 'match' = direct; give 'cone slope', 'cone intercept', 'dilation slope'", entry);
  for (const char* entry : {"cone slope", "cone intercept", "dilation slope"})
    if (!direct && section.has_parameter(entry)) section.fail("has no effect without 'match' = direct", entry);
  for (const char* entry : {"friction angle [deg]", "cohesion"})
    if (!direct && !section.has_parameter(entry))
      section.fail(std::string("required parameter '") + entry + "' is missing");
  for (const char* entry : {"cone slope", "cone intercept"})
    if (direct && !section.has_parameter(entry))
      section.fail(std::string("required parameter '") + entry + "' is missing");
  if (!((direct ? intercept : cohesion) > 0.0))
    section.fail("must be positive, for the rounded tip of the cone; for a clean sand give about 100 Pa",
                 direct ? "cone intercept" : "cohesion");
  if (dilation > friction)
    section.fail("the dilation angle must not be greater than the friction angle", "dilation angle [deg]");
  if (direct && dilation_slope > slope) section.fail("must not be greater than the cone slope", "dilation slope");
}

void DruckerPrager::reduce_strength(double factor) {
  cohesion /= factor;
  friction = angle_over(factor, friction);
  dilation = std::min(dilation, friction);
  intercept /= factor;
  slope /= factor;
  dilation_slope = std::min(dilation_slope, slope);
  tensile /= factor;
}

void DruckerPrager::prepare() {
  tension_shape_ = LodeShape::mohr_coulomb(1.0, 29.0);
  if (match == Match::direct) return;
  const double degree = pi / 180.0, root3 = std::sqrt(3.0);
  const double sine = std::sin(friction * degree), cosine = std::cos(friction * degree),
               flow = std::sin(dilation * degree);
  double factor;  // eta = factor sin(phi), k = factor c cos(phi)
  if (match == Match::plane_strain) {
    dilation_slope = root3 * flow / std::sqrt(3.0 + flow * flow);
    factor = 1.0 / (std::sqrt(1.0 - dilation_slope * dilation_slope / 3.0) + dilation_slope * sine / 3.0);
  } else {
    const double sign = match == Match::compression ? -1.0 : 1.0;
    factor = 6.0 / (root3 * (3.0 + sign * sine));
    dilation_slope = 6.0 * flow / (root3 * (3.0 + sign * flow));
  }
  slope = factor * sine;
  intercept = factor * cohesion * cosine;
}

std::vector<StateVariable> DruckerPrager::state() {
  return {{"plastic shear strain", 1, "-", Transfer::value, 0.0, 1e300}};
}

std::string DruckerPrager::initialise(const InitialPoint&, double* state) const {
  state[plastic_shear_strain] = 0.0;
  return "";
}

double DruckerPrager::k0(double overconsolidation_ratio) const {
  if (match == Match::direct) return -1.0;
  return earth_pressure_within_strength(std::sin(friction * pi / 180.0), overconsolidation_ratio);
}

template class PointwiseSkeleton<AutomaticTangent<DruckerPrager>>;

}  // namespace mudline
