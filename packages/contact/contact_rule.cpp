#include "contact/contact_rule.hpp"

#include <algorithm>
#include <cmath>

#include "tensor/vec.hpp"

namespace mudline {

namespace {

template <int D>
Point outward_normal(const ContactRule& rule, int c, const SideCoordinates& x) {
  SideMap<D> map;
  map.compute(rule.nodes, &rule.shape(c, 0), &rule.shape_slope(c, 0), [&](int a, int i) { return x[a][i]; });
  Point result{};
  for (int i = 0; i < D; ++i) result[i] = map.normal[i] / map.stretch;
  return result;
}

template <int D>
bool areas_and_slopes(const SideRule& rule, const SideCoordinates& x, Geometry geometry, double* area,
                      AreaSlopes& slope) {
  constexpr int places = D * (D == 2 ? max_line_nodes : max_side_nodes);
  Vec<Dual<places>, D> node[max_side_nodes];
  for (int a = 0; a < rule.nodes; ++a)
    for (int i = 0; i < D; ++i) node[a][i] = Dual<places>(x[a][i], D * a + i);
  Dual<places> numbers[max_contact_points];
  if (!point_areas<D>(rule, node, geometry, numbers)) return false;
  for (int c = 0; c < rule.points; ++c) {
    area[c] = numbers[c].v;
    std::copy_n(numbers[c].d, D * rule.nodes, slope[c]);
  }
  return true;
}

}  // namespace

double farthest(const SideCoordinates& x) {
  double result = 0;
  for (const Point& point : x) result = std::max(result, length(point));
  return result;
}

ContactRule::ContactRule(At at, CellShape side_, int degree) : SideRule(side_, at, degree) {
  const bool positive = side != CellShape::tri6 && side != CellShape::quad8;  // integrals of the corners' own shapes
  multipliers = positive ? nodes : num_corners(side);
  for (Table* of_points : {&corner, &shape_slope, &corner_slope})
    *of_points = Table("contact rule", points, 2 * max_side_nodes);
  for (int c = 0; c < points; ++c) {
    double values[max_side_nodes];
    evaluate_shape(side, xi[c].data(), values, &shape_slope(c, 0));
    evaluate_shape(linear_partner(side), xi[c].data(), &corner(c, 0), &corner_slope(c, 0));
  }
}

bool point_areas(const SideRule& rule, const SideCoordinates& x, Geometry geometry, double* area, AreaSlopes& slope) {
  return dimension(rule.side) == 1 ? areas_and_slopes<2>(rule, x, geometry, area, slope)
                                   : areas_and_slopes<3>(rule, x, geometry, area, slope);
}

Point ContactRule::outward(int c, const SideCoordinates& x) const {
  return dimension(side) == 1 ? outward_normal<2>(*this, c, x) : outward_normal<3>(*this, c, x);
}

double nearness(const ContactRule& rule, int point, int node) {
  const double half = is_simplex(rule.side) ? 0.5 : 1.0;  // in reference coordinates
  const auto at = reference_node(rule.side, node);
  double away = 0;
  for (int k = 0; k < dimension(rule.side); ++k) away = std::max(away, std::abs(rule.xi[point][k] - at[k]) / half);
  return std::max(0.0, 1 - away);
}

}  // namespace mudline
