#include "discretisation/shapes.hpp"
#include "tensor/vec.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mudline {
namespace {

const std::vector<CellShape> plane{CellShape::tri3, CellShape::tri6, CellShape::quad4, CellShape::quad9},
    space{CellShape::tet4,   CellShape::tet10,   CellShape::hex8,   CellShape::hex27,
          CellShape::wedge6, CellShape::wedge15, CellShape::wedge18},
    all{CellShape::line2, CellShape::line3,  CellShape::tri3,    CellShape::tri6,   CellShape::quad4,
        CellShape::quad8, CellShape::quad9,  CellShape::tet4,    CellShape::tet10,  CellShape::hex8,
        CellShape::hex27, CellShape::wedge6, CellShape::wedge15, CellShape::wedge18};

using Place = Vec<double, 3>;

struct Values {
  double N[27], dN[81];
};

Values evaluate(CellShape shape, const Place& xi) {
  Values v{};
  evaluate_shape(shape, xi.data(), v.N, v.dN);
  return v;
}

TEST(Shapes, NodesOfThePlaneAndOfTheEdgesOfSpace) {
  const Place triangle[] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  const Place square[] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}};
  for (int a = 0; a < 6; ++a) EXPECT_EQ(reference_node(CellShape::tri6, a), triangle[a]);
  for (int a = 0; a < 9; ++a) EXPECT_EQ(reference_node(CellShape::quad9, a), square[a]);
  EXPECT_EQ(reference_node(CellShape::tet10, 9), (Place{0, 0.5, 0.5}));  // the last edge joins the last two corners
  EXPECT_EQ(reference_node(CellShape::hex27, 16), (Place{-1, -1, 0}));   // the first upright edge
  EXPECT_EQ(reference_node(CellShape::hex27, 21), (Place{1, 0, 0}));     // faces: x, y, z, low before high
  EXPECT_EQ(reference_node(CellShape::hex27, 24), (Place{0, 0, -1}));
  EXPECT_EQ(reference_node(CellShape::hex27, 26), (Place{0, 0, 0}));
}

TEST(Shapes, AreOneAtTheirNodeAndZeroAtTheOthers) {
  for (CellShape shape : all)
    for (int a = 0; a < num_nodes(shape); ++a) {
      const Values v = evaluate(shape, reference_node(shape, a));
      for (int b = 0; b < num_nodes(shape); ++b) EXPECT_NEAR(v.N[b], a == b ? 1 : 0, 1e-15) << name(shape);
    }
}

TEST(Shapes, SumToOneAndTheirGradientsToZero) {
  for (CellShape shape : all) {
    const Values v = evaluate(shape, {0.31, 0.17, 0.23});
    double sum = 0, slope[3] = {0, 0, 0};
    for (int a = 0; a < num_nodes(shape); ++a) {
      sum += v.N[a];
      for (int d = 0; d < dimension(shape); ++d) slope[d] += v.dN[dimension(shape) * a + d];
    }
    EXPECT_NEAR(sum, 1, 1e-15) << name(shape);
    for (const double s : slope) EXPECT_NEAR(s, 0, 1e-14) << name(shape);
  }
}

TEST(Shapes, GradientsEqualDifferences) {
  const double h = 1e-5;
  for (CellShape shape : all) {
    const Place at{0.31, 0.17, 0.23};
    const Values v = evaluate(shape, at);
    for (int d = 0; d < dimension(shape); ++d) {
      Place above = at, below = at;
      above[d] += h;
      below[d] -= h;
      const Values high = evaluate(shape, above), low = evaluate(shape, below);
      for (int a = 0; a < num_nodes(shape); ++a)
        EXPECT_NEAR(v.dN[dimension(shape) * a + d], (high.N[a] - low.N[a]) / (2 * h), 1e-9)
            << name(shape) << " node " << a;
    }
  }
}

/// The point xi of a side, in the reference coordinates of the cell.
Place on_side(CellShape shape, int side, const Place& xi) {
  const std::vector<int>& nodes = side_nodes(shape, side);
  const CellShape flat = linear_partner(side_shape(shape, side));
  const Values v = evaluate(flat, xi);
  Place at{};
  for (int c = 0; c < num_nodes(flat); ++c)
    for (int i = 0; i < 3; ++i) at[i] += v.N[c] * reference_node(shape, nodes[c])[i];
  return at;
}

TEST(Shapes, OfASideAreTheTraceOfTheCell) {
  for (const auto& cells : {plane, space})
    for (CellShape shape : cells)
      for (int side = 0; side < num_sides(shape); ++side) {
        const auto nodes = side_nodes(shape, side);
        const CellShape flat = side_shape(shape, side);
        ASSERT_EQ(nodes.size(), num_nodes(flat));
        const Place xi{0.37, dimension(flat) == 2 ? 0.21 : 0.0, 0};
        const Values trace = evaluate(flat, xi), v = evaluate(shape, on_side(shape, side, xi));
        for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_NEAR(v.N[nodes[i]], trace.N[i], 1e-15) << name(shape);
      }
}

