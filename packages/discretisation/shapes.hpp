#pragma once

#include <Kokkos_Core.hpp>

#include <array>
#include <string>
#include <vector>

#include "tensor/vec.hpp"

namespace mudline {

/// Node order: corners, then edge middles, then face centres (hex27), then the cell's centre (quad9, hex27); in two
/// dimensions corners go round counter-clockwise. The order of VTK and XDMF, in the plane also that of Gmsh.
enum class CellShape { line2, line3, tri3, tri6, quad4, quad9, tet4, tet10, hex8, hex27 };

int num_nodes(CellShape shape);
int num_corners(CellShape shape);
int num_sides(CellShape shape);  // of a cell in the plane or in space; all have the same shape
/// Of the reference cell: 1 line, 2 plane, 3 space.
int dimension(CellShape shape);
/// Polynomial order, 1 or 2.
int order(CellShape shape);
/// Whether it is a triangle or a tetrahedron.
bool is_simplex(CellShape shape);
/// The linear shape on the same corners: the pressure partner of the Taylor-Hood pair.
CellShape linear_partner(CellShape shape);
/// Shape of all sides of a cell in the plane or in space.
CellShape side_shape(CellShape shape);
const char* name(CellShape shape);
/// Local node numbers of a side, in the order of its own shape. The outward normal is to the right of the direction
/// corner 0 -> corner 1 in the plane; in space the corners go round counter-clockwise as seen from outside.
std::vector<int> side_nodes(CellShape shape, int side);
/// The two corners of an edge; edges in the order of their middles.
std::array<int, 2> edge_corners(CellShape shape, int edge);
int num_edges(CellShape shape);
/// The corners in whose middle a node is: itself, the ends of an edge, the corners of a face or of the whole cell.
std::vector<int> corners_around(CellShape shape, int node);
/// Reference coordinates of a node; those that the cell has not are 0.
Vec<double, 3> reference_node(CellShape shape, int node);

/// Shape functions and reference gradients at one reference point. Triangles and tetrahedra: area or volume coordinates
/// xi, eta, zeta in the unit simplex; the others: [-1, 1] in each direction. N: (nodes), dN: (nodes, dimension).
void evaluate_shape(CellShape shape, const double* xi, double* N, double* dN);
/// Line shapes on [-1, 1]: 2 nodes, or 3 (ends, middle). N, dN: (nodes).
void evaluate_line(int nodes, double xi, double* N, double* dN);

struct QuadratureRule {
  std::vector<Vec<double, 3>> points;  // reference coordinates; those that the cell has not are 0
  std::vector<double> weights;         // sum = size of the reference cell
};
/// Exact for polynomials of this total degree (triangles 1-8, tetrahedra 1-6) or degree per direction (the others,
/// 1-11). Throws std::invalid_argument beyond.
QuadratureRule cell_quadrature(CellShape shape, int degree);
/// Gauss-Legendre on [-1, 1], exact to this degree (1-11).
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
