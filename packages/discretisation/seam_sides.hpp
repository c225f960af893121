#pragma once

#include <set>
#include <string>
#include <vector>

#include "discretisation/mesh_topology.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// Sides that lie nearer to each other than this share of the smaller of their elements (the side, or the depth behind
/// it) form a seam; what lies over another element by more than this share of its own depth overlaps it.
constexpr double seam_closeness = 0.02;

/// A side on the boundary of a whole mesh, as check_seams() looks at it.
struct SeamSide {
  ElementSide at;
  int corners = 2;
  std::vector<Point> points;               // in the plane along it, evenly in the parameter; in space a grid on it
  std::vector<std::array<int, 3>> pieces;  // straight pieces between two of the points, or flat ones between three
  std::set<std::string> sets;              // those that name it
  Point normal{};                          // outward, as long as `measure`
  double measure = 0;                      // of it were it straight: its length [m] or area [m2]
  double edge = 0;                         // its shortest edge; in the plane its length [m]
  double size = 0;                         // that, or the depth of its element behind it where it is less [m]
};

/// The boundary sides of a mesh.
std::vector<SeamSide> seam_sides(const GlobalMesh& mesh);

/// Places on a side by the coordinates of its own shape: all over it, or a few.
std::vector<Vec<double, 2>> side_samples(CellShape side, bool few);

/// Distance [m] of a point from a side's pieces.
double distance_to(const SeamSide& side, const Point& point);
/// Distance [m] from a straight piece.
double distance_to_piece(const Point& point, const Point& a, const Point& b);

/// Throws InputError for a void in the mesh whose boundary no side set names.
void check_holes(const GlobalMesh& mesh, const std::vector<SeamSide>& sides);

}  // namespace mudline
