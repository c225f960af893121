#include <cmath>

#include "discretisation/cells/evaluate.hpp"

namespace mudline {

namespace {

/// A triangle in the first two coordinates, [-1, 1] in the third; three quadrilaterals, then the two triangles.
const CellFrame& wedge_frame() {
  static const CellFrame prism{
      3,
      2,
      {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
      {{{0, 1}}, {{1, 2}}, {{2, 0}}, {{3, 4}}, {{4, 5}}, {{5, 3}}, {{0, 3}}, {{1, 4}}, {{2, 5}}},
      {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}, {0, 2, 1}, {3, 4, 5}},
      4 / std::sqrt(3.0),
      2};
  return prism;
}

std::vector<CellShape> sides(CellShape quadrilateral, CellShape triangle) {
  return {quadrilateral, quadrilateral, quadrilateral, triangle, triangle};
}

const std::vector<std::vector<int>>& msh_around() {
  static const std::vector<std::vector<int>> all{{0, 1}, {0, 2}, {0, 3}, {1, 2},       {1, 4},       {2, 5},
                                                 {3, 4}, {3, 5}, {4, 5}, {0, 1, 3, 4}, {0, 2, 3, 5}, {1, 2, 4, 5}};
  return all;
}

/// Products of the functions of the triangle and of the line.
void evaluate_product(const Cell& own, const double* xi, double* N, double* dN) {
  const Cell& triangle = cell(own.order == 1 ? CellShape::tri3 : CellShape::tri6);
  double value[6], slope[12], line[3], line_slope[3];
  triangle.evaluate(triangle, xi, value, slope);
  evaluate_line(own.order + 1, xi[2], line, line_slope);
  for (std::size_t a = 0; a < own.nodes.size(); ++a) {
    // the triangle's corner below, or its mid-side node: its edges come in the order of the wedge's lower ones
    int in_plane = static_cast<int>(a) % 3;
    const bool upright = a >= 12 && a < 15;
    if (a >= 6 && !upright) in_plane += 3;
    const int at = own.grid[a][2];
    N[a] = value[in_plane] * line[at];
    for (int k = 0; k < 2; ++k) dN[3 * a + k] = slope[2 * in_plane + k] * line[at];
    dN[3 * a + 2] = value[in_plane] * line_slope[at];
  }
}

/// Serendipity functions: no nodes in the middle of the quadrilaterals. L: area coordinates of the triangle.
void evaluate_wedge15(const Cell& own, const double* xi, double* N, double* dN) {
  const double L[3] = {1 - xi[0] - xi[1], xi[0], xi[1]}, z = xi[2], bubble = 1 - z * z;
  static constexpr double dL[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
  for (int a = 0; a < 6; ++a) {  // corners
    const int i = a % 3;
    const double up = a < 3 ? -1 : 1, share = 1 + up * z;
    N[a] = 0.5 * L[i] * ((2 * L[i] - 1) * share - bubble);
    for (int k = 0; k < 2; ++k) dN[3 * a + k] = 0.5 * dL[i][k] * ((4 * L[i] - 1) * share - bubble);
    dN[3 * a + 2] = 0.5 * L[i] * ((2 * L[i] - 1) * up + 2 * z);
  }
  for (int a = 6; a < 12; ++a) {  // in the middle of the triangles' edges
    const int i = own.edges[a - 6][0] % 3, j = own.edges[a - 6][1] % 3;
    const double up = a < 9 ? -1 : 1, share = 1 + up * z;
    N[a] = 2 * L[i] * L[j] * share;
    for (int k = 0; k < 2; ++k) dN[3 * a + k] = 2 * (dL[i][k] * L[j] + L[i] * dL[j][k]) * share;
    dN[3 * a + 2] = 2 * L[i] * L[j] * up;
  }
  for (int a = 12; a < 15; ++a) {  // in the middle of the upright edges
    const int i = a - 12;
    N[a] = L[i] * bubble;
    for (int k = 0; k < 2; ++k) dN[3 * a + k] = dL[i][k] * bubble;
    dN[3 * a + 2] = -2 * L[i] * z;
  }
}

}  // namespace

Cell wedge6() {
  Cell cell =
      wedge_frame().linear("wedge6", CellShape::wedge6, sides(CellShape::quad4, CellShape::tri3), evaluate_product);
  cell.xdmf = 8;
  cell.vtk = 13;
  cell.msh_types = {6};
  return cell;
}

Cell wedge15() {
  Cell cell = wedge_frame().quadratic("wedge15", CellShape::wedge6, sides(CellShape::quad8, CellShape::tri6), false,
                                      evaluate_wedge15);
  cell.xdmf = 40;
  cell.vtk = 26;
  cell.msh_types = {18};
  cell.msh_around = msh_around();
  return cell;
}

Cell wedge18() {
  Cell cell = wedge_frame().quadratic("wedge18", CellShape::wedge6, sides(CellShape::quad9, CellShape::tri6), false,
                                      evaluate_product);
  cell.xdmf = 41;
  cell.vtk = 32;
  cell.msh_types = {13};
  cell.msh_around = msh_around();
  return cell;
}

}  // namespace mudline
