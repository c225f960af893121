#include "physics/soil_stress.hpp"

#include <cmath>
#include <vector>

#include "physics/soil_points.hpp"
#include "tensor/mat.hpp"
#include "tensor/small_lu.hpp"

namespace mudline {

namespace {

/// By which the values at points are weighted in that of their linear fit at a place.
std::vector<double> fit_weights(const std::vector<Point>& points, int dimension, const Point& at) {
  const double count = static_cast<double>(points.size());
  std::vector<double> weights(points.size(), 1 / count);
  Point mean{};
  for (const Point& x : points) mean += 1 / count * x;
  Mat<double, 3> spread = {};
  double size = 0;
  for (const Point& x : points)
    for (int i = 0; i < dimension; ++i)
      for (int j = 0; j < dimension; ++j) spread[i][j] += (x[i] - mean[i]) * (x[j] - mean[j]);
  for (int i = 0; i < dimension; ++i) size += spread[i][i] / dimension;
  if (size == 0) return weights;
  SmallLu<3> lu{};
  double slope[3] = {};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) lu.a[i][j] = spread[i][j] / size;
    if (i >= dimension) lu.a[i][i] = 1;
    slope[i] = i < dimension ? (at[i] - mean[i]) / size : 0.0;
  }
  constexpr double flat = 1e-8;  // pivots of points that lie in a plane or on a line
  if (!lu.factorise()) return weights;
  for (int i = 0; i < 3; ++i)
    if (std::abs(lu.a[i][i]) < flat) return weights;
  lu.solve(slope);
  for (std::size_t q = 0; q < points.size(); ++q) weights[q] += dot({slope[0], slope[1], slope[2]}, points[q] - mean);
  return weights;
}

}  // namespace

std::array<double, 6> total_stress(const Soil& soil, const State& state, int block, int element, const Point& at) {
  const SoilBlock& b = soil.blocks[block];
  const int dimension = soil.space->mesh().dimension();
  std::vector<Point> places;
  for (int q = 0; q < b.points; ++q) places.push_back(b.place(element, q, state.coordinates));
  const std::vector<double> weights = fit_weights(places, dimension, at);
  const SoilPoints soil_at(soil, b, state);
  std::array<double, 6> result{};
  for (int q = 0; q < b.points; ++q) {
    const double pressure = b.porous() ? b.scalar_at(element, q, 0, state.value) : 0.0;
    for (int c = 0; c < 6; ++c) {
      const int row = element * b.points + q;
      const double pores = c < 3 ? soil_at.material(row).biot_coefficient * pressure : 0.0;
      result[c] += weights[q] * (soil_at.stress(row)[c] - pores);
    }
  }
  return result;
}

}  // namespace mudline