TEST(Shapes, SidesLookOutward) {
  for (CellShape shape : {CellShape::tet4, CellShape::hex8, CellShape::wedge6})
    for (int side = 0; side < num_sides(shape); ++side) {
      const auto nodes = side_nodes(shape, side);
      const Place a = reference_node(shape, nodes[0]), b = reference_node(shape, nodes[1]),
                  c = reference_node(shape, nodes.back());
      double outward = 0;  // normal times the vector from the cell's centre
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double middle = i >= simplex_coordinates(shape) ? 0 : is_simplex(shape) ? 0.25 : 1.0 / 3;
        outward += ((b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j])) * (a[i] - middle);
      }
      EXPECT_GT(outward, 0) << name(shape) << " side " << side;
    }
}

TEST(Shapes, LineGradientsEqualDifferences) {
  const double h = 1e-5;
  for (int n : {2, 3}) {
    double N[3], dN[3], right[3], left[3], unused[3];
    evaluate_line(n, 0.2, N, dN);
    evaluate_line(n, 0.2 + h, right, unused);
    evaluate_line(n, 0.2 - h, left, unused);
    for (int a = 0; a < n; ++a) EXPECT_NEAR(dN[a], (right[a] - left[a]) / (2 * h), 1e-9);
  }
  double N[4], dN[4];
  EXPECT_THROW(evaluate_line(4, 0, N, dN), std::invalid_argument);
}

double factorial(int n) { return std::tgamma(n + 1.0); }

TEST(Quadrature, TriangleIsExactToItsDegree) {
  for (int degree = 1; degree <= 8; ++degree) {
    const QuadratureRule rule = cell_quadrature(CellShape::tri6, degree);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      EXPECT_GT(rule.weights[q], 0);
      EXPECT_GT(std::min({rule.points[q][0], rule.points[q][1], 1 - rule.points[q][0] - rule.points[q][1]}), 0);
    }
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j) {
        double sum = 0;
        for (std::size_t q = 0; q < rule.points.size(); ++q)
          sum += rule.weights[q] * std::pow(rule.points[q][0], i) * std::pow(rule.points[q][1], j);
        EXPECT_NEAR(sum, factorial(i) * factorial(j) / factorial(i + j + 2), 1e-16) << degree << " " << i << " " << j;
      }
  }
}

TEST(Quadrature, TetrahedronIsExactToItsDegree) {
  for (int degree = 1; degree <= 6; ++degree) {
    const QuadratureRule rule = cell_quadrature(CellShape::tet10, degree);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const auto& x = rule.points[q];
      EXPECT_GT(rule.weights[q], 0);
      EXPECT_GT(std::min({x[0], x[1], x[2], 1 - x[0] - x[1] - x[2]}), 0);
    }
    for (int i = 0; i <= degree; ++i)
      for (int j = 0; i + j <= degree; ++j)
        for (int k = 0; i + j + k <= degree; ++k) {
          double sum = 0;
          for (std::size_t q = 0; q < rule.points.size(); ++q)
            sum += rule.weights[q] * std::pow(rule.points[q][0], i) * std::pow(rule.points[q][1], j) *
                   std::pow(rule.points[q][2], k);
          const double exact = factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3);
          EXPECT_NEAR(sum, exact, 1e-16) << degree << " " << i << " " << j << " " << k;
        }
  }
}

double moment(int power) { return power % 2 == 1 ? 0.0 : 2.0 / (power + 1); }

TEST(Quadrature, SquareAndLineAreExactToTheirDegree) {
  for (int degree = 1; degree <= 11; ++degree) {
    const QuadratureRule line = line_quadrature(degree), square = cell_quadrature(CellShape::quad9, degree);
    EXPECT_EQ(square.points.size(), line.points.size() * line.points.size());
    for (int i = 0; i <= degree; ++i) {
      double sum = 0;
      for (std::size_t q = 0; q < line.points.size(); ++q) sum += line.weights[q] * std::pow(line.points[q][0], i);
      EXPECT_NEAR(sum, moment(i), 4e-15) << degree << " " << i;
      for (int j = 0; j <= degree; ++j) {
        sum = 0;
        for (std::size_t q = 0; q < square.points.size(); ++q)
          sum += square.weights[q] * std::pow(square.points[q][0], i) * std::pow(square.points[q][1], j);
        EXPECT_NEAR(sum, moment(i) * moment(j), 4e-15) << degree << " " << i << " " << j;
      }
    }
  }
}

