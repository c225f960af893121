#include "materials/skeleton/tresca.hpp"

namespace mudline {

void Tresca::parameters(Parameters& p) {
  strength.parameters(p, "undrained strength");
  p.add("shear modulus", shear_modulus, "Pa", non_negative(), "Elastic; give either this or the rigidity index");
  p.add("rigidity index", rigidity, "-", non_negative(),
        "Elastic shear modulus over the undrained strength of the point; give either this or the shear modulus");
  p.required("Poisson's ratio", poisson, "-", half_open(0.0, 0.5),
             "Of the skeleton; near 0.5 where stresses are total and the soil keeps its volume");
  p.choice("rate law", rate, {{"none", Rate::none}, {"logarithmic", Rate::logarithmic}, {"power", Rate::power}},
           "How the strength grows with the shear strain rate above the reference rate");
  p.add("rate coefficient", rate_coefficient, "-", non_negative(), "Gain per tenfold rate; for the logarithmic law");
  p.add("rate exponent", rate_exponent, "-", half_open(0.0, 1.0), "Exponent of rate over reference; for the power law");
  p.add("reference strain rate", reference_rate, "1/s", positive(),
        "Shear strain rate at which the strength is the given one");
  p.add("sensitivity", sensitivity, "-", closed(1.0, 1e3),
        "Intact strength over remoulded strength; 1 means no softening");
  p.add("ductility", ductility, "-", positive(),
        "Accumulated plastic shear strain at which 95 percent of the softening has happened");
  p.add("lode transition angle [deg]", transition, "deg", closed(20.0, 29.9),
        "From this Lode angle to 30 degrees the corners of the hexagon are rounded");
  integration.parameters(p, "the undrained strength");
}

void Tresca::check(const Section& section) const {
  integration.check(section);
  if (section.has_parameter("shear modulus") == section.has_parameter("rigidity index"))
    section.fail("exactly one of 'shear modulus' and 'rigidity index' must be given");
  const char* stiffness = section.has_parameter("shear modulus") ? "shear modulus" : "rigidity index";
  if (!(shear_modulus + rigidity > 0.0)) section.fail("must be positive", stiffness);
  if (!(strength.value > 0.0) && !(strength.gradient > 0.0))
    section.fail("must be positive somewhere", "undrained strength");
  const auto only_with = [&](const char* entry, bool used, const char* when) {
    if (!used && section.has_parameter(entry)) section.fail(std::string("has no effect without ") + when, entry);
  };
  only_with("rate coefficient", rate == Rate::logarithmic, "'rate law' = logarithmic");
  only_with("rate exponent", rate == Rate::power, "'rate law' = power");
  only_with("reference strain rate", rate != Rate::none, "a 'rate law'");
  only_with("ductility", sensitivity > 1.0, "a sensitivity above 1");
}

std::vector<StateVariable> Tresca::state() {
  return {{"undrained strength", 1, "Pa", Transfer::value, 0.0, 1e300},
          {"accumulated plastic shear strain", 1, "-", Transfer::value, 0.0, 1e300}};
}

std::string Tresca::initialise(const InitialPoint& point, double* state) const {
  const double s = strength.at(point.height);
  if (!(s > 0.0)) return "the undrained strength is zero here; give a positive one at the reference elevation";
  state[strength_here] = s;
  state[plastic_shear_strain] = 0.0;
  return "";
}

SoilState Tresca::soil_state(const double*, double, const double* state) const {
  TrescaModel<double> model{{}, shape_, state[strength_here], 1.0 / sensitivity, ductility, state[strength_here]};
  double slope;
  return {model.strength * model.remaining(state[plastic_shear_strain], slope), {}};
}

template class PointwiseSkeleton<AutomaticTangent<Tresca>>;

}  // namespace mudline
