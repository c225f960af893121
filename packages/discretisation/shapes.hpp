#pragma once

#include <Kokkos_Core.hpp>

#include <array>
#include <string>
#include <vector>

#include "tensor/vec.hpp"

namespace mudline {

/// Node order: corners, then edge mid-side nodes, then face centres (hex27, wedge18), then the cell's centre (quad9,
/// hex27); in two dimensions corners go round counter-clockwise. The order of VTK and XDMF, in the plane also that of
/// Gmsh. A quad8 is a side of a wedge15 only. Files of the folder `cells` describe the shapes.
enum class CellShape {
  line2,
  line3,
  tri3,
  tri6,
  quad4,
  quad9,
  tet4,
  tet10,
  hex8,
  hex27,
  quad8,
  wedge6,
  wedge15,
  wedge18
};
constexpr int num_shapes = static_cast<int>(CellShape::wedge18) + 1;

int num_nodes(CellShape shape);
int num_corners(CellShape shape);
int num_sides(CellShape shape);  // sides of a cell in the plane or in space
/// Dimension of the reference cell: 1 line, 2 plane, 3 space.
int dimension(CellShape shape);
/// Polynomial order, 1 or 2.
int order(CellShape shape);
/// Number of leading reference coordinates that are area or volume coordinates: 2 in a triangle and a wedge, 3 in a
/// tetrahedron, else 0. The others are in [-1, 1].
int simplex_coordinates(CellShape shape);
/// Whether it is a triangle or a tetrahedron.
bool is_simplex(CellShape shape);
/// Length^dimension over the content of the cell all of whose edges have that length: 1 for squares and cubes.
double equilateral(CellShape shape);
/// Length, area or volume of the reference cell.
double reference_size(CellShape shape);
/// Number of cells that fill a parallelogram or a parallelepiped: 2 triangles or wedges, 6 tetrahedra.
double per_box(CellShape shape);
/// The linear shape on the same corners: the pressure partner of the Taylor-Hood pair.
CellShape linear_partner(CellShape shape);
/// Shape of a side of a cell in the plane or in space. std::out_of_range where there is no such side.
CellShape side_shape(CellShape shape, int side);
const char* name(CellShape shape);
/// Local node numbers of a side, in the order of its own shape. The outward normal is to the right of the direction
/// corner 0 -> corner 1 in the plane; in space the corners go round counter-clockwise as seen from outside.
const std::vector<int>& side_nodes(CellShape shape, int side);
/// The two corners of an edge; edges in the order of their mid-side nodes.
const std::array<int, 2>& edge_corners(CellShape shape, int edge);
int num_edges(CellShape shape);
/// The corners whose mean is the node's position: itself, the ends of an edge, the corners of a face or of the whole
/// cell.
const std::vector<int>& corners_around(CellShape shape, int node);
/// Reference coordinates of a node; unused ones are 0.
const Vec<double, 3>& reference_node(CellShape shape, int node);

/// Shape functions and reference gradients at one reference point. Triangles and tetrahedra: area or volume coordinates
/// xi, eta, zeta in the unit simplex; wedges: area coordinates xi, eta, and zeta in [-1, 1]; the others: [-1, 1] in
/// each direction. N: (nodes), dN: (nodes, dimension).
void evaluate_shape(CellShape shape, const double* xi, double* N, double* dN);
/// Line shapes on [-1, 1]: 2 nodes, or 3 (ends, middle). N, dN: (nodes).
void evaluate_line(int nodes, double xi, double* N, double* dN);

struct QuadratureRule {
  std::vector<Vec<double, 3>> points;  // reference coordinates; unused ones are 0
  std::vector<double> weights;         // sum = size of the reference cell
};
/// Quadrature rule that is exact for polynomials of this total degree (triangles 1-8, tetrahedra 1-6) or degree per
/// direction (the others, 1-11); in a wedge the product of that of a triangle and that of a line. Throws
/// std::invalid_argument beyond.
QuadratureRule cell_quadrature(CellShape shape, int degree);
/// Gauss-Legendre rule on [-1, 1], exact to this degree (1-11).
QuadratureRule line_quadrature(int degree);

/// Shape functions tabulated at quadrature points, for kernels.
struct ShapeTable {
  int points = 0, nodes = 0;
  Kokkos::View<double*> weights;                    // (point)
  Kokkos::View<double**, Kokkos::LayoutRight> N;    // (point, node)
  Kokkos::View<double***, Kokkos::LayoutRight> dN;  // (point, node, dimension of the cell)
};
ShapeTable tabulate(CellShape shape, const QuadratureRule& rule);

}  // namespace mudline
