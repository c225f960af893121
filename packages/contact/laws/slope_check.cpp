#include "contact/laws/slope_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/guarded.hpp"

namespace mudline {

namespace {

constexpr double relative_step = 1e-4, tolerance = 1e-3, floor = 1e-6;
constexpr double pore_scale = 1e5;  // [Pa] scale of the changes of pore pressures

/// One slope of a law at one point: the given one, and the differences of the value to either side.
struct Slope {
  double given, below, above;
  double size;  // value over argument: below a millionth of it no slope matters

  double error() const {
    const double low = std::min(below, above), high = std::max(below, above);
    const double off = std::max({low - given, given - high, 0.0});
    const double allowed = tolerance * std::max({std::abs(given), std::abs(below), std::abs(above)}) + floor * size;
    return off > allowed ? off / std::max({std::abs(below), std::abs(above), std::abs(given)}) : 0.0;
  }
};

/// The worst of one kind of slope over all points.
class Findings {
 public:
  explicit Findings(std::string what) : what_(std::move(what)) {}
  template <class Place>
  void add(const Slope& slope, const Place& place) {
    if (!std::isfinite(slope.below) || !std::isfinite(slope.above)) return;  // not a slope's fault: reported elsewhere
    ++points_;
    const double error = std::isfinite(slope.given) ? slope.error() : 1e300;
    if (!(error > 0)) return;
    ++wrong_;
    if (error <= worst_) return;
    worst_ = error;
    char text[200];
    std::snprintf(text, sizeof text, "%s is %.4g, differences give %.4g (%s", what_.c_str(), slope.given,
                  0.5 * (slope.below + slope.above), place().c_str());
    text_ = text;
  }
  /// Message; "" where at most one point is wrong, since a value may jump there.
  std::string problem() const {
    return wrong_ < 2 ? "" : text_ + "; " + std::to_string(wrong_) + " of " + std::to_string(points_) + " points)";
  }

 private:
  std::string what_, text_;
  int points_ = 0, wrong_ = 0;
  double worst_ = 0;
};

std::string of(const char* format, double one, double two) {
  char text[120];
  std::snprintf(text, sizeof text, format, one, two);
  return text;
}

/// The slope of value(x) at x from differences over `step`.
template <class Value>
Slope slope_of(double given, double x, double step, double scale, const Value& value) {
  const double here = value(x);
  return {given, (here - value(x - step)) / step, (value(x + step) - here) / step, std::abs(here) / scale};
}

TouchingSoil soil_of(const SoilQuantities& reads, bool pressed, double pore_pressure) {
  TouchingSoil soil;
  soil.pore_pressure = reads.pore_pressure || pressed ? pore_pressure : TouchingSoil::unknown;
  if (reads.temperature) soil.temperature = 20;
  if (reads.mean_stress) soil.mean_stress = 1e5;
  if (reads.undrained_strength) soil.undrained_strength = 2e4;
  return soil;
}

std::string first_of(const std::vector<std::string>& problems) {
  for (const std::string& problem : problems)
    if (!problem.empty()) return problem;
  return "";
}

std::string find_problem(const Friction& law) {
  Findings by_normal("d strength / d normal"), by_rate("d strength / d rate [Pa s/m]"),
      by_pressure("d strength / d pore pressure");
  std::vector<FrictionPoint> points;
  for (const double normal : {1e2, 1e3, 1e4, 5e4, 1e5, 1e6})
    for (const double rate : {0.0, 1e-5, 1e-3, 0.02, 0.5})
      for (const double pressure : {0.0, 3e4})
        for (const double slip : {0.0, 1e-3, 0.1}) {
          if (slip > 0 && !law.reads_slip()) continue;
          FrictionPoint at;
          at.normal = normal;
          at.rate = rate;
          at.slip = law.reads_slip() ? slip : TouchingSoil::unknown;
          at.soil = soil_of(law.reads(), law.effective(), pressure);
          points.push_back(at);
          if (!law.reads().strength_if_any) continue;
          at.soil.undrained_strength = TouchingSoil::unknown;
          points.push_back(at);
        }
  for (const FrictionPoint& at : points) {
    const ShearStrength here = law.strength(at);
    const auto place = [&] { return of("normal traction %.4g Pa, speed %.4g m/s", at.normal, at.rate); };
    const auto changed = [&](double FrictionPoint::*what) {
      return [&law, &at, what](double x) {
        FrictionPoint there = at;
        there.*what = x;
        return law.strength(there).value;
      };
    };
    by_normal.add(
        slope_of(here.slope, at.normal, relative_step * at.normal, at.normal, changed(&FrictionPoint::normal)), place);
    if (at.rate > 0)
      by_rate.add(slope_of(here.rate_slope, at.rate, relative_step * at.rate, at.rate, changed(&FrictionPoint::rate)),
                  place);
    if (!law.reads().pore_pressure) continue;
    const auto pressed = [&law, &at](double x) {
      FrictionPoint there = at;
      there.soil.pore_pressure = x;
      return law.strength(there).value;
    };
    by_pressure.add(slope_of(here.pore_slope, at.soil.pore_pressure, relative_step * pore_scale, pore_scale, pressed),
                    place);
  }
  return first_of({by_normal.problem(), by_rate.problem(), by_pressure.problem()});
}

std::string find_problem(const NormalLaw& law, double stiffness) {
  Findings by_depth("d pressure / d penetration [Pa/m]"), by_pressure("d pressure / d pore pressure");
  for (const double penetration : {1e-7, 1e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 1e-2})
    for (const double pressure : {0.0, 3e4}) {
      const TouchingSoil soil = soil_of(law.reads(), false, pressure);
      const NormalPressure here = law.at(penetration, stiffness, soil);
      const auto place = [&] { return of("penetration %.4g m, stiffness %.4g Pa/m", penetration, stiffness); };
      by_depth.add(slope_of(here.slope, penetration, relative_step * penetration, penetration,
                            [&](double x) { return law.at(x, stiffness, soil).value; }),
                   place);
      if (!law.reads().pore_pressure) continue;
      const auto pressed = [&](double x) {
        TouchingSoil wetter = soil;
        wetter.pore_pressure = x;
        return law.at(penetration, stiffness, wetter).value;
      };
      by_pressure.add(slope_of(here.pore_slope, pressure, relative_step * pore_scale, pore_scale, pressed), place);
    }
  return first_of({by_depth.problem(), by_pressure.problem()});
}

template <class Find>
std::string guarded_problem(const Find& find) {
  try {
    return find();
  } catch (...) {
    return "it throws: " + fault_thrown();
  }
}

}  // namespace

std::string slope_problem(const Friction& law) {
  return guarded_problem([&] { return find_problem(law); });
}

std::string slope_problem(const NormalLaw& law, double stiffness) {
  return guarded_problem([&] { return find_problem(law, stiffness); });
}

}  // namespace mudline
