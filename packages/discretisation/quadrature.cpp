#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "core/pi.hpp"
#include "discretisation/shapes.hpp"

namespace mudline {

namespace {

/// Builds a rule from orbits: points that the symmetries of the triangle map onto each other, given by two area
/// coordinates.
/// Weights are fractions of the area.
class TriangleRule {
 public:
  TriangleRule& centre(double weight) {
    add(1.0 / 3, 1.0 / 3, weight);
    return *this;
  }
  /// (a, a, 1 - 2a) and its rotations.
  TriangleRule& three(double a, double weight) {
    add(a, a, weight);
    add(1 - 2 * a, a, weight);
    add(a, 1 - 2 * a, weight);
    return *this;
  }
  /// All permutations of (a, b, 1 - a - b).
  TriangleRule& six(double a, double b, double weight) {
    const double c = 1 - a - b;
    add(a, b, weight);
    add(b, c, weight);
    add(c, a, weight);
    add(b, a, weight);
    add(a, c, weight);
    add(c, b, weight);
    return *this;
  }
  operator QuadratureRule() const { return rule_; }

 private:
  void add(double xi, double eta, double weight) {
    rule_.points.push_back({xi, eta, 0});
    rule_.weights.push_back(0.5 * weight);
  }
  QuadratureRule rule_;
};

/// Symmetric rules with positive weights and all points inside. Degrees 3 and 7 take the next even rule, because the
/// smaller classical ones have a negative weight.
/// Source: Dunavant 1985, Int. J. Numer. Meth. Engng 21, digits refined by Newton on the moment equations.
QuadratureRule triangle_quadrature(int degree) {
  TriangleRule rule;
  switch (degree) {
    case 1:
      return rule.centre(1);
    case 2:
      return rule.three(1.0 / 6, 1.0 / 3);
    case 3:
    case 4:
      return rule.three(0.44594849091596488632, 0.2233815896780114657)
          .three(0.09157621350977074346, 0.10995174365532186764);
    case 5:
      return rule.centre(0.225)
          .three(0.47014206410511508977, 0.13239415278850618074)
          .three(0.1012865073234563388, 0.1259391805448271526);
    case 6:
      return rule.three(0.24928674517091042129, 0.11678627572637936603)
          .three(0.06308901449150222834, 0.050844906370206816921)
          .six(0.053145049844816947353, 0.31035245103378440542, 0.082851075618373575194);
    case 7:
    case 8:
      return rule.centre(0.14431560767778716825)
          .three(0.45929258829272315603, 0.095091634267284624794)
          .three(0.17056930775176020662, 0.10321737053471825028)
          .three(0.050547228317030975458, 0.032458497623198080311)
          .six(0.0083947774099576053372, 0.26311282963463811342, 0.027230314174434994265);
  }
  throw std::invalid_argument("triangle quadrature exists for the degrees 1 to 8, not " + std::to_string(degree));
}

/// Builds a rule from orbits: points that the symmetries of the tetrahedron map onto each other. Weights are fractions
/// of the volume.
class TetrahedronRule {
 public:
  TetrahedronRule& centre() {
    add_all({0.25, 0.25, 0.25, 0.25}, 1);
    return *this;
  }
  /// One volume coordinate differs: (a, a, a, 1 - 3a) and its permutations.
  TetrahedronRule& four(double a, double weight) {
    add_all({a, a, a, 1 - 3 * a}, weight);
    return *this;
  }
  /// (a, a, 1/2 - a, 1/2 - a) and its permutations.
  TetrahedronRule& six(double a, double weight) {
    add_all({a, a, 0.5 - a, 0.5 - a}, weight);
    return *this;
  }
  /// (a, a, b, 1 - 2a - b) and its permutations.
  TetrahedronRule& twelve(double a, double b, double weight) {
    add_all({a, a, b, 1 - 2 * a - b}, weight);
    return *this;
  }
  operator QuadratureRule() const { return rule_; }

 private:
  void add_all(std::array<double, 4> place, double weight) {
    std::sort(place.begin(), place.end());
    do {
      rule_.points.push_back({place[0], place[1], place[2]});
      rule_.weights.push_back(weight / 6);
    } while (std::next_permutation(place.begin(), place.end()));
  }
  QuadratureRule rule_;
};

/// Symmetric rules with positive weights and all points inside; degrees 3 and 4 use the rule of degree 5.
/// Source: Keast 1986, Comput. Methods Appl. Mech. Engng 55 (degree 6); Walkington 2000 (degree 5); digits refined by
/// Newton on the moment equations.
QuadratureRule tetrahedron_quadrature(int degree) {
  TetrahedronRule rule;
  switch (degree) {
    case 1:
      return rule.centre();
    case 2:
      return rule.four(0.13819660112501051518, 0.25);
    case 3:
    case 4:
    case 5:
      return rule.four(0.3108859192633006098, 0.1126879257180158508)
          .four(0.092735250310891226402, 0.073493043116361949544)
          .six(0.045503704125649649492, 0.042546020777081466438);
    case 6:
      return rule.four(0.21460287125915202929, 0.0399227502581674921)
          .four(0.040673958534611353116, 0.010077211055320642948)
          .four(0.32233789014227551034, 0.055357181543654722095)
          .twelve(0.063661001875017525299, 0.26967233145831580803, 0.048214285714285714286);
  }
  throw std::invalid_argument("tetrahedron quadrature exists for the degrees 1 to 6, not " + std::to_string(degree));
}

}  // namespace

QuadratureRule line_quadrature(int degree) {
  if (degree < 1 || degree > 11)
    throw std::invalid_argument("line quadrature exists for the degrees 1 to 11, not " + std::to_string(degree));
  const int n = degree / 2 + 1;
  QuadratureRule rule;
  rule.points.resize(n);
  rule.weights.resize(n);
  for (int i = 0; i < n; ++i) {
    // Newton on the Legendre polynomial from the Chebyshev-like guess, from the left end to the right.
    double x = -std::cos(pi * (i + 0.75) / (n + 0.5)), slope = 1;
    for (int sweep = 0; sweep < 10; ++sweep) {
      double value = x, before = 1;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
      }
      slope = n * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    rule.points[i] = {x, 0, 0};
    rule.weights[i] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

QuadratureRule cell_quadrature(CellShape shape, int degree) {
  const int simplex = simplex_coordinates(shape);
  QuadratureRule rule{{{0, 0, 0}}, {1.0}};
  if (simplex > 0) rule = simplex == 2 ? triangle_quadrature(degree) : tetrahedron_quadrature(degree);
  // with two points along a quadratic wedge the triangle's rule of degree 2 would leave modes without stiffness
  const bool three = simplex == 2 && order(shape) == 2;
  for (int d = simplex; d < dimension(shape); ++d) {  // the first direction runs fastest
    const QuadratureRule line = line_quadrature(three ? std::max(degree, 4) : degree);
    QuadratureRule product;
    for (std::size_t j = 0; j < line.points.size(); ++j)
      for (std::size_t i = 0; i < rule.points.size(); ++i) {
        product.points.push_back(rule.points[i]);
        product.points.back()[d] = line.points[j][0];
        product.weights.push_back(rule.weights[i] * line.weights[j]);
      }
    rule = product;
  }
  return rule;
}

}  // namespace mudline
