#include "discretisation/cells/evaluate.hpp"

namespace mudline {

namespace {

const CellFrame& quadrilateral_frame() {
  static const CellFrame square{2,
                                0,
                                {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
                                {{{0, 1}}, {{1, 2}}, {{2, 3}}, {{3, 0}}},
                                {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
                                1,
                                1};
  return square;
}

/// Serendipity functions. A corner's is the bilinear one less half of those of its two mid-side nodes.
void evaluate_quad8(const Cell& own, const double* xi, double* N, double* dN) {
  for (int a = 0; a < 8; ++a) {
    const double s = own.nodes[a][0], t = own.nodes[a][1], along[2] = {1 + s * xi[0], 1 + t * xi[1]};
    if (a < 4) {
      N[a] = 0.25 * along[0] * along[1] * (s * xi[0] + t * xi[1] - 1);
      dN[2 * a] = 0.25 * s * along[1] * (2 * s * xi[0] + t * xi[1]);
      dN[2 * a + 1] = 0.25 * t * along[0] * (s * xi[0] + 2 * t * xi[1]);
      continue;
    }
    const int bubble = s == 0 ? 0 : 1, other = 1 - bubble;  // the coordinate along the node's side, and across
    const double sign = own.nodes[a][other];
    N[a] = 0.5 * (1 - xi[bubble] * xi[bubble]) * along[other];
    dN[2 * a + bubble] = -xi[bubble] * along[other];
    dN[2 * a + other] = 0.5 * (1 - xi[bubble] * xi[bubble]) * sign;
  }
}

}  // namespace

Cell quad4() {
  Cell cell = quadrilateral_frame().linear("quad4", CellShape::quad4, {CellShape::line2}, evaluate_grid<2>);
  cell.xdmf = 5;
  cell.vtk = 9;
  cell.msh_types = {3};
  return cell;
}

// A side only: as a cell of the plane it gets its centre.
Cell quad8() {
  return quadrilateral_frame().quadratic("quad8", CellShape::quad4, {CellShape::line3}, false, evaluate_quad8);
}

Cell quad9() {
  Cell cell = quadrilateral_frame().quadratic("quad9", CellShape::quad4, {CellShape::line3}, true, evaluate_grid<2>);
  cell.xdmf = 35;
  cell.vtk = 28;
  cell.msh_types = {10, 16};
  return cell;
}

}  // namespace mudline
