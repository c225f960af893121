#pragma once

#include <Kokkos_Core.hpp>

#include <array>
#include <string>
#include <vector>

namespace mudline {

/// Node order: corners counter-clockwise, then edge middles (edge i joins corner i and i+1), then the centre of quad9.
/// The same order as Gmsh and XDMF.
enum class CellShape { tri3, tri6, quad4, quad9 };

int num_nodes(CellShape shape);
int num_corners(CellShape shape);
int num_sides(CellShape shape);  // = corners
/// Polynomial order, 1 or 2.
int order(CellShape shape);
/// The linear shape on the same corners: the pressure partner of the Taylor-Hood pair.
CellShape linear_partner(CellShape shape);
const char* name(CellShape shape);
/// Local node numbers of a side: two corners, then the middle if the shape is quadratic. Counter-clockwise: the outward
/// normal is to the right of the direction corner 0 -> corner 1.
std::vector<int> side_nodes(CellShape shape, int side);

/// Shape functions and reference gradients at one reference point. Triangles: area coordinates xi, eta in the unit
/// triangle; quadrilaterals: [-1, 1]^2. N: (nodes), dN: (nodes, 2).
void evaluate_shape(CellShape shape, const double xi[2], double* N, double* dN);
/// Line shapes on [-1, 1]: 2 nodes, or 3 (ends, middle). N, dN: (nodes).
void evaluate_line(int nodes, double xi, double* N, double* dN);

struct QuadratureRule {
  std::vector<std::array<double, 2>> points;  // reference coordinates (a line uses the first)
  std::vector<double> weights;                // sum = reference area (0.5 triangle, 4 square, 2 line)
};
/// Exact for polynomials of this total degree (triangles, degrees 1-8) or degree per direction (quadrilaterals).
/// Throws std::invalid_argument beyond.
QuadratureRule cell_quadrature(CellShape shape, int degree);
/// Gauss-Legendre on [-1, 1], exact to this degree (1-11).
QuadratureRule line_quadrature(int degree);

/// Shape functions tabulated at quadrature points, for kernels.
struct ShapeTable {
  int points = 0, nodes = 0;
  Kokkos::View<double*> weights;                    // (point)
  Kokkos::View<double**, Kokkos::LayoutRight> N;    // (point, node)
  Kokkos::View<double***, Kokkos::LayoutRight> dN;  // (point, node, 2; of a line 1)
};
ShapeTable tabulate(CellShape shape, const QuadratureRule& rule);
/// Of a line of 2 or 3 nodes.
ShapeTable tabulate_line(int nodes, const QuadratureRule& rule);

}  // namespace mudline
