#include "physics/overconsolidation.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/told.hpp"
#include "materials/guarded_law.hpp"

namespace mudline {

namespace {

constexpr double largest_ratio = 1e4;  // of overconsolidation
constexpr double flat = 1e-9;          // relative change of a strength that does not follow the ratio

/// The undrained strength of a point for its overconsolidation ratio.
class StrengthOfRatio {
 public:
  StrengthOfRatio(const SoilMaterial& material, const std::function<std::string(InitialPoint&)>& rest,
                  InitialPoint& point)
      : material_(material), rest_(rest), point_(point), state_(material.skeleton->state_size()) {}

  /// Sets ratio, stress and void ratio of the point. NaN with a problem, and where the law has no undrained strength.
  double operator()(double ratio) {
    point_.overconsolidation_ratio = ratio;
    problem = rest_(point_);
    if (problem.empty()) problem = material_.find_void_ratio(point_);
    if (problem.empty()) problem = start_guarded(*material_.skeleton, point_, state_.data());
    if (!problem.empty()) return std::nan("");
    const SoilState found = material_.skeleton->soil_state(point_.stress.data(), point_.void_ratio, state_.data());
    return found.undrained_strength.value_or(std::nan(""));
  }

  std::string problem;

 private:
  const SoilMaterial& material_;
  const std::function<std::string(InitialPoint&)>& rest_;
  InitialPoint& point_;
  std::vector<double> state_;
};

}  // namespace

std::string overconsolidate(const SoilMaterial& material, double strength,
                            const std::function<std::string(InitialPoint&)>& rest, InitialPoint& point) {
  const auto wanted = [&] { return told(strength, "an undrained strength of %.4g Pa"); };
  StrengthOfRatio strength_of(material, rest, point);
  const double least = strength_of(1);
  if (std::isnan(least)) return strength_of.problem;
  if (std::abs(least / strength - 1) < flat) return "";
  if (strength < least) return wanted() + " is less than that of normally consolidated soil, " + told(least, "%.4g Pa");
  // a bracket that grows: a law may refuse ratios far beyond the one that is wanted
  double low = 1, high = 1, at_low = least, at_high = least;
  while (at_high < strength) {
    low = high;
    at_low = at_high;
    high *= 2;
    at_high = strength_of(high);
    if (!strength_of.problem.empty()) return strength_of.problem;
    if (std::abs(at_high / least - 1) < flat)
      return "the undrained strength of the law '" + material.law +
             "' does not follow from an overconsolidation ratio; give it in 'skeleton'";
    if (high > largest_ratio)
      return wanted() + " needs an overconsolidation ratio above " + told(largest_ratio, "%.4g");
  }
  std::uintmax_t evaluations = 100;
  const auto root = boost::math::tools::toms748_solve(
      [&](double log_ratio) {
        const double found = strength_of(std::exp(log_ratio));
        return strength_of.problem.empty() ? std::log(found / strength) : 0.0;
      },
      std::log(low), std::log(high), std::log(at_low / strength), std::log(at_high / strength),
      boost::math::tools::eps_tolerance<double>(40), evaluations);
  if (strength_of.problem.empty()) strength_of(std::exp(0.5 * (root.first + root.second)));
  return strength_of.problem;
}

}  // namespace mudline
