#pragma once

#include <memory>

#include "bodies/rigid_body.hpp"
#include "contact/target.hpp"

namespace mudline {

/// A body at both ends of a step.
struct BodyInStep {
  const RigidBody& body;
  BodyPlacement old, now;
  Point turning[3] = {};  // BodyPlacement::turning of `now`
};

/// A rigid body as the target of contact points: one piece, whose dofs are the body's unknowns. The point gets the
/// force; the body the opposite, and its moment about the centre of mass conjugate to the body's rotations. A point's
/// travel is the path of its closest point over the body, in the plane along the contour.
///
/// Columns: height [m] of the point above the body's reference point, and moment [N m] of its force about the centre of
/// mass.
class RigidTarget : public Target {
 public:
  explicit RigidTarget(std::shared_ptr<const RigidBody> body) : step_{*body, {}, {}}, body_(std::move(body)) {}

  int num_dofs(int) const override { return body_->unknowns().count; }
  int* write_dofs(int piece, int* to) const override;
  std::vector<StateVariable> columns() const override;
  void write(const TargetPlace& place, const ContactPoint& point, double* columns) const override;
  static double height(const double* columns) { return columns[0]; }
  Point moment(const double* columns) const;

  void look_at(const State& state) override { step_.now = body_->placement(state); }
  void move(const StepView& view, bool ahead) override;
  std::vector<int> near(const Bounds& box, double distance) const override;
  /// Lower bound of the gap [m] of all points in a box, with the body as it was placed last.
  double least_gap(const Bounds& box) const;
  bool find(const std::vector<int>& candidates, const Point& at, const Point& outward, double capture,
            const ConstCoordinateView& x, TargetPlace& place) const override;
  void complete(const TargetPlace& place, const Point& at, const ConstCoordinateView& x,
                ContactPoint& point) const override;
  std::vector<VertexShare> vertices(const double*) const override { return {}; }
  ContactPoint act(const PointInStep& point, const TargetPlace& place, SideAction& to) const override;
  int old_piece(const double*) const override { return 0; }
  void old_forces(const double* columns, const Point& force, double* on_target) const override;

 private:
  BodyInStep step_;
  std::shared_ptr<const RigidBody> body_;
};

}  // namespace mudline
