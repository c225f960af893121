#pragma once

#include <array>
#include <functional>
#include <stdexcept>
#include <vector>

#include "core/function.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// A region of the plane inside closed chains of sides, given by the numbers of their vertices: the outer one
/// counter-clockwise, those of holes clockwise.
struct OutlinedRegion {
  std::vector<std::vector<int>> loops;
};

struct Triangulation {
  std::vector<Vec<double, 2>> points;                      // [m] the given vertices first
  std::vector<std::vector<std::array<int, 3>>> triangles;  // by region, counter-clockwise
};

/// A region of space that hangs together, inside closed surfaces of triangles, given by the numbers of their vertices:
/// counter-clockwise as seen from outside of the region.
struct EnclosedRegion {
  std::vector<std::array<int, 3>> faces;
};

struct Tetrahedra {
  std::vector<Point> points;                                // [m] the given vertices first
  std::vector<std::vector<std::array<int, 4>>> tetrahedra;  // by region, of positive volume
};

/// Why there is no triangulation: what() goes on after "the region cannot be meshed: ".
class NoTriangulation : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Whether this program can fill regions with triangles and tetrahedra: it was built with Gmsh.
bool has_triangulation();

/// Triangles of the regions whose sides on the chains are the given ones, undivided, and inside are as long as `size`
/// asks [m]. By Gmsh, in a process of its own that is given up after `time_limit` seconds; the same input gives the
/// same triangles. Throws NoTriangulation, and ChildLost where that process is lost, which says nothing of the regions.
Triangulation triangulate(const std::vector<Vec<double, 2>>& vertices, const std::vector<OutlinedRegion>& regions,
                          const std::function<double(double x, double y)>& size, double time_limit);

/// Tetrahedra of the regions whose faces on the surfaces are the given ones, likewise. Regions that touch have common
/// faces there. Throws likewise.
Tetrahedra tetrahedra_in(const std::vector<Point>& vertices, const std::vector<EnclosedRegion>& regions,
                         const std::function<double(const Point&)>& size, double time_limit);

}  // namespace mudline
