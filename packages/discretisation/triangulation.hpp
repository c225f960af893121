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

/// A connected region of space inside closed surfaces of triangles, given by the numbers of their vertices:
/// counter-clockwise as seen from outside of the region.
struct EnclosedRegion {
  std::vector<std::array<int, 3>> faces;
};

struct Tetrahedra {
  std::vector<Point> points;                                // [m] the given vertices first
  std::vector<std::vector<std::array<int, 4>>> tetrahedra;  // by region, of positive volume
};

/// Thrown where there is no triangulation; what() completes "the region cannot be meshed: ".
class NoTriangulation : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Sides on the boundary of a region or on a geometry's curves beyond which a mesh is refused: lengths in different
/// units. A million triangles of one size have some 3000, ten million tetrahedra 2400.
constexpr std::size_t most_sides = 20000;

/// Triangulates the regions with Gmsh. The sides of the chains are not divided; inside, edges are as long as `size`
/// asks [m]. Gmsh runs in a process of its own that is ended after `time_limit` seconds; the same input gives the same
/// triangles. Throws NoTriangulation, also for more than `most_sides`, and ChildLost where that process is lost, which
/// says nothing about the regions.
Triangulation triangulate(const std::vector<Vec<double, 2>>& vertices, const std::vector<OutlinedRegion>& regions,
                          const std::function<double(double x, double y)>& size, double time_limit);

/// Fills the regions with tetrahedra in the same way. The faces of the surfaces are not divided; regions that touch
/// have common faces there. Throws as triangulate() does.
Tetrahedra tetrahedra_in(const std::vector<Point>& vertices, const std::vector<EnclosedRegion>& regions,
                         const std::function<double(const Point&)>& size, double time_limit);

}  // namespace mudline
