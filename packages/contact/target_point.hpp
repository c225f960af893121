#pragma once

#include "contact/laws/contact_point.hpp"
#include "contact/parts/film_law.hpp"
#include "contact/target.hpp"

namespace mudline {

/// A contact point and its closest point on a deformable target, before the point law is asked. Area and history are
/// those of the start of the step.
struct TargetPoint {
  const ContactPointLaw& law;
  const ClosestPoint& closest;
  const Point* target_old;   // [m] nodes of the piece at the start of the step
  Point place_old;           // [m] of the point then
  double area;               // [m2]
  double gap_old = 0;        // [m] counted, committed
  double pore_pressure = 0;  // [Pa] of the slave at the point
  Point normal_old{};        // of the target, committed; in space
  PointHistory old = {};
  SideFilm film = {};
};

/// Forces between a contact point and its target. Derivatives are by the motions of ClosestPoint, then by the pore
/// pressure.
struct TargetForce {
  static constexpr int unknowns = ClosestPoint::motions + 1;
  ContactPoint point{};
  bool acts = false;                      // there is a force, or a stiffness
  Point acting{};                         // [N] mean over the step / the end's weight in the integrator's force
  double acting_slope[3][unknowns] = {};  // (component, unknown)
  double share = 1;                       // of the end in that mean, over the end's weight in the integrator
  double start_share = 0;                 // share of the force at the start in the mean over the step
  double start_share_slope[unknowns] = {};
  /// Water of a film, see FilmWater.
  double growth = 0, conduction = 0;
  double growth_slope[unknowns] = {}, conduction_slope[unknowns] = {};
};

/// The point law at a contact point: pressure t = <multiplier - penalty gap> along the target's normal, friction from
/// the relative displacement of the point and of the material at its closest point in the step. The point gets the
/// force, the nodes of the target the opposite with their weights: forces cancel to rounding. The tangent is exact
/// except for what the target holds constant in a step. D: dimension.
template <int D>
TargetForce target_force(const TargetPoint& point, bool want_tangent);

/// Nodes of the slave's side, then of the target's piece, with weights: d = sum_k weight_k x_k.
struct TargetColumns {
  int slave, count;
  double weight[2 * max_target_nodes];
};

/// Calls add(node, component, derivative by its position) for a number with these derivatives by the unknowns.
template <int D, class Add>
void spread_slopes(const TargetColumns& w, const ClosestPoint& at, const double* by, Add&& add) {
  for (int b = 0; b < w.count; ++b)
    for (int j = 0; j < D; ++j) {
      if (b < w.slave && w.weight[b] == 0) continue;
      const double turned = D == 2 && b >= w.slave ? by[2] * at.turn[b - w.slave] * at.normal[j] : 0.0;
      add(b, j, by[j] * w.weight[b] + turned);
    }
}

/// Calls take(node, component, derivatives by the unknowns) for the acting force on each node; `before`: the columns of
/// a force `leaving` [N] that acts with the start's share.
template <int D, class Take>
void node_slopes(const TargetColumns& w, const ClosestPoint& at, const TargetForce& force, const TargetColumns& before,
                 const Point& leaving, Take&& take) {
  for (int a = 0; a < w.count; ++a)
    for (int i = 0; i < D; ++i) {
      if (a < w.slave && w.weight[a] == 0) continue;
      double by[TargetForce::unknowns];
      for (int j = 0; j < TargetForce::unknowns; ++j)
        by[j] = w.weight[a] * force.acting_slope[i][j] + before.weight[a] * leaving[i] * force.start_share_slope[j];
      for (int j = 0; a >= w.slave && j < ClosestPoint::motions; ++j)
        by[j] -= at.weight_slope[a - w.slave][j] * force.acting[i];
      take(a, i, by);
    }
}

}  // namespace mudline
