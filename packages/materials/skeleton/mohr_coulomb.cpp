#include "materials/skeleton/mohr_coulomb.hpp"

#include <algorithm>
#include <cmath>

#include "core/pi.hpp"
#include "materials/earth_pressure.hpp"

namespace mudline {

void MohrCoulomb::parameters(Parameters& p) {
  elasticity.parameters(p);
  p.add("stiffness exponent", exponent, "-", half_open(0.0, 1.0),
        "Of the growth of Young's modulus with the mean effective stress; 0: it is constant; sands have about 0.5");
  p.add("reference pressure", reference_pressure, "Pa", positive(),
        "Mean effective stress at which Young's modulus is the given one");
  cohesion.parameters(p, "cohesion");
  p.required("friction angle [deg]", friction, "deg", closed(0.0, 60.0), "Of effective stress; 0 is Tresca");
  p.add("dilation angle [deg]", dilation, "deg", closed(0.0, 60.0), "Of plastic flow, not above the friction angle");
  ConeTip::parameters(p);
  p.add("lode transition angle [deg]", transition, "deg", closed(20.0, 29.9),
        "From this Lode angle to 30 degrees the corners of the hexagon are rounded");
  integration.parameters(p, "the shear strength at the mean stress of the start");
}

void MohrCoulomb::check(const Section& section) const {
  integration.check(section);
  if (exponent == 0.0 && section.has_parameter("reference pressure"))
    section.fail("has a meaning only with a 'stiffness exponent' above 0", "reference pressure");
  if (exponent > 0.0 && !(friction > 0.0))
    section.fail("needs a friction angle above 0, which says how strength and stiffness grow with the stress",
                 "stiffness exponent");
  if (dilation > friction)
    section.fail("the dilation angle must not be greater than the friction angle", "dilation angle [deg]");
  if (!(cohesion.value > 0.0) && !(cohesion.gradient > 0.0))
    section.fail("must be positive somewhere, for the rounded tip of the cone; for a clean sand give about 100 Pa",
                 "cohesion");
}

void MohrCoulomb::reduce_strength(double factor) {
  reduction_ = factor;
  friction = angle_over(factor, friction);
  dilation = std::min(dilation, friction);
  tensile /= factor;
}

void MohrCoulomb::prepare() {
  const double degree = pi / 180.0;
  sine_ = std::sin(friction * degree);
  cosine_ = std::cos(friction * degree);
  dilation_sine_ = std::sin(dilation * degree);
  dilation_cosine_ = std::cos(dilation * degree);
  yield_shape_ = LodeShape::mohr_coulomb(sine_, transition);
  potential_shape_ = LodeShape::mohr_coulomb(dilation_sine_, transition);
  tension_shape_ = LodeShape::mohr_coulomb(1.0, transition);
}

std::vector<StateVariable> MohrCoulomb::state() {
  return {{"cohesion", 1, "Pa", Transfer::value, 0.0, 1e300},
          {"plastic shear strain", 1, "-", Transfer::value, 0.0, 1e300}};
}

std::string MohrCoulomb::initialise(const InitialPoint& point, double* state) const {
  const double c = cohesion.at(point.height);
  if (!(c > 0.0)) return "the cohesion is zero here; the rounded tip of Mohr-Coulomb needs a positive one, e.g. 100 Pa";
  state[cohesion_here] = c;
  state[plastic_shear_strain] = 0.0;
  return "";
}

double MohrCoulomb::k0(double overconsolidation_ratio) const {
  return earth_pressure_within_strength(sine_, overconsolidation_ratio);
}

template class PointwiseSkeleton<AutomaticTangent<MohrCoulomb>>;

}  // namespace mudline
