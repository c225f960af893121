#include <cmath>

#include "discretisation/cells/evaluate.hpp"

namespace mudline {

namespace {

const CellFrame& triangle_frame() {
  static const CellFrame triangle{
      2, 2, {{0, 0}, {1, 0}, {0, 1}}, {{{0, 1}}, {{1, 2}}, {{2, 0}}}, {{0, 1}, {1, 2}, {2, 0}}, 4 / std::sqrt(3.0), 2};
  return triangle;
}

}  // namespace

Cell tri3() {
  Cell cell = triangle_frame().linear("tri3", CellShape::tri3, {CellShape::line2}, evaluate_simplex<2>);
  cell.xdmf = 4;
  cell.vtk = 5;
  cell.msh_types = {2};
  return cell;
}

Cell tri6() {
  Cell cell = triangle_frame().quadratic("tri6", CellShape::tri3, {CellShape::line3}, false, evaluate_simplex<2>);
  cell.xdmf = 36;
  cell.vtk = 22;
  cell.msh_types = {9};
  return cell;
}

}  // namespace mudline
