#include "discretisation/shapes.hpp"

#include <stdexcept>

#include "discretisation/cells/cell.hpp"

namespace mudline {

const Cell& cell(CellShape shape) {
  static const std::array<Cell, num_shapes> cells{line2(), line3(), tri3(),  tri6(),  quad4(),  quad9(),   tet4(),
                                                  tet10(), hex8(),  hex27(), quad8(), wedge6(), wedge15(), wedge18()};
  return cells[static_cast<int>(shape)];
}

int num_nodes(CellShape shape) { return static_cast<int>(cell(shape).nodes.size()); }
int num_corners(CellShape shape) { return cell(shape).corners; }
int num_sides(CellShape shape) { return static_cast<int>(cell(shape).sides.size()); }
int num_edges(CellShape shape) { return static_cast<int>(cell(shape).edges.size()); }
int dimension(CellShape shape) { return cell(shape).dimension; }
int order(CellShape shape) { return cell(shape).order; }
int simplex_coordinates(CellShape shape) { return cell(shape).simplex; }
bool is_simplex(CellShape shape) { return cell(shape).simplex == cell(shape).dimension; }
double equilateral(CellShape shape) { return cell(shape).equilateral; }
double per_box(CellShape shape) { return cell(shape).per_box; }
double reference_size(CellShape shape) {
  return (1 << (cell(shape).dimension - cell(shape).simplex)) / cell(shape).per_box;
}
CellShape linear_partner(CellShape shape) { return cell(shape).linear; }
const char* name(CellShape shape) { return cell(shape).name; }
const std::array<int, 2>& edge_corners(CellShape shape, int edge) { return cell(shape).edges[edge]; }
const std::vector<int>& corners_around(CellShape shape, int node) { return cell(shape).around[node]; }
const Vec<double, 3>& reference_node(CellShape shape, int node) { return cell(shape).nodes[node]; }

namespace {

const Cell::Side& side_of(CellShape shape, int side) {
  if (side < 0 || side >= num_sides(shape))
    throw std::out_of_range("a " + std::string(name(shape)) + " has no such side");
  return cell(shape).sides[side];
}

}  // namespace

CellShape side_shape(CellShape shape, int side) { return side_of(shape, side).shape; }
const std::vector<int>& side_nodes(CellShape shape, int side) { return side_of(shape, side).nodes; }

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

void evaluate_shape(CellShape shape, const double* xi, double* N, double* dN) {
  const Cell& own = cell(shape);
  own.evaluate(own, xi, N, dN);
}

ShapeTable tabulate(CellShape shape, const QuadratureRule& rule) {
  const int nodes = num_nodes(shape);
  ShapeTable table;
  table.points = static_cast<int>(rule.points.size());
  table.nodes = nodes;
  table.weights = Kokkos::View<double*>("weights", table.points);
  table.N = Kokkos::View<double**, Kokkos::LayoutRight>("N", table.points, nodes);
  table.dN = Kokkos::View<double***, Kokkos::LayoutRight>("dN", table.points, nodes, dimension(shape));
  const auto weights = Kokkos::create_mirror_view(table.weights);
  const auto N = Kokkos::create_mirror_view(table.N);
  const auto dN = Kokkos::create_mirror_view(table.dN);
  for (int q = 0; q < table.points; ++q) {
    weights(q) = rule.weights[q];
    evaluate_shape(shape, rule.points[q].data(), &N(q, 0), &dN(q, 0, 0));
  }
  Kokkos::deep_copy(table.weights, weights);
  Kokkos::deep_copy(table.N, N);
  Kokkos::deep_copy(table.dN, dN);
  return table;
}

}  // namespace mudline