TEST(Quadrature, CubeIsExactToItsDegree) {
  const QuadratureRule rule = cell_quadrature(CellShape::hex27, 5);
  EXPECT_EQ(rule.points.size(), 27);
  for (int i = 0; i <= 5; ++i)
    for (int j = 0; j <= 5; ++j) {
      double sum = 0;
      for (std::size_t q = 0; q < rule.points.size(); ++q)
        sum += rule.weights[q] * std::pow(rule.points[q][0], i) * std::pow(rule.points[q][1], j) *
               std::pow(rule.points[q][2], 4);
      EXPECT_NEAR(sum, moment(i) * moment(j) * moment(4), 4e-15) << i << " " << j;
    }
}

TEST(Quadrature, WedgeIsExactToItsDegreeInTheTriangleAndAlongTheLine) {
  EXPECT_EQ(cell_quadrature(CellShape::wedge6, 2).points.size(), 6u);
  EXPECT_EQ(cell_quadrature(CellShape::wedge15, 2).points.size(), 9u) << "two layers would leave free modes";
  for (CellShape shape : {CellShape::wedge6, CellShape::wedge15, CellShape::wedge18})
    for (int degree = 1; degree <= 8; ++degree) {
      const QuadratureRule rule = cell_quadrature(shape, degree);
      for (int i = 0; i <= degree; ++i)
        for (int j = 0; i + j <= degree; ++j)
          for (int k = 0; k <= degree; ++k) {
            double sum = 0;
            for (std::size_t q = 0; q < rule.points.size(); ++q)
              sum += rule.weights[q] * std::pow(rule.points[q][0], i) * std::pow(rule.points[q][1], j) *
                     std::pow(rule.points[q][2], k);
            const double exact = factorial(i) * factorial(j) / factorial(i + j + 2) * moment(k);
            EXPECT_NEAR(sum, exact, 1e-15) << degree << " " << i << " " << j << " " << k;
          }
    }
}

TEST(Shapes, QuadraticFieldsLieInTheQuadraticCells) {
  const auto field = [](const Place& x) {
    return 1 + x[0] - 2 * x[1] + 0.5 * x[2] + x[0] * x[1] - x[1] * x[2] + 0.3 * x[0] * x[2] + x[0] * x[0] -
           0.7 * x[1] * x[1] + 1.3 * x[2] * x[2];
  };
  const Place at{0.31, 0.17, 0.23};
  for (CellShape shape : {CellShape::tet10, CellShape::hex27, CellShape::wedge15, CellShape::wedge18}) {
    const Values v = evaluate(shape, at);
    double value = 0, slope[3] = {};
    for (int a = 0; a < num_nodes(shape); ++a) {
      value += v.N[a] * field(reference_node(shape, a));
      for (int d = 0; d < 3; ++d) slope[d] += v.dN[3 * a + d] * field(reference_node(shape, a));
    }
    EXPECT_NEAR(value, field(at), 1e-14) << name(shape);
    EXPECT_NEAR(slope[0], 1 + at[1] + 0.3 * at[2] + 2 * at[0], 1e-13) << name(shape);
    EXPECT_NEAR(slope[1], -2 + at[0] - at[2] - 1.4 * at[1], 1e-13) << name(shape);
    EXPECT_NEAR(slope[2], 0.5 - at[1] + 0.3 * at[0] + 2.6 * at[2], 1e-13) << name(shape);
  }
}

TEST(Quadrature, DegreesBeyondTheTablesAreRefused) {
  EXPECT_THROW(cell_quadrature(CellShape::tri3, 9), std::invalid_argument);
  EXPECT_THROW(cell_quadrature(CellShape::tri3, 0), std::invalid_argument);
  EXPECT_THROW(cell_quadrature(CellShape::tet4, 7), std::invalid_argument);
  EXPECT_THROW(line_quadrature(12), std::invalid_argument);
}

TEST(ShapeTable, HoldsTheShapesAtTheRulesPoints) {
  const QuadratureRule rule = cell_quadrature(CellShape::tri6, 4);
  const ShapeTable table = tabulate(CellShape::tri6, rule);
  ASSERT_EQ(table.points, 6);
  ASSERT_EQ(table.nodes, 6);
  const auto N = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), table.N);
  const auto dN = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), table.dN);
  const auto weights = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), table.weights);
  for (int q = 0; q < 6; ++q) {
    const Values v = evaluate(CellShape::tri6, rule.points[q]);
    EXPECT_EQ(weights(q), rule.weights[q]);
    for (int a = 0; a < 6; ++a) {
      EXPECT_EQ(N(q, a), v.N[a]);
      EXPECT_EQ(dN(q, a, 1), v.dN[2 * a + 1]);
    }
  }
}

}  // namespace
}  // namespace mudline
