#include "ale/quality.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

namespace {

double determinant(const WholeMesh::Element& element, const Positions& x, const double xi[2]) {
  double N[9], dN[18], j[2][2] = {{0, 0}, {0, 0}};
  evaluate_shape(element.shape, xi, N, dN);
  for (int a = 0; a < num_nodes(element.shape); ++a)
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 2; ++k) j[i][k] += x[element.nodes[a]][i] * dN[2 * a + k];
  return j[0][0] * j[1][1] - j[0][1] * j[1][0];
}

}  // namespace

double scaled_jacobian(const WholeMesh::Element& element, const Positions& x) {
  static constexpr double triangle[7][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}, {1. / 3, 1. / 3}};
  static constexpr double square[9][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}};
  const int corners = num_corners(element.shape);
  double length[4];
  for (int s = 0; s < corners; ++s) {
    const auto &a = x[element.nodes[s]], &b = x[element.nodes[(s + 1) % corners]];
    length[s] = std::hypot(b[0] - a[0], b[1] - a[1]);
  }
  const double ideal = corners == 3 ? 2 / std::sqrt(3.0) : 4.0;  // per reference determinant: sin 60 deg; side 2 of the square
  const int places = order(element.shape) == 1 ? corners : (corners == 3 ? 7 : 9);
  double widest = 0;  // product of two neighbouring edges, for the middle of the element
  for (int s = 0; s < corners; ++s) widest = std::max(widest, length[s] * length[(s + corners - 1) % corners]);
  double lowest = 1e300;
  for (int i = 0; i < places; ++i) {
    const double product = i < corners ? length[i] * length[(i + corners - 1) % corners] : widest;
    lowest = std::min(lowest, ideal * determinant(element, x, corners == 3 ? triangle[i] : square[i]) / product);
  }
  return lowest;
}

double lowest_quality(const WholeMesh& mesh, const Positions& x, int* worst) {
  double lowest = 1e300;
  const auto& elements = mesh.elements();
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const double quality = scaled_jacobian(elements[e], x);
    if (quality >= lowest) continue;
    lowest = quality;
    if (worst) *worst = static_cast<int>(e);
  }
  return lowest;
}

}  // namespace mudline
