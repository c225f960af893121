#include "materials/skeleton/hypoplasticity.hpp"

#include <cmath>
#include <sstream>

#include "core/pi.hpp"
#include "materials/earth_pressure.hpp"

namespace mudline {

namespace {

constexpr const char* intergranular_names[] = {"reversal stiffness ratio", "turn stiffness ratio",
                                               "intergranular strain exponent", "stiffness decay exponent"};

}  // namespace

void Hypoplasticity::parameters(Parameters& p) {
  p.required("critical friction angle [deg]", friction, "deg", open(0.0, 60.0), "Friction angle at the critical state");
  p.required("granular hardness", hardness, "Pa", positive(),
             "h_s, pressure that measures how stiff the grain skeleton is in compression");
  p.required("compression exponent", compression_exponent, "-", open(0.0, 1.0),
             "n, of the pressure in the fall of the limiting void ratios");
  p.required("densest void ratio", densest, "-", positive(),
             "e_d0, void ratio of the densest packing at zero pressure");
  p.required("critical void ratio", critical, "-", positive(), "e_c0, critical void ratio at zero pressure");
  p.required("loosest void ratio", loosest, "-", positive(),
             "e_i0, void ratio of the loosest packing at zero pressure");
  p.required("peak exponent", peak_exponent, "-", positive(), "alpha, how far density raises the peak strength");
  p.required("stiffness exponent", stiffness_exponent, "-", non_negative(),
             "beta, how far density raises the stiffness");
  p.add("intergranular strain range", range, "-", non_negative(),
        "R, strain over which the soil is stiff after a reversal; 0: no intergranular strain");
  p.add("reversal stiffness ratio", reversal, "-", positive(),
        "m_R, growth of the stiffness where the strain path turns back");
  p.add("turn stiffness ratio", turn, "-", positive(),
        "m_T, growth of the stiffness where the strain path turns by 90 degrees");
  p.add("intergranular strain exponent", evolution_exponent, "-", positive(),
        "beta_r, how late the intergranular strain reaches its range");
  p.add("stiffness decay exponent", decay_exponent, "-", positive(),
        "chi, how late the stiffness falls as the intergranular strain grows");
  p.add("pressure shift", shift, "Pa", non_negative(),
        "Added to the mean effective stress in all equations; an apparent cohesion over its friction");
  p.add("minimum mean stress", minimum_mean_stress, "Pa", positive(),
        "The mean effective stress with the shift stays above this value where the soil would loosen further");
  p.add("stress tolerance", tolerance, "-", open(0.0, 0.1), "Largest relative error of one substep");
  p.add("maximum substeps", maximum_substeps, "-", closed(1, 10000000),
        "A point that needs more in one increment fails, and the step is cut");
}

void Hypoplasticity::check(const Section& section) const {
  if (!(densest < critical)) section.fail("must be below the critical void ratio", "densest void ratio");
  if (!(critical < loosest)) section.fail("must be below the loosest void ratio", "critical void ratio");
  Hypoplasticity prepared = *this;
  prepared.prepare();
  if (!(prepared.pressure_factor_ > 0.0))
    section.fail(
        "is so large that isotropic compression would have no stiffness, for 3 + a^2 - a sqrt(3) ((e_i0 - "
        "e_d0)/(e_c0 - e_d0))^alpha must be positive",
        "peak exponent");
  const bool with = range > 0.0;
  for (const char* name : intergranular_names)
    if (section.has_parameter(name) != with)
      section.fail(with ? "must be given with an intergranular strain range"
                        : "plays no role without an 'intergranular strain range'; remove it",
                   name);
  if (!(turn >= 1.0)) section.fail("must be at least 1", "turn stiffness ratio");
  if (!(reversal >= turn)) section.fail("must be at least the turn stiffness ratio", "reversal stiffness ratio");
}

void Hypoplasticity::prepare() {
  const double sine = std::sin(friction * pi / 180.0);
  a_ = std::sqrt(3.0) * (3.0 - sine) / (2.0 * std::sqrt(2.0) * sine);
  a2_ = a_ * a_;
  const double loose = std::pow((loosest - densest) / (critical - densest), peak_exponent);
  const double isotropic = 3.0 + a2_ - a_ * std::sqrt(3.0) * loose;
  pressure_factor_ = hardness / compression_exponent * std::pow(loosest / critical, stiffness_exponent) / isotropic;
}

std::vector<StateVariable> Hypoplasticity::state() {
  return {{"intergranular strain", 6, "-", Transfer::value, -1.0, 1.0}};
}

std::string Hypoplasticity::initialise(const InitialPoint& point, double* state) const {
  double principal[3];
  sym6::principal_values(point.stress.data(), principal);
  const double p = sym6::mean_pressure(point.stress.data()) + shift;
  const double compressed = std::exp(-std::pow(std::fmax(3.0 * p / hardness, 0.0), compression_exponent));
  const double low = densest * compressed, high = loosest * compressed;
  std::ostringstream reason;
  if (!(p >= minimum_mean_stress))
    reason << "the initial mean effective stress with the pressure shift, " << p
           << " Pa, is below the minimum mean stress of " << minimum_mean_stress << " Pa";
  else if (!(principal[0] < shift))
    reason << "hypoplasticity needs compression in all directions; the least compressive principal stress here is "
           << -principal[0] << " Pa, allowed: above " << -shift << " Pa";
  else if (!(point.void_ratio >= low && point.void_ratio <= high))
    reason << "the void ratio " << point.void_ratio
           << " is outside that of the densest and the loosest packing at this "
           << "pressure, " << low << " to " << high;
  for (int i = 0; i < state_size; ++i) state[i] = 0.0;
  return reason.str();
}

double Hypoplasticity::k0(double overconsolidation_ratio) const {
  return earth_pressure_within_strength(std::sin(friction * pi / 180.0), overconsolidation_ratio);
}

EarthPressures Hypoplasticity::earth_pressures(double vertical, double) const {
  return rankine_earth_pressures(vertical, std::sin(friction * pi / 180.0), shift * std::tan(friction * pi / 180.0));
}

template class PointwiseSkeleton<AutomaticTangent<Hypoplasticity>>;

}  // namespace mudline
