#pragma once

#include <variant>
#include <vector>

#include "contact/point_action.hpp"
#include "contact/side_box.hpp"
#include "framework/term.hpp"
#include "geometry/contour.hpp"
#include "geometry/surface.hpp"

namespace mudline {

/// Place of a closest point on a target. Rigid: the projection onto the body, in the world frame. Deformable: a piece
/// of the target, and coordinates on it.
struct TargetPlace {
  int piece = -1;        // a rigid target is one piece
  double at[2] = {};     // in the plane only the first
  double gap = 0;        // [m]
  bool corner = false;   // the nearest point is a corner, at an end of the piece
  PlanePoint outward{};  // at a corner: mean of the unit normals on both sides
  std::variant<std::monostate, ContourProjection, SurfaceProjection> projection = {};
};

/// A vertex of the mesh, and the value of its linear shape function at a place.
struct VertexShare {
  int node;  // local
  double share;
};

/// What the points of a slave touch: a rigid body, or a deformable surface in pieces that are drawn over nodes of the
/// mesh. Which unknowns a piece depends on never changes.
class Target {
 public:
  virtual ~Target() = default;

  /// Dofs of a piece, and where they are written; returns the place after the last. None: the piece's motion is
  /// prescribed.
  virtual int num_dofs(int piece) const = 0;
  virtual int* write_dofs(int piece, int* to) const = 0;
  /// Columns of a point's row that belong to the target, and their values of an evaluated point.
  virtual std::vector<StateVariable> columns() const = 0;
  virtual void write(const TargetPlace& place, const ContactPoint& point, double* columns) const = 0;

  /// Takes its place in a state between steps, and what stays constant during the next step.
  virtual void look_at(const State& state) = 0;
  /// Takes its places at both ends of a step. `ahead`: those that are conjugate to forces, see ImpactView.
  virtual void move(const StepView& view, bool ahead) = 0;
  /// Pieces that come within `distance` [m] of the box, in ascending order; a few more may be among them.
  virtual std::vector<int> near(const Bounds& box, double distance) const = 0;
  /// Finds the nearest closest point of a point on one of `candidates`; false where none of them faces it within
  /// `capture` [m]. `outward`: direction out of the point's own surface. A rigid target is found at any distance.
  virtual bool find(const std::vector<int>& candidates, const Point& at, const Point& outward, double capture,
                    const ConstCoordinateView& x, TargetPlace& place) const = 0;
  /// Adds to a point that touches at a place, `at`, what the target knows of it: its normal, and for a rigid target
  /// moment and height.
  virtual void complete(const TargetPlace& place, const Point& at, const ConstCoordinateView& x,
                        ContactPoint& point) const = 0;

  /// The vertices of the target's mesh around the closest point of a row, by the target's columns; none: what it
  /// touches has no fields.
  virtual std::vector<VertexShare> vertices(const double* columns) const = 0;

  /// Evaluates a point at a place that find() has found, and adds its forces to those of its side and piece.
  virtual ContactPoint act(const PointInStep& point, const TargetPlace& place, SideAction& to) const = 0;
  /// The piece on which a point pressed at the start of the step, by the target's columns of its row.
  virtual int old_piece(const double* columns) const = 0;
  /// Forces on the dofs of that piece, of a force [N] on the point at the start of the step.
  virtual void old_forces(const double* columns, const Point& force, double* on_target) const = 0;
};

}  // namespace mudline
