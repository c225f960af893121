#include "physics/solid/point_surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "discretisation/shapes.hpp"
#include "framework/coordinates.hpp"
#include "physics/mixture.hpp"
#include "tensor/mat.hpp"

namespace mudline {

namespace {

/// Root of the area or cube root of the volume of an element, over the order of its cell [m].
template <int D>
double length_of(const SoilBlock& b, int e, const ConstCoordinateView& x) {
  double measure = 0;
  Mat<double, D> J;  // dx / d xi
  for (int q = 0; q < b.points; ++q) {
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) {
        J[i][j] = 0;
        for (int a = 0; a < b.u.nodes; ++a) J[i][j] += x(b.nodes(e, a), i) * b.u.dN(q, a, j);
      }
    measure += b.u.weights(q) * determinant(J);
  }
  return std::pow(std::max(measure, 0.0), 1.0 / D) / order(b.shape);
}

}  // namespace

void write_surroundings(const Soil& soil, const SoilBlock& b, const StepView& view, int first, int last,
                        const PointView& to) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const auto& numbers = soil.space->mesh().blocks()[b.block].global_ids;
  const int warm = place_of_scalar(b, soil.temperature);
  const bool plane = dimension(soil.geometry) == 2;
  for (int e = first; e < last; ++e) {
    const double length = plane ? length_of<2>(b, e, view.x_end) : length_of<3>(b, e, view.x_end);
    for (int q = 0; q < b.points; ++q) {
      double* row = &to((e - first) * b.points + q, 0);
      const Point x = b.place(e, q, view.x_end);
      std::copy_n(x.data(), 3, row + Surroundings::place);
      row[Surroundings::length] = length;
      row[Surroundings::element] = static_cast<double>(numbers[e] + 1);
      row[Surroundings::point] = q + 1;
      const double before = warm < 0 ? unknown : b.scalar_at(e, q, warm, view.value_old);
      row[Surroundings::temperature] = before;
      row[Surroundings::temperature + 1] = warm < 0 ? unknown : b.scalar_at(e, q, warm, view.value_end) - before;
    }
  }
}

}  // namespace mudline
