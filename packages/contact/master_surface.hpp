#pragma once

#include <array>
#include <string>
#include <vector>

#include "contact/side_box.hpp"
#include "discretisation/shapes.hpp"
#include "geometry/box_tree.hpp"

namespace mudline {

/// All sides of a side set of the whole mesh, on every rank that has all their nodes (see SetPairs).
class MasterSurface {
 public:
  /// Collective.
  MasterSurface(const Mesh& mesh, const std::string& side_set);

  struct MasterSide {
    int count;    // nodes
    int node[9];  // local, in the order of the shape
    CellShape shape = CellShape::line2;
  };
  /// The sides, in an order that does not depend on the number of ranks; empty on ranks that lack some of the nodes.
  const std::vector<MasterSide>& sides() const { return sides_; }

  /// Sets the coordinates for near().
  void update(const ConstCoordinateView& x);
  /// Sides whose boxes come within `distance` [m] of the box, in ascending order.
  std::vector<int> near(const Bounds& box, double distance) const { return boxes_.near(box, distance); }

 private:
  std::vector<MasterSide> sides_;
  BoxTree boxes_;
};

}  // namespace mudline
