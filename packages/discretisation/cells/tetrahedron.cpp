#include <cmath>

#include "discretisation/cells/evaluate.hpp"

namespace mudline {

namespace {

const CellFrame& tetrahedron_frame() {
  static const CellFrame tetrahedron{3,
                                     3,
                                     {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                     {{{0, 1}}, {{1, 2}}, {{2, 0}}, {{0, 3}}, {{1, 3}}, {{2, 3}}},
                                     {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 2, 1}},
                                     6 * std::sqrt(2.0),
                                     6};
  return tetrahedron;
}

}  // namespace

Cell tet4() {
  Cell cell = tetrahedron_frame().linear("tet4", CellShape::tet4, {CellShape::tri3}, evaluate_simplex<3>);
  cell.xdmf = 6;
  cell.vtk = 10;
  cell.msh_types = {4};
  return cell;
}

Cell tet10() {
  Cell cell = tetrahedron_frame().quadratic("tet10", CellShape::tet4, {CellShape::tri6}, false, evaluate_simplex<3>);
  cell.xdmf = 38;
  cell.vtk = 24;
  cell.msh_types = {11};
  cell.msh_around = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}};
  return cell;
}

}  // namespace mudline
