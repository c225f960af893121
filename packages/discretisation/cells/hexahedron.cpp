#include "discretisation/cells/evaluate.hpp"

namespace mudline {

namespace {

const CellFrame& hexahedron_frame() {
  static const CellFrame cube{
      3,
      0,
      {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
      {{{0, 1}},
       {{1, 2}},
       {{2, 3}},
       {{3, 0}},
       {{4, 5}},
       {{5, 6}},
       {{6, 7}},
       {{7, 4}},
       {{0, 4}},
       {{1, 5}},
       {{2, 6}},
       {{3, 7}}},
      {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}},
      1,
      1};
  return cube;
}

}  // namespace

Cell hex8() {
  Cell cell = hexahedron_frame().linear("hex8", CellShape::hex8, {CellShape::quad4}, evaluate_grid<3>);
  cell.xdmf = 9;
  cell.vtk = 12;
  cell.msh_types = {5};
  return cell;
}

Cell hex27() {
  Cell cell = hexahedron_frame().quadratic("hex27", CellShape::hex8, {CellShape::quad9}, true, evaluate_grid<3>);
  cell.xdmf = 50;
  cell.vtk = 29;
  cell.msh_types = {12, 17};
  cell.msh_around = {{0, 1},
                     {0, 3},
                     {0, 4},
                     {1, 2},
                     {1, 5},
                     {2, 3},
                     {2, 6},
                     {3, 7},
                     {4, 5},
                     {4, 7},
                     {5, 6},
                     {6, 7},
                     {0, 1, 2, 3},
                     {0, 1, 4, 5},
                     {0, 3, 4, 7},
                     {1, 2, 5, 6},
                     {2, 3, 6, 7},
                     {4, 5, 6, 7},
                     {0, 1, 2, 3, 4, 5, 6, 7}};
  return cell;
}

}  // namespace mudline
