#include "contact/contact_rule.hpp"

#include <algorithm>
#include <cmath>

namespace mudline {

double farthest(const SideCoordinates& x) {
  double result = 0;
  for (const PlanePoint& point : x) result = std::max(result, std::hypot(point[0], point[1]));
  return result;
}

ContactRule::ContactRule(ContactPoints kind, int nodes_, int degree) : nodes(nodes_) {
  const QuadratureRule gauss = line_quadrature(degree);
  samples = static_cast<int>(gauss.weights.size());
  N.assign(samples, {});
  dN.assign(samples, {});
  for (int q = 0; q < samples; ++q) evaluate_line(nodes, gauss.points[q][0], N[q].data(), dN[q].data());
  const bool nodal = kind == ContactPoints::nodes;
  points = nodal ? nodes : samples;
  shape.assign(points, {});
  weight.assign(points, std::vector<double>(samples, 0.0));
  for (int c = 0; c < points; ++c) {
    if (nodal) {
      constexpr double node_xi[max_side_nodes] = {-1, 1, 0};
      xi.push_back(node_xi[c]);
      shape[c][c] = 1;
      for (int q = 0; q < samples; ++q) weight[c][q] = gauss.weights[q] * N[q][c];
    } else {
      xi.push_back(gauss.points[c][0]);
      shape[c] = N[c];
      weight[c][c] = gauss.weights[c];
    }
  }
}

PlanePoint ContactRule::place(int c, const SideCoordinates& x) const {
  PlanePoint at{};
  for (int a = 0; a < nodes; ++a)
    for (int i = 0; i < 2; ++i) at[i] += shape[c][a] * x[a][i];
  return at;
}

}  // namespace mudline
