#include "framework/side_rule.hpp"

#include "discretisation/element_map.hpp"

namespace mudline {

SideRule::SideRule(CellShape side_, At at, int degree) : side(side_), nodes(num_nodes(side_)) {
  const QuadratureRule gauss = cell_quadrature(side, degree);
  const int corners = num_corners(side);
  samples = static_cast<int>(gauss.weights.size());
  points = at == At::gauss ? samples : at == At::nodes ? nodes : at == At::corners ? corners : 1;
  for (Table* of_samples : {&N, &dN}) *of_samples = Table("side rule", samples, 2 * max_side_nodes);
  shape = Table("side rule", points, 2 * max_side_nodes);
  weight = Table("side rule", points, samples);
  for (int q = 0; q < samples; ++q) {
    evaluate_shape(side, gauss.points[q].data(), &N(q, 0), &dN(q, 0));
    double linear[max_side_nodes], slopes[2 * max_side_nodes];
    evaluate_shape(linear_partner(side), gauss.points[q].data(), linear, slopes);
    for (int c = 0; c < points; ++c) {
      const double share = at == At::gauss     ? (q == c ? 1.0 : 0.0)
                           : at == At::nodes   ? N(q, c)
                           : at == At::corners ? linear[c]
                                               : 1.0;
      weight(c, q) = gauss.weights[q] * share;
    }
  }
  for (int c = 0; c < points; ++c) {
    if (at == At::gauss)
      for (int a = 0; a < nodes; ++a) shape(c, a) = N(c, a);
    else if (at == At::centre)
      for (int a = 0; a < corners; ++a) shape(c, a) = 1.0 / corners;
    else
      shape(c, c) = 1;
    xi.push_back(at == At::gauss ? gauss.points[c] : at == At::centre ? cell_centre(side) : reference_node(side, c));
  }
}

bool point_areas(const SideRule& rule, const SideCoordinates& x, Geometry geometry, double* area) {
  return dimension(rule.side) == 1 ? point_areas<2>(rule, x, geometry, area) : point_areas<3>(rule, x, geometry, area);
}

}  // namespace mudline
