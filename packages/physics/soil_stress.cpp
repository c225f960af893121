#include "physics/soil_stress.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "framework/linear_fit.hpp"
#include "physics/soil_points.hpp"

namespace mudline {

namespace {

/// Weights of the values at an element's points in the value of their linear least squares fit at a position; those of
/// the mean where the points do not span the space.
std::vector<double> fit_weights(const Soil& soil, const State& state, int block, int element, const Point& at) {
  using Fit = LinearFit<3>;
  std::vector<Point> points;
  for (int q = 0; q < soil.blocks[block].points; ++q)
    points.push_back(soil.blocks[block].place(element, q, state.coordinates));
  const double share = 1.0 / static_cast<double>(points.size());
  std::vector<double> weights(points.size(), share);
  Fit fit;
  fit.count = Fit::most;
  fit.size = 0;
  Point mean{};
  for (const Point& x : points) mean += share * x;
  std::copy_n(mean.data(), 3, fit.origin);
  for (const Point& x : points) fit.size = std::max(fit.size, length(x - mean));
  if (fit.size == 0) return weights;
  const auto terms = [&](const Point& x, double(&t)[Fit::most]) { fit.terms({x[0], x[1], x[2]}, t); };
  double t[Fit::most];
  for (const Point& x : points) {
    terms(x, t);
    fit.add(t, share);
  }
  if (soil.space->mesh().dimension() == 2) fit.moments.a[3][3] = 1;
  if (!fit.finish()) return weights;
  constexpr double flat = 1e-8;  // relative pivot below which points count as lying in a plane or on a line
  for (int k = 0; k < Fit::most; ++k)
    if (std::abs(fit.moments.a[k][k]) < flat) return weights;
  double here[Fit::most];
  terms(at, here);
  fit.solve(here);
  for (std::size_t q = 0; q < points.size(); ++q) {
    terms(points[q], t);
    weights[q] = share * Fit::value(here, t);
  }
  return weights;
}

}  // namespace

std::array<double, 6> total_stress(const Soil& soil, const State& state, int block, int element, const Point& at) {
  const SoilBlock& b = soil.blocks[block];
  const std::vector<double> weights = fit_weights(soil, state, block, element, at);
  const SoilPoints soil_at(soil, b, state);
  std::array<double, 6> result{};
  for (int q = 0; q < b.points; ++q) {
    const double pressure = b.porous() ? b.scalar_at(element, q, 0, state.value) : 0.0;
    for (int c = 0; c < 6; ++c) {
      const int row = element * b.points + q;
      const double pores = c < 3 ? soil_at.material(row).acting(pressure) : 0.0;
      result[c] += weights[q] * (soil_at.stress(row)[c] - pores);
    }
  }
  return result;
}

double undrained_strength(const Soil& soil, const State& state, int block, int element, const Point& at) {
  const SoilBlock& b = soil.blocks[block];
  const std::vector<double> weights = fit_weights(soil, state, block, element, at);
  const SoilPoints soil_at(soil, b, state);
  double result = 0, of_nearest = 0, least = std::numeric_limits<double>::max();
  bool all = true;
  for (int q = 0; q < b.points; ++q) {
    const double here = soil_at.soil_state(element * b.points + q)
                            .undrained_strength.value_or(std::numeric_limits<double>::quiet_NaN());
    const double away = length(b.place(element, q, state.coordinates) - at);
    if (away < least) of_nearest = here;
    least = std::min(least, away);
    all = all && !std::isnan(here);
    result += weights[q] * here;
  }
  return all ? std::max(0.0, result) : of_nearest;
}

}  // namespace mudline
