#include <iterator>
#include <utility>

#include "simulation/setup.hpp"

namespace mudline {

namespace {

/// Numbers of the deck that have a usual range wherever they stand.
struct ParameterCheck {
  Usual quantity;
  const char* collection;  // "materials" or "physics"
  const char* section;     // of its entries; "": the entry itself
  const char* parameter;
  bool zero_is_usual;  // for example no cohesion
  const char* advice;
};

const ParameterCheck table[] = {
    {{"water density", "kg/m3", {700, 1500}, "of the pore fluid: oil to heavy brine"},
     "materials",
     "fluid",
     "density",
     false,
     "give a mass density in kg/m3, as 1000 (1 is t/m3, 9.81 or 10 a unit weight in kN/m3)"},
    {{"water bulk modulus", "Pa", {1e7, 1e10}, "of the pore fluid; a per cent of air at 100 kPa brings it to 1e7"},
     "materials",
     "fluid",
     "bulk modulus",
     false,
     "give it in Pa, as 2.2e9 (2.2e6 is kPa, 2.2 GPa), or widen the range where the water holds that much air"},
    {{"water unit weight", "N/m3", {6000, 15000}, "of the pore fluid, which turns conductivity into mobility"},
     "materials",
     "fluid",
     "unit weight",
     true,
     "give it in N/m3, as 9810 (9.81 or 10 is kN/m3, 1000 a density)"},
    {{"friction angle", "deg", {5, 50}, "of a law's strength; 0: none"},
     "materials",
     "skeleton",
     "friction angle [deg]",
     true,
     "give it in degrees (0.5 may be radians or a tangent)"},
    {{"dilation angle", "deg", {0.9, 30}, "of plastic flow; 0: none"},
     "materials",
     "skeleton",
     "dilation angle [deg]",
     true,
     "give it in degrees; sands have about the friction angle less 30"},
    {{"cohesion", "Pa", {100, 5e6}, "of a law's strength; 0: none"},
     "materials",
     "skeleton",
     "cohesion",
     true,
     "give it in Pa (5 or 10 may be kPa)"},
    {{"cohesion gradient", "Pa/m", {100, 1e5}, "growth with depth; 0: none"},
     "materials",
     "skeleton",
     "cohesion gradient",
     true,
     "give it in Pa per metre (2 may be kPa/m)"},
    {{"strength gradient", "Pa/m", {100, 1e5}, "growth of the undrained strength with depth; 0: none"},
     "materials",
     "skeleton",
     "undrained strength gradient",
     true,
     "give it in Pa per metre (1.5 may be kPa/m)"},
    {{"tensile strength", "Pa", {100, any_size}, "of a frictional soil; 0: none"},
     "materials",
     "skeleton",
     "tensile strength",
     true,
     "give it in Pa"},
    {{"reference pressure", "Pa", {500, 1e7}, "at which a law's moduli or volumes hold"},
     "materials",
     "skeleton",
     "reference pressure",
     false,
     "give it in Pa, as 1e5 (100 may be kPa, 1 kPa or bar)"},
    {{"minimum mean stress", "Pa", {0, 2e4}, "below which Modified Cam Clay does not loosen"},
     "materials",
     "skeleton",
     "minimum mean stress",
     true,
     "give it in Pa, well below the stresses of the soil"},
    {{"critical stress ratio", "-", {0.6, 1.8}, "M of a clay's critical state: friction angles of 16 to 44 degrees"},
     "materials",
     "skeleton",
     "critical stress ratio",
     false,
     "give M = 6 sin(phi)/(3 - sin(phi)), not an angle, its sine or its tangent"},
    {{"rate coefficient", "-", {0, 0.5}, "gain of strength per tenfold strain rate"},
     "materials",
     "skeleton",
     "rate coefficient",
     true,
     "give a ratio, as 0.1 (10 may be per cent)"},
    {{"rate exponent", "-", {0, 0.25}, "of the power law of the strain rate"},
     "materials",
     "skeleton",
     "rate exponent",
     true,
     "usual is 0.05 to 0.1"},
    {{"reference strain rate", "1/s", {1e-8, 1}, "at which the strength is the given one"},
     "materials",
     "skeleton",
     "reference strain rate",
     false,
     "give it in 1/s: one per cent an hour is 2.8e-6"},
    {{"sensitivity", "-", {1, 100}, "intact over remoulded strength"},
     "materials",
     "skeleton",
     "sensitivity",
     false,
     "give a ratio (300 may be per cent)"},
    {{"ductility", "-", {0.5, 200}, "plastic shear strain at which 95 per cent of the softening has happened"},
     "materials",
     "skeleton",
     "ductility",
     false,
     "give a strain: 10 is 1000 per cent"},
    {{"heat conductivity", "W/(m K)", {0.2, 10}, "of saturated soil"},
     "materials",
     "heat",
     "conductivity",
     false,
     "soils have 1 to 4 W/(m K)"},
    {{"grain heat capacity", "J/(kg K)", {300, 3000}, "per mass"},
     "materials",
     "heat",
     "grain heat capacity",
     false,
     "give J/(kg K), as 800 (0.8 may be kJ; 2e6 is per volume)"},
    {{"grain expansion", "1/K", {1e-6, 3e-4}, "volumetric, of the grains; 0: none"},
     "materials",
     "heat",
     "grain expansion",
     true,
     "give 1/K, as 3e-5 (30 may be 1e-6/K)"},
    {{"water heat capacity", "J/(kg K)", {1500, 6000}, "per mass"},
     "physics",
     "",
     "water heat capacity",
     false,
     "give J/(kg K), as 4186 (4.2 may be kJ; 4.2e6 is per volume)"},
    {{"water expansion", "1/K", {1e-5, 1.5e-3}, "volumetric, of the pore water; 0: none"},
     "physics",
     "",
     "water expansion",
     true,
     "give 1/K, as 2.07e-4"},
    {{"temperature", "degC", {-30, 200}, "of a start, a reference or a condition"},
     "physics",
     "",
     "reference temperature",
     true,
     "give degrees Celsius (293 may be kelvins)"},
    {{"temperature", "degC", {-30, 200}, ""},
     "physics",
     "",
     "initial temperature",
     true,
     "give degrees Celsius (293 may be kelvins)"},
    {{"surcharge", "Pa", {100, 1e7}, "of a geostatic start; 0: none"},
     "physics",
     "initial state",
     "surcharge",
     true,
     "give it in Pa (10 or 50 may be kPa)"},
    {{"preoverburden pressure", "Pa", {500, 1e8}, "of a geostatic start; 0: none"},
     "physics",
     "initial state",
     "preoverburden pressure",
     true,
     "give it in Pa (50 may be kPa)"},
    {{"K0", "-", {0.2, 4}, "earth pressure at rest as given: active to passive"},
     "physics",
     "initial state",
     "K0",
     false,
     "give sigma'_h/sigma'_v, about 1 - sin(phi) (50 may be per cent, 0.1 is below the active one)"},
    {{"K0 friction angle", "deg", {10, 50}, "of a geostatic start"},
     "physics",
     "initial state",
     "K0 friction angle [deg]",
     false,
     "give it in degrees (0.5 may be radians)"},
    {{"overconsolidation", "-", {1, 50}, "ratio of a start as given"},
     "physics",
     "initial state",
     "overconsolidation ratio",
     false,
     "it is the largest stress of the past over the present one: 1 or more"},
    {{"mass damping", "1/s", {0, 100}, "factor of the mass matrix"},
     "physics",
     "",
     "mass damping",
     true,
     "it is no ratio of damping: 2 xi omega"},
};

std::vector<Finding> look(const ParameterCheck& check, const Setup& setup) {
  std::vector<Finding> found;
  const bool of_materials = std::string(check.collection) == "materials";
  for (const Section& entry : of_materials ? setup.materials() : setup.physics()) {
    const Section section = *check.section ? entry.section(check.section) : entry;
    const Span span = setup.given(section, check.parameter);
    if (!span.known()) continue;
    for (double value : span.ends())
      if (value != 0 || !check.zero_is_usual)
        found.push_back({value,
                         (of_materials ? "material '" : "physics '") + entry.name() + "': '" + check.parameter + "'",
                         check.advice});
  }
  return found;
}

template <std::size_t i>
std::vector<Finding> look_at(const Setup& setup) {
  return look(table[i], setup);
}

template <std::size_t... i>
std::vector<SetupCheck> all(std::index_sequence<i...>) {
  return {SetupCheck{table[i].quantity, look_at<i>}...};
}

}  // namespace

std::vector<SetupCheck> parameter_checks() { return all(std::make_index_sequence<std::size(table)>{}); }

}  // namespace mudline
