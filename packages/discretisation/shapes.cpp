#include "discretisation/shapes.hpp"

#include <algorithm>
#include <stdexcept>

namespace mudline {

int num_nodes(CellShape shape) {
  switch (shape) {
    case CellShape::tri3:
      return 3;
    case CellShape::tri6:
      return 6;
    case CellShape::quad4:
      return 4;
    case CellShape::quad9:
      return 9;
  }
  throw std::logic_error("unknown cell shape");
}

int num_corners(CellShape shape) { return linear_partner(shape) == CellShape::tri3 ? 3 : 4; }

int num_sides(CellShape shape) { return num_corners(shape); }

int order(CellShape shape) { return shape == CellShape::tri6 || shape == CellShape::quad9 ? 2 : 1; }

CellShape linear_partner(CellShape shape) {
  return shape == CellShape::tri3 || shape == CellShape::tri6 ? CellShape::tri3 : CellShape::quad4;
}

const char* name(CellShape shape) {
  switch (shape) {
    case CellShape::tri3:
      return "tri3";
    case CellShape::tri6:
      return "tri6";
    case CellShape::quad4:
      return "quad4";
    case CellShape::quad9:
      return "quad9";
  }
  throw std::logic_error("unknown cell shape");
}

std::vector<int> side_nodes(CellShape shape, int side) {
  const int corners = num_corners(shape);
  if (side < 0 || side >= corners) throw std::out_of_range("a " + std::string(name(shape)) + " has no such side");
  std::vector<int> nodes{side, (side + 1) % corners};
  if (order(shape) == 2) nodes.push_back(corners + side);
  return nodes;
}

void evaluate_line(int nodes, double xi, double* N, double* dN) {
  if (nodes == 2) {
    N[0] = 0.5 * (1 - xi);
    N[1] = 0.5 * (1 + xi);
    dN[0] = -0.5;
    dN[1] = 0.5;
    return;
  }
  if (nodes != 3) throw std::invalid_argument("a line has 2 or 3 nodes");
  N[0] = 0.5 * xi * (xi - 1);
  N[1] = 0.5 * xi * (xi + 1);
  N[2] = (1 - xi) * (1 + xi);
  dN[0] = xi - 0.5;
  dN[1] = xi + 0.5;
  dN[2] = -2 * xi;
}

namespace {

void evaluate_tri3(const double xi[2], double* N, double* dN) {
  const double gradients[] = {-1, -1, 1, 0, 0, 1};
  N[0] = 1 - xi[0] - xi[1];
  N[1] = xi[0];
  N[2] = xi[1];
  std::copy(std::begin(gradients), std::end(gradients), dN);
}

void evaluate_tri6(const double xi[2], double* N, double* dN) {
  double L[3], dL[6];
  evaluate_tri3(xi, L, dL);
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    N[i] = L[i] * (2 * L[i] - 1);
    N[3 + i] = 4 * L[i] * L[j];
    for (int d = 0; d < 2; ++d) {
      dN[2 * i + d] = (4 * L[i] - 1) * dL[2 * i + d];
      dN[2 * (3 + i) + d] = 4 * (dL[2 * i + d] * L[j] + L[i] * dL[2 * j + d]);
    }
  }
}

/// Products of line shapes; `place` gives the two line nodes of each cell node.
void evaluate_product(int line, int nodes, const int (*place)[2], const double xi[2], double* N, double* dN) {
  double x[3], dx[3], y[3], dy[3];
  evaluate_line(line, xi[0], x, dx);
  evaluate_line(line, xi[1], y, dy);
  for (int a = 0; a < nodes; ++a) {
    const int i = place[a][0], j = place[a][1];
    N[a] = x[i] * y[j];
    dN[2 * a] = dx[i] * y[j];
    dN[2 * a + 1] = x[i] * dy[j];
  }
}

// Line nodes are numbered ends first, then the middle, so the corners of both shapes share their entries.
constexpr int quad_places[9][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {1, 2}, {2, 1}, {0, 2}, {2, 2}};

}  // namespace

void evaluate_shape(CellShape shape, const double xi[2], double* N, double* dN) {
  switch (shape) {
    case CellShape::tri3:
      return evaluate_tri3(xi, N, dN);
    case CellShape::tri6:
      return evaluate_tri6(xi, N, dN);
    case CellShape::quad4:
      return evaluate_product(2, 4, quad_places, xi, N, dN);
    case CellShape::quad9:
      return evaluate_product(3, 9, quad_places, xi, N, dN);
  }
}

namespace {
/// evaluate(q, N, dN): shapes at point q of the rule.
template <class Evaluate>
ShapeTable make_table(int nodes, int dim, const QuadratureRule& rule, Evaluate&& evaluate) {
  ShapeTable table;
  table.points = static_cast<int>(rule.points.size());
  table.nodes = nodes;
  table.weights = Kokkos::View<double*>("weights", table.points);
  table.N = Kokkos::View<double**, Kokkos::LayoutRight>("N", table.points, nodes);
  table.dN = Kokkos::View<double***, Kokkos::LayoutRight>("dN", table.points, nodes, dim);
  const auto weights = Kokkos::create_mirror_view(table.weights);
  const auto N = Kokkos::create_mirror_view(table.N);
  const auto dN = Kokkos::create_mirror_view(table.dN);
  for (int q = 0; q < table.points; ++q) {
    weights(q) = rule.weights[q];
    evaluate(q, &N(q, 0), &dN(q, 0, 0));
  }
  Kokkos::deep_copy(table.weights, weights);
  Kokkos::deep_copy(table.N, N);
  Kokkos::deep_copy(table.dN, dN);
  return table;
}
}  // namespace

ShapeTable tabulate(CellShape shape, const QuadratureRule& rule) {
  return make_table(num_nodes(shape), 2, rule,
                    [&](int q, double* N, double* dN) { evaluate_shape(shape, rule.points[q].data(), N, dN); });
}

ShapeTable tabulate_line(int nodes, const QuadratureRule& rule) {
  return make_table(nodes, 1, rule,
                    [&](int q, double* N, double* dN) { evaluate_line(nodes, rule.points[q][0], N, dN); });
}

}  // namespace mudline
