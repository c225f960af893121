#pragma once

#include <array>
#include <vector>

#include "discretisation/shapes.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// Everything that the program knows of one shape of cells. A new shape is a value of CellShape, a function that
/// returns this table (one file of this folder), its line in shapes.cpp and, where laws are computed on it, its numbers
/// of nodes in compiled_shapes.hpp.
struct Cell {
  struct Side {
    CellShape shape;
    std::vector<int> nodes;  // local, in the order of the side's own shape; see side_nodes()
  };
  using Evaluate = void (*)(const Cell& own, const double* xi, double* N, double* dN);  // see evaluate_shape()

  const char* name;
  int dimension, order, corners;
  int simplex;       // number of leading reference coordinates that are area or volume coordinates: 0, 2 or 3
  CellShape linear;  // shape on the same corners
  std::vector<Vec<double, 3>> nodes;     // reference coordinates
  std::vector<std::vector<int>> around;  // (node) the corners of which it is the centre
  std::vector<std::array<int, 3>> grid;  // (node) where coordinates are in [-1, 1]: node of a line, as evaluate_line()
  std::vector<std::array<int, 2>> edges;
  std::vector<Side> sides;
  double equilateral;  // length^dimension over the content of a cell all of whose edges have that length
  double per_box;      // number of such cells that fill a parallelogram or a parallelepiped
  Evaluate evaluate;
  int xdmf = 0;                              // number in XDMF's mixed topology; 0: no cell of a mesh
  int vtk = 0;                               // number in VTK, whose order of nodes it has; 0: no cell of a mesh
  std::vector<int> msh_types;                // Gmsh's element types that become this shape
  std::vector<std::vector<int>> msh_around;  // corners around each higher node in Gmsh's order; empty: the same order
};

/// What cells of both orders on the same corners have in common.
struct CellFrame {
  int dimension, simplex;
  std::vector<Vec<double, 3>> corners;  // reference coordinates; unused ones are 0
  std::vector<std::array<int, 2>> edges;
  std::vector<std::vector<int>> sides;  // corners of each side
  double equilateral, per_box;          // as in Cell

  /// The linear cell. `side_shapes`: one shape for all sides, or one for each.
  Cell linear(const char* name, CellShape own, const std::vector<CellShape>& side_shapes, Cell::Evaluate) const;
  /// The quadratic cell: corners, mid-side nodes, centres of those sides whose shape has a centre and, where `centre`,
  /// that of the cell.
  Cell quadratic(const char* name, CellShape linear_shape, const std::vector<CellShape>& side_shapes, bool centre,
                 Cell::Evaluate) const;

 private:
  Cell cell(const char* name, CellShape linear_shape, const std::vector<CellShape>& side_shapes,
            std::vector<std::vector<int>> around, Cell::Evaluate) const;
};

/// The table of a shape.
const Cell& cell(CellShape shape);

Cell line2();
Cell line3();
Cell tri3();
Cell tri6();
Cell quad4();
Cell quad8();
Cell quad9();
Cell tet4();
Cell tet10();
Cell hex8();
Cell hex27();
Cell wedge6();
Cell wedge15();
Cell wedge18();

}  // namespace mudline
