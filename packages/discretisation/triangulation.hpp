#pragma once

#include <array>
#include <functional>
#include <stdexcept>
#include <vector>

namespace mudline {

/// A region of the plane inside closed chains of sides, given by the numbers of their vertices: the outer one
/// counter-clockwise, those of holes clockwise.
struct OutlinedRegion {
  std::vector<std::vector<int>> loops;
};

struct Triangulation {
  std::vector<std::array<double, 2>> points;               // [m] the given vertices first
  std::vector<std::vector<std::array<int, 3>>> triangles;  // by region, counter-clockwise
};

/// Why there is no triangulation: what() goes on after "the region cannot be meshed: ".
class NoTriangulation : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Whether this program can triangulate: it was built with Gmsh.
bool has_triangulation();

/// Triangles of the regions whose sides on the chains are the given ones, undivided, and inside are as long as `size`
/// asks [m]. By Gmsh, in a process of its own that is given up after `time_limit` seconds; the same input gives the
/// same triangles. Throws NoTriangulation.
Triangulation triangulate(const std::vector<std::array<double, 2>>& vertices,
                          const std::vector<OutlinedRegion>& regions,
                          const std::function<double(double x, double y)>& size, double time_limit);

}  // namespace mudline
