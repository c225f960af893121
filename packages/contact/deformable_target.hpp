#pragma once

#include <map>
#include <vector>

#include "contact/master_surface.hpp"
#include "contact/target.hpp"
#include "framework/space.hpp"

namespace mudline {

constexpr int max_target_nodes = 9;  // of a piece

/// Closest point y of a deformable target to a contact point x: x = y + gap normal, y = sum_a weight_a x_a over the
/// nodes of a piece. Its derivatives are by three numbers on which all depends at first order: the displacement d of x
/// against the material point at y, and in the plane, where d has two components, the rotation of the surface at that
/// material point [rad], positive from the direction of travel to the normal.
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

/// A surface of a deformable body as the target of contact points. The point gets the force, the nodes of the target
/// the opposite with their weights: forces cancel to rounding. A point's travel is its displacement in the step
/// relative to the material at its closest point. The tangent is exact except for what the target holds constant in a
/// step.
///
/// Columns: piece and coordinates on it, in space the normal.
class DeformableTarget : public Target {
 public:
  explicit DeformableTarget(int axes) : axes_(axes) {}

  virtual int pieces() const = 0;
  virtual TargetNodes nodes(int piece) const = 0;
  /// Sides of the mesh over which it is drawn.
  virtual const std::vector<MasterSurface::MasterSide>& sides() const = 0;
  /// Takes what stays constant during a step from these coordinates, and sorts the pieces for near().
  virtual void update(const ConstCoordinateView& x) = 0;
  /// The closest point at a place that find() has found for the point `at`.
  virtual ClosestPoint closest(const TargetPlace& place, const Point& at, const ConstCoordinateView& x) const = 0;
  /// Weights of the nodes of a piece at coordinates on it.
  virtual void weights(int piece, const double* at, double* weight) const = 0;
  /// Gives it the field whose displacements move its nodes; it has dofs from then on.
  void bind(const Space& space, int displacement);

  int num_dofs(int piece) const override { return axes_ * nodes(piece).count; }
  int* write_dofs(int piece, int* to) const override;
  std::vector<StateVariable> columns() const override;
  void write(const TargetPlace& place, const ContactPoint& point, double* columns) const override;
  void look_at(const State& state) override { update(state.coordinates); }
  void move(const StepView&, bool) override {}
  void complete(const TargetPlace& place, const Point& at, const ConstCoordinateView& x,
                ContactPoint& point) const override {
    point.normal = closest(place, at, x).normal;
  }
  std::vector<VertexShare> vertices(const double* columns) const override;
  ContactPoint act(const PointInStep& point, const TargetPlace& place, SideAction& to) const override;
  int old_piece(const double* columns) const override { return static_cast<int>(columns[0]); }
  void old_forces(const double* columns, const Point& force, double* on_target) const override;

 private:
  int axes_, displacement_ = -1;
  const Space* space_ = nullptr;
  std::map<int, std::vector<int>> corners_;  // (node) the vertices whose mean is its place on its side
};

}  // namespace mudline
