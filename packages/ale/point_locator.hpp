#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "ale/ghosted_mesh.hpp"
#include "ale/side_locator.hpp"
#include "geometry/box_tree.hpp"

namespace mudline {

/// Where a point lies in the mesh: element and its reference coordinates.
struct MeshPlace {
  int element = -1;
  double xi[3] = {0, 0, 0};
};

/// Finds points in a mesh by walking from a guess to the neighbour in whose direction the point lies; exact on curved
/// elements. Where the walk gets stuck, the elements near the point are searched. The search stays in the guess's
/// block: materials do not mix. A point outside, beyond a curved boundary, gets the boundary element next to it with
/// reference coordinates outside the cell.
class PointLocator {
 public:
  PointLocator(const GhostedMesh& mesh, const Positions& x) : mesh_(mesh), x_(x) {}
  MeshPlace find(const Point& point, int guess) const;
  /// The nearest point of the mesh's outer boundary, for points outside.
  MeshPlace nearest_on_boundary(const Point& point) const;
  /// Inverse of the isoparametric map of one element. False where Newton's method finds none.
  bool invert(int element, const Point& point, double xi[3]) const;

 private:
  /// The best place so far: the one least far outside its cell.
  struct Found {
    MeshPlace place;
    double off = 1e300;
    /// Takes the place if it is better than the best so far; returns whether the best is inside its cell.
    bool take(int element, CellShape shape, const double (&xi)[3]);
  };
  const BoxTree& boxes(int block) const;

  const GhostedMesh& mesh_;
  const Positions& x_;
  mutable std::vector<std::unique_ptr<const BoxTree>> boxes_;  // (block) of its elements, made when a walk has failed
  mutable std::unique_ptr<const SideLocator> boundary_;        // of the outer boundary, made when it is asked for
  mutable std::vector<std::pair<int, int>> boundary_sides_;    // its sides: element, side of the element
};

}  // namespace mudline
