#pragma once

#include <set>
#include <string>
#include <vector>

#include "discretisation/mesh_topology.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// Relative tolerance of seams. Two sides form a seam where they are nearer to each other than this fraction of the
/// smaller SeamSide::size; an element overlaps another one where more than this fraction of its own depth lies in it.
constexpr double seam_closeness = 0.02;

/// A side on the boundary of a whole mesh, as check_seams() looks at it.
struct SeamSide {
  ElementSide at;
  int corners = 2;
  std::vector<Point> points;               // sample points [m], even in the parameter; in space a grid
  std::vector<std::array<int, 3>> pieces;  // segments between two of the points, or triangles between three
  std::set<std::string> sets;              // side sets that contain it
  Point normal{};                          // outward normal of length `measure`
  double measure = 0;                      // its length [m] or area [m2] were it straight
  double edge = 0;                         // its shortest edge [m]; in the plane its length
  double size = 0;                         // the smaller of `edge` and the depth of its element [m]
};

/// The boundary sides of a mesh.
std::vector<SeamSide> seam_sides(const GlobalMesh& mesh);

/// Sample points on a side in reference coordinates of its own shape: all of them, or a few.
std::vector<Vec<double, 2>> side_samples(CellShape side, bool few);

/// Distance [m] of a point from a side's pieces.
double distance_to(const SeamSide& side, const Point& point);
/// Distance [m] from a straight piece.
double distance_to_piece(const Point& point, const Point& a, const Point& b);

/// Throws InputError for a void in the mesh whose boundary no side set names.
void check_holes(const GlobalMesh& mesh, const std::vector<SeamSide>& sides);

}  // namespace mudline
