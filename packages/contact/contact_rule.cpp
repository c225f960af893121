#include "contact/contact_rule.hpp"

#include <algorithm>
#include <cmath>

#include "core/space_vector.hpp"

namespace mudline {

double farthest(const SideCoordinates& x) {
  double result = 0;
  for (const Point& point : x) result = std::max(result, length(point));
  return result;
}

ContactRule::ContactRule(ContactPoints kind, CellShape side_, int degree) : side(side_), nodes(num_nodes(side_)) {
  const QuadratureRule gauss = cell_quadrature(side, degree);
  samples = static_cast<int>(gauss.weights.size());
  N.assign(samples, {});
  dN.assign(samples, {});
  for (int q = 0; q < samples; ++q) evaluate_shape(side, gauss.points[q].data(), N[q].data(), dN[q].data());
  const bool nodal = kind == ContactPoints::nodes;
  points = nodal ? nodes : samples;
  shape.assign(points, {});
  corner.assign(points, {});
  shape_slope.assign(points, {});
  corner_slope.assign(points, {});
  weight.assign(points, std::vector<double>(samples, 0.0));
  for (int c = 0; c < points; ++c) {
    if (nodal) {
      xi.push_back(reference_node(side, c));
      shape[c][c] = 1;
      for (int q = 0; q < samples; ++q) weight[c][q] = gauss.weights[q] * N[q][c];
    } else {
      xi.push_back(gauss.points[c]);
      shape[c] = N[c];
      weight[c][c] = gauss.weights[c];
    }
    double values[max_side_nodes];
    evaluate_shape(side, xi[c].data(), values, shape_slope[c].data());
    evaluate_shape(linear_partner(side), xi[c].data(), corner[c].data(), corner_slope[c].data());
  }
}

Point ContactRule::place(int c, const SideCoordinates& x) const {
  Point at{};
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < 3; ++i) at[i] += shape[c][a] * x[a][i];
  return at;
}

bool contact_areas(const ContactRule& rule, const SideCoordinates& x, Geometry geometry, double* area) {
  return dimension(rule.side) == 1 ? contact_areas<2>(rule, x, geometry, area)
                                   : contact_areas<3>(rule, x, geometry, area);
}

double nearness(const ContactRule& rule, int point, int node) {
  const double half = is_simplex(rule.side) ? 0.5 : 1.0;  // in reference coordinates
  const auto at = reference_node(rule.side, node);
  double away = 0;
  for (int k = 0; k < dimension(rule.side); ++k) away = std::max(away, std::abs(rule.xi[point][k] - at[k]) / half);
  return std::max(0.0, 1 - away);
}

}  // namespace mudline
