#include "discretisation/shapes.hpp"

#include <algorithm>
#include <stdexcept>

#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// The corners of a linear cell, and how they join. Corners of a side go round as side_nodes says.
struct Frame {
  int dimension, corners, edges, sides, side_corners;
  double corner[8][3];
  int edge[12][2];
  int side[6][4];
};

constexpr Frame line{1, 2, 1, 0, 0, {{-1}, {1}}, {{0, 1}}, {}};
constexpr Frame triangle{2, 3, 3, 3, 2, {{0, 0}, {1, 0}, {0, 1}}, {{0, 1}, {1, 2}, {2, 0}}, {{0, 1}, {1, 2}, {2, 0}}};
constexpr Frame square{2,
                       4,
                       4,
                       4,
                       2,
                       {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
                       {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
                       {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
constexpr Frame tetrahedron{3,
                            4,
                            6,
                            4,
                            3,
                            {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                            {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
                            {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}}};
constexpr Frame cube{
    3,
    8,
    12,
    6,
    4,
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
    {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}}};

struct Cell {
  const char* name;
  const Frame* frame;
  int order, nodes;
  CellShape linear, side;
};

/// Line cells have no sides: their entry is their own shape.
constexpr Cell cells[] = {{"line2", &line, 1, 2, CellShape::line2, CellShape::line2},
                          {"line3", &line, 2, 3, CellShape::line2, CellShape::line3},
                          {"tri3", &triangle, 1, 3, CellShape::tri3, CellShape::line2},
                          {"tri6", &triangle, 2, 6, CellShape::tri3, CellShape::line3},
                          {"quad4", &square, 1, 4, CellShape::quad4, CellShape::line2},
                          {"quad9", &square, 2, 9, CellShape::quad4, CellShape::line3},
                          {"tet4", &tetrahedron, 1, 4, CellShape::tet4, CellShape::tri3},
                          {"tet10", &tetrahedron, 2, 10, CellShape::tet4, CellShape::tri6},
                          {"hex8", &cube, 1, 8, CellShape::hex8, CellShape::quad4},
                          {"hex27", &cube, 2, 27, CellShape::hex8, CellShape::quad9}};

const Cell& cell(CellShape shape) { return cells[static_cast<int>(shape)]; }
const Frame& frame(CellShape shape) { return *cell(shape).frame; }

}  // namespace

int num_nodes(CellShape shape) { return cell(shape).nodes; }
int num_corners(CellShape shape) { return frame(shape).corners; }
int num_sides(CellShape shape) { return frame(shape).sides; }
int num_edges(CellShape shape) { return frame(shape).edges; }
int dimension(CellShape shape) { return frame(shape).dimension; }
int order(CellShape shape) { return cell(shape).order; }
bool is_simplex(CellShape shape) { return num_corners(shape) == dimension(shape) + 1 && dimension(shape) > 1; }
CellShape linear_partner(CellShape shape) { return cell(shape).linear; }
CellShape side_shape(CellShape shape) { return cell(shape).side; }
const char* name(CellShape shape) { return cell(shape).name; }
std::array<int, 2> edge_corners(CellShape shape, int edge) {
  return {frame(shape).edge[edge][0], frame(shape).edge[edge][1]};
}

std::vector<int> side_nodes(CellShape shape, int side) {
  const Frame& f = frame(shape);
  if (side < 0 || side >= f.sides) throw std::out_of_range("a " + std::string(name(shape)) + " has no such side");
  std::vector<int> nodes(f.side[side], f.side[side] + f.side_corners);
  if (order(shape) == 1) return nodes;
  for (int c = 0; c < (f.side_corners == 2 ? 1 : f.side_corners); ++c) {
    const int a = nodes[c], b = nodes[(c + 1) % f.side_corners];
    const auto joins = [&](const int(&e)[2]) { return (e[0] == a && e[1] == b) || (e[0] == b && e[1] == a); };
    nodes.push_back(f.corners + static_cast<int>(std::find_if(f.edge, f.edge + f.edges, joins) - f.edge));
  }
  if (f.side_corners == 4) nodes.push_back(f.corners + f.edges + side);
  return nodes;
}

std::vector<int> corners_around(CellShape shape, int node) {
  const Frame& f = frame(shape);
  std::vector<int> around;
  const int middles = f.corners + f.edges, faces = f.dimension == 3 ? middles + f.sides : middles;
  if (node < f.corners)
    around = {node};
  else if (node < middles)
    around.assign(f.edge[node - f.corners], f.edge[node - f.corners] + 2);
  else if (node < faces)
    around.assign(f.side[node - middles], f.side[node - middles] + f.side_corners);
  else
    for (int c = 0; c < f.corners; ++c) around.push_back(c);
  return around;
}

Vec<double, 3> reference_node(CellShape shape, int node) {
  const Frame& f = frame(shape);
  const std::vector<int> around = corners_around(shape, node);
  Vec<double, 3> place{};
  for (const int c : around)
    for (int i = 0; i < 3; ++i) place[i] += f.corner[c][i] / static_cast<double>(around.size());
  return place;
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

/// Triangle or tetrahedron: its corners' coordinates L, or the products of two of them.
template <int Dim>
void evaluate_simplex(const Frame& f, int order, const double* xi, double* N, double* dN) {
  double L[Dim + 1], dL[Dim + 1][Dim];
  L[0] = 1;
  for (int d = 0; d < Dim; ++d) L[0] -= xi[d];
  for (int i = 1; i <= Dim; ++i) L[i] = xi[i - 1];
  for (int i = 0; i <= Dim; ++i)
    for (int d = 0; d < Dim; ++d) dL[i][d] = i == 0 ? -1 : (i == d + 1 ? 1 : 0);
  for (int i = 0; i <= Dim; ++i) {
    N[i] = order == 1 ? L[i] : L[i] * (2 * L[i] - 1);
    for (int d = 0; d < Dim; ++d) dN[Dim * i + d] = order == 1 ? dL[i][d] : (4 * L[i] - 1) * dL[i][d];
  }
  if (order == 1) return;
  for (int e = 0; e < f.edges; ++e) {
    const int i = f.edge[e][0], j = f.edge[e][1], a = f.corners + e;
    N[a] = 4 * L[i] * L[j];
    for (int d = 0; d < Dim; ++d) dN[Dim * a + d] = 4 * (dL[i][d] * L[j] + L[i] * dL[j][d]);
  }
}

/// Products of line shapes; `place` gives the line nodes of each cell node.
template <int Dim, int Nodes>
void evaluate_product(int line_nodes, const int (&place)[Nodes][Dim], const double* xi, double* N, double* dN) {
  double value[Dim][3], slope[Dim][3];
  for (int d = 0; d < Dim; ++d) evaluate_line(line_nodes, xi[d], value[d], slope[d]);
  for (int a = 0; a < Nodes; ++a) {
    N[a] = 1;
    for (int d = 0; d < Dim; ++d) N[a] *= value[d][place[a][d]];
    for (int k = 0; k < Dim; ++k) {
      dN[Dim * a + k] = 1;
      for (int d = 0; d < Dim; ++d) dN[Dim * a + k] *= (d == k ? slope : value)[d][place[a][d]];
    }
  }
}

/// Line nodes (low end, high end, middle) of the nodes of a cell.
template <int Dim, int Nodes>
struct Places {
  int of[Nodes][Dim];
  explicit Places(CellShape shape) {
    for (int a = 0; a < Nodes; ++a)
      for (int d = 0; d < Dim; ++d) {
        const double xi = reference_node(shape, a)[d];
        of[a][d] = xi < 0 ? 0 : (xi > 0 ? 1 : 2);
      }
  }
};

}  // namespace

void evaluate_shape(CellShape shape, const double* xi, double* N, double* dN) {
  static const Places<2, 4> quad4(CellShape::quad4);
  static const Places<2, 9> quad9(CellShape::quad9);
  static const Places<3, 8> hex8(CellShape::hex8);
  static const Places<3, 27> hex27(CellShape::hex27);
  switch (shape) {
    case CellShape::line2:
    case CellShape::line3:
      return evaluate_line(num_nodes(shape), xi[0], N, dN);
    case CellShape::tri3:
    case CellShape::tri6:
      return evaluate_simplex<2>(triangle, order(shape), xi, N, dN);
    case CellShape::tet4:
    case CellShape::tet10:
      return evaluate_simplex<3>(tetrahedron, order(shape), xi, N, dN);
    case CellShape::quad4:
      return evaluate_product(2, quad4.of, xi, N, dN);
    case CellShape::quad9:
      return evaluate_product(3, quad9.of, xi, N, dN);
    case CellShape::hex8:
      return evaluate_product(2, hex8.of, xi, N, dN);
    case CellShape::hex27:
      return evaluate_product(3, hex27.of, xi, N, dN);
  }
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
