#pragma once

#include <vector>

#include "contact/master_surface.hpp"
#include "tensor/vec.hpp"

namespace mudline {

constexpr int max_target_nodes = 9;  // of a piece

/// Place of a closest point: a piece of the target, and coordinates on it.
struct TargetPlace {
  int piece = -1;
  double at[2] = {};     // in the plane only the first
  double gap = 0;        // [m]
  bool corner = false;   // the nearest point is a corner, at an end of the piece
  PlanePoint outward{};  // at a corner: mean of the unit normals on both sides
};

/// Closest point y of a target to a contact point x: x = y + gap normal, y = sum_a weight_a x_a over the nodes of a
/// piece. Its derivatives are by three numbers on which all depends at first order: the displacement d of x against the
/// material point at y, and in the plane, where d has two components, the rotation of the surface at that material
/// point [rad], positive from the direction of travel to the normal.
struct ClosestPoint {
  static constexpr int motions = 3;
  double gap = 0;  // [m]
  double gap_slope[motions] = {};
  Point normal{};  // out of the target
  double normal_slope[3][motions] = {};
  int nodes = 0;
  double weight[max_target_nodes] = {};
  double weight_slope[max_target_nodes][motions] = {};
  double turn[max_target_nodes] = {};  // [1/m] rotation per displacement of a node along the normal; 0 in space
};

/// Nodes of a piece of a target.
struct TargetNodes {
  int count;
  const int* node;  // local
};

/// A deformable surface that contact points touch: pieces that are drawn over nodes of the mesh. Which nodes a piece
/// depends on never changes.
class Target {
 public:
  virtual ~Target() = default;
  virtual int pieces() const = 0;
  virtual TargetNodes nodes(int piece) const = 0;
  /// Sides of the mesh over which it is drawn.
  virtual const std::vector<MasterSurface::MasterSide>& sides() const = 0;
  /// Takes what stays constant during a step from these coordinates, and sorts the pieces for near().
  virtual void update(const ConstCoordinateView& x) = 0;
  /// Pieces whose boxes come within `distance` [m] of the box, in ascending order.
  virtual std::vector<int> near(const BoxSearch::Corners& box, double distance) const = 0;
  /// Finds the nearest closest point of a point on one of `candidates`; false where none of them faces it within
  /// `capture` [m]. `outward`: direction out of the point's own surface.
  virtual bool find(const std::vector<int>& candidates, const Point& at, const Point& outward, double capture,
                    const ConstCoordinateView& x, TargetPlace& place) const = 0;
  /// The closest point at a place that find() has found for the point `at`.
  virtual ClosestPoint closest(const TargetPlace& place, const Point& at, const ConstCoordinateView& x) const = 0;
  /// Weights of the nodes of a piece at coordinates on it.
  virtual void weights(int piece, const double* at, double* weight) const = 0;
};

}  // namespace mudline
