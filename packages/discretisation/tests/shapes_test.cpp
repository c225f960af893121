#include "discretisation/shapes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mudline {
namespace {

const std::vector<CellShape> all{CellShape::tri3, CellShape::tri6, CellShape::quad4, CellShape::quad9};

struct Values {
  double N[9], dN[18];
};

Values evaluate(CellShape shape, double xi, double eta) {
  Values v{};
  const double point[2] = {xi, eta};
  evaluate_shape(shape, point, v.N, v.dN);
  return v;
}

std::vector<std::array<double, 2>> node_places(CellShape shape) {
  if (num_corners(shape) == 3) return {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
  return {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}};
}

TEST(Shapes, AreOneAtTheirNodeAndZeroAtTheOthers) {
  for (CellShape shape : all)
    for (int a = 0; a < num_nodes(shape); ++a) {
      const auto place = node_places(shape)[a];
      const Values v = evaluate(shape, place[0], place[1]);
      for (int b = 0; b < num_nodes(shape); ++b) EXPECT_NEAR(v.N[b], a == b ? 1 : 0, 1e-15) << name(shape);
    }
}

TEST(Shapes, SumToOneAndTheirGradientsToZero) {
  for (CellShape shape : all) {
    const Values v = evaluate(shape, 0.31, 0.17);
    double sum = 0, slope[2] = {0, 0};
    for (int a = 0; a < num_nodes(shape); ++a) {
      sum += v.N[a];
      slope[0] += v.dN[2 * a];
      slope[1] += v.dN[2 * a + 1];
    }
    EXPECT_NEAR(sum, 1, 1e-15) << name(shape);
    EXPECT_NEAR(slope[0], 0, 1e-14) << name(shape);
    EXPECT_NEAR(slope[1], 0, 1e-14) << name(shape);
  }
}

TEST(Shapes, GradientsEqualDifferences) {
  const double h = 1e-5;
  for (CellShape shape : all) {
    const Values v = evaluate(shape, 0.31, 0.17);
    const Values right = evaluate(shape, 0.31 + h, 0.17), left = evaluate(shape, 0.31 - h, 0.17);
    const Values above = evaluate(shape, 0.31, 0.17 + h), below = evaluate(shape, 0.31, 0.17 - h);
    for (int a = 0; a < num_nodes(shape); ++a) {
      EXPECT_NEAR(v.dN[2 * a], (right.N[a] - left.N[a]) / (2 * h), 1e-9) << name(shape) << " node " << a;
      EXPECT_NEAR(v.dN[2 * a + 1], (above.N[a] - below.N[a]) / (2 * h), 1e-9) << name(shape) << " node " << a;
    }
  }
}

TEST(Shapes, LineSideIsTheTraceOfTheCell) {
  for (CellShape shape : all)
    for (int side = 0; side < num_sides(shape); ++side) {
      const auto nodes = side_nodes(shape, side);
      const auto a = node_places(shape)[nodes[0]], b = node_places(shape)[nodes[1]];
      const double xi = 0.37;
      double N[3], dN[3];
      evaluate_line(static_cast<int>(nodes.size()), xi, N, dN);
      const Values v =
          evaluate(shape, 0.5 * ((1 - xi) * a[0] + (1 + xi) * b[0]), 0.5 * ((1 - xi) * a[1] + (1 + xi) * b[1]));
      for (std::size_t i = 0; i < nodes.size(); ++i) EXPECT_NEAR(v.N[nodes[i]], N[i], 1e-15) << name(shape);
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

TEST(Quadrature, DegreesBeyondTheTablesAreRefused) {
  EXPECT_THROW(cell_quadrature(CellShape::tri3, 9), std::invalid_argument);
  EXPECT_THROW(cell_quadrature(CellShape::tri3, 0), std::invalid_argument);
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
    const Values v = evaluate(CellShape::tri6, rule.points[q][0], rule.points[q][1]);
    EXPECT_EQ(weights(q), rule.weights[q]);
    for (int a = 0; a < 6; ++a) {
      EXPECT_EQ(N(q, a), v.N[a]);
      EXPECT_EQ(dN(q, a, 1), v.dN[2 * a + 1]);
    }
  }
}

}  // namespace
}  // namespace mudline
