#include "discretisation/element_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mudline {

double beyond_side(CellShape shape, int side, const double xi[2]) {
  if (num_corners(shape) == 3) return side == 0 ? -xi[1] : (side == 1 ? xi[0] + xi[1] - 1 : -xi[0]);
  switch (side) {
    case 0:
      return -1 - xi[1];
    case 1:
      return xi[0] - 1;
    case 2:
      return xi[1] - 1;
    default:
      return -1 - xi[0];
  }
}

double outside_cell(CellShape shape, const double xi[2]) {
  double worst = -1e300;
  for (int s = 0; s < num_sides(shape); ++s) worst = std::max(worst, beyond_side(shape, s, xi));
  return worst;
}

std::array<double, 2> on_side(CellShape shape, int side, double t) {
  static constexpr double triangle[4][2] = {{0, 0}, {1, 0}, {0, 1}, {0, 0}},
                          square[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  const auto& from = num_corners(shape) == 3 ? triangle[side] : square[side];
  const auto& to = num_corners(shape) == 3 ? triangle[side + 1] : square[side + 1];
  return {from[0] + 0.5 * (1 + t) * (to[0] - from[0]), from[1] + 0.5 * (1 + t) * (to[1] - from[1])};
}

CellMap<2> ElementMap::map(const double xi[2], std::array<double, 2>& x) const {
  double N[9], dN[18], slope[2][2] = {};
  evaluate_shape(shape_, xi, N, dN);
  x = {};
  for (int a = 0; a < nodes_; ++a)
    for (int i = 0; i < 2; ++i) {
      x[i] += N[a] * x_[a][i];
      for (int k = 0; k < 2; ++k) slope[i][k] += x_[a][i] * dN[2 * a + k];
    }
  CellMap<2> result;
  result.compute(slope);
  return result;
}

std::array<double, 2> ElementMap::at(const double xi[2]) const {
  std::array<double, 2> x;
  map(xi, x);
  return x;
}

double ElementMap::determinant(const double xi[2]) const {
  std::array<double, 2> x;
  return map(xi, x).det;
}

bool ElementMap::invert(const std::array<double, 2>& point, double xi[2]) const {
  const double middle = num_corners(shape_) == 3 ? 1.0 / 3 : 0.0;
  xi[0] = xi[1] = middle;
  for (int iteration = 0; iteration < 30; ++iteration) {
    std::array<double, 2> x;
    const CellMap<2> here = map(xi, x);
    if (!(std::abs(here.det) > 0)) return false;
    const double r[2] = {point[0] - x[0], point[1] - x[1]};
    double step[2];
    for (int k = 0; k < 2; ++k) step[k] = here.inverse[k][0] * r[0] + here.inverse[k][1] * r[1];
    const double size = std::hypot(step[0], step[1]);
    if (!(size < 1e6)) return false;
    const double factor = size > 1 ? 1 / size : 1.0;  // far from the solution the quadratic map misleads
    xi[0] += factor * step[0];
    xi[1] += factor * step[1];
    if (size < 1e-13) return true;
  }
  return outside_cell(shape_, xi) < 0.5;
}

double ElementMap::scaled_jacobian() const {
  static constexpr double triangle[7][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}, {1. / 3, 1. / 3}};
  static constexpr double square[9][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}};
  const int corners = num_corners(shape_);
  double length[4];
  for (int s = 0; s < corners; ++s) {
    const double *a = x_[s], *b = x_[(s + 1) % corners];
    length[s] = std::hypot(b[0] - a[0], b[1] - a[1]);
  }
  const double ideal =
      corners == 3 ? 2 / std::sqrt(3.0) : 4.0;  // per reference determinant: sin 60 deg; side 2 of the square
  const int places = order(shape_) == 1 ? corners : (corners == 3 ? 7 : 9);
  double widest = 0;  // product of two neighbouring edges, for the middle of the element
  for (int s = 0; s < corners; ++s) widest = std::max(widest, length[s] * length[(s + corners - 1) % corners]);
  double lowest = 1e300;
  for (int i = 0; i < places; ++i) {
    const double product = i < corners ? length[i] * length[(i + corners - 1) % corners] : widest;
    const double here = ideal * determinant(corners == 3 ? triangle[i] : square[i]) / product;
    if (std::isnan(here)) return -std::numeric_limits<double>::infinity();
    lowest = std::min(lowest, here);
  }
  return lowest;
}

}  // namespace mudline
