#include "contact/nodes/node_segment.hpp"

#include <algorithm>
#include <cmath>

#include "contact/laws/contact_damping.hpp"
#include "contact/laws/impact_share.hpp"
#include "tensor/dual.hpp"

namespace mudline {

namespace {

template <class T>
struct Vec {
  T x, y;
};
template <class T>
T dot(const Vec<T>& a, const Vec<T>& b) {
  return a.x * b.x + a.y * b.y;
}
template <class T>
Vec<T> minus(const Vec<T>& a, const Vec<T>& b) {
  return {a.x - b.x, a.y - b.y};
}

/// Positions as numbers of kind T: with derivatives where they are unknowns.
template <class T>
struct Positions {
  Vec<T> slave, master[max_piece_nodes];
};

Positions<double> plain(const NodeCoordinates& x) {
  Positions<double> result{{x.slave[0], x.slave[1]}, {}};
  for (int j = 0; j < max_piece_nodes; ++j) result.master[j] = {x.master[j][0], x.master[j][1]};
  return result;
}

template <class T>
Positions<T> variables(const NodeCoordinates& x) {
  Positions<T> result{{T(x.slave[0], 0), T(x.slave[1], 1)}, {}};
  for (int j = 0; j < max_piece_nodes; ++j)
    result.master[j] = {T(x.master[j][0], 2 + 2 * j), T(x.master[j][1], 3 + 2 * j)};
  return result;
}

template <class T>
Vec<T> combine(const SurfacePiece& piece, const T (&weight)[max_piece_nodes], const Vec<T> (&nodes)[max_piece_nodes]) {
  Vec<T> sum{T(0.0), T(0.0)};
  for (int j = 0; j < piece.count; ++j) {
    sum.x = sum.x + weight[j] * nodes[j].x;
    sum.y = sum.y + weight[j] * nodes[j].y;
  }
  return sum;
}

/// The foot with its derivatives.
template <class T>
struct Geometry {
  T W[max_piece_nodes];
  T gap;
  Vec<T> normal, along, foot;
};

template <class T>
Geometry<T> geometry(const SurfacePiece& piece, const NodeFoot& at, const Positions<T>& x) {
  Geometry<T> g;
  T dW[max_piece_nodes], ddW[max_piece_nodes];
  piece.weights(T(at.eta), g.W, dW, ddW);
  g.foot = combine(piece, g.W, x.master);
  Vec<T> way = minus(x.slave, g.foot);
  if (at.corner) {
    const Vec<T> chord = minus(x.master[piece.count - 1], x.master[0]);
    const Vec<T> outward{T(at.outward[0]), T(at.outward[1])};
    g.normal = outward;
    g.gap = dot(way, outward);
    const double distance = std::sqrt(value(dot(way, way)));
    if (distance > 1e-12 * std::sqrt(value(dot(chord, chord)))) {
      const T length = square_root(dot(way, way));
      g.gap = value(g.gap) < 0 ? -1.0 * length : length;
      g.normal = {way.x / g.gap, way.y / g.gap};
    }
    g.along = {-1.0 * g.normal.y, g.normal.x};
    return g;
  }
  // eta follows from way . y' = 0 by one step of Newton's method, which leaves its value
  const Vec<T> tangent = combine(piece, dW, x.master), bend = combine(piece, ddW, x.master);
  const T ahead = dot(way, tangent);
  const double slope = value(dot(way, bend) - dot(tangent, tangent));
  const T eta = at.eta - (ahead - value(ahead)) / slope;
  piece.weights(eta, g.W, dW, ddW);
  g.foot = combine(piece, g.W, x.master);
  const Vec<T> direction = combine(piece, dW, x.master);
  const T length = square_root(dot(direction, direction));
  g.along = {direction.x / length, direction.y / length};
  g.normal = {g.along.y, -1.0 * g.along.x};
  way = minus(x.slave, g.foot);
  g.gap = dot(way, g.normal);
  return g;
}

/// Shear stress of a node that presses.
template <class T>
T shear_stress(const NodeLaw& law, const Geometry<T>& g, const SurfacePiece& piece, const Positions<T>& x,
               const Positions<double>& old, const T& pressure, NodeForce& out) {
  Vec<T> was_master[max_piece_nodes];
  for (int j = 0; j < max_piece_nodes; ++j) was_master[j] = {T(old.master[j].x), T(old.master[j].y)};
  const Vec<T> was{T(old.slave.x), T(old.slave.y)}, foot_was = combine(piece, g.W, was_master);
  T travel = dot(minus(minus(x.slave, was), minus(g.foot, foot_was)), g.along);
  const T gap_was = dot(minus(was, foot_was), g.normal);
  // a node that was open counts what it travelled after it touched, as if the gap had closed evenly
  if (law.normal == 0 && value(gap_was) > 0) travel = value(g.gap) < 0 ? travel * g.gap / (g.gap - gap_was) : T(0.0);
  const double stiffness = law.friction->tangential_factor() * law.penalty;
  T stress = law.shear - stiffness * travel;
  if (law.first_guess) return stress;
  const ShearStrength strength = law.friction->strength(
      {value(pressure), {old.slave.x, old.slave.y}, law.slip, law.time, std::abs(value(travel)) / law.dt});
  const double trial = value(stress);
  if (std::abs(trial) <= strength.value) return stress;
  const double direction = trial > 0 ? 1 : -1;
  out.slides = true;
  out.slip = (std::abs(trial) - strength.value) / stiffness;
  stress = chain(pressure, direction * strength.value, direction * strength.slope);
  return stress + direction * strength.rate_slope * (value(travel) > 0 ? 1 : -1) / law.dt * (travel - value(travel));
}

/// Forces of a node by dof; at the end of the step, and what damping adds to the mean over it.
template <class T>
struct Forces {
  T end[node_dofs], damping[node_dofs];
  T gap, share;
};

template <class T>
void spread(const SurfacePiece& piece, const Geometry<T>& g, const T& x, const T& y, T (&force)[node_dofs]) {
  const T of_slave[2] = {x, y};
  for (int i = 0; i < 2; ++i) {
    force[i] = of_slave[i];
    for (int j = 0; j < piece.count; ++j) force[2 + 2 * j + i] = -1.0 * g.W[j] * of_slave[i];
  }
}

/// Damping of a node with this pressure, also of one that left in the step.
template <class T>
void add_damping(const NodeLaw& law, const SurfacePiece& piece, const Geometry<T>& g, const T& pressure,
                 const StepShares& shares, Forces<T>& result, NodeForce& out) {
  const ContactDamping viscous = contact_damping(law.viscous, law.gap_old, out.gap, law.dt);
  const T mean = chain(g.gap, shares.start.value, shares.start.slope) * law.normal_old +
                 chain(g.gap, shares.end.value, shares.end.slope) * pressure * law.area;
  const T size = chain(g.gap, viscous.factor, viscous.slope) * mean;
  out.damped = value(size) * (law.gap_old - out.gap);
  spread(piece, g, size * g.normal.x, size * g.normal.y, result.damping);
}

template <class T>
void evaluate(const NodeLaw& law, const SurfacePiece& piece, const NodeFoot& foot, const Positions<double>& old,
              const Positions<T>& x, Forces<T>& result, NodeForce& out) {
  const Geometry<T> g = geometry(piece, foot, x);
  result.gap = g.gap;
  result.share = T(1.0);
  for (int a = 0; a < node_dofs; ++a) result.end[a] = result.damping[a] = T(0.0);
  T pressure = law.normal - law.penalty * g.gap;
  out.gap = value(g.gap);
  // surfaces that meet without overlap have stiffness, but no pull
  const bool open = law.fixed ? !law.member : !(value(pressure) > -law.penalty * law.touch);
  if (open) pressure = T(0.0);
  if (!law.fixed && value(pressure) < 0) pressure = chain(pressure, 0.0, 1.0);
  const bool conserves = law.end_weight > 0;
  const StepShares shares =
      conserves ? conserving_shares(law.gap_old, out.gap, law.damping) : interpolated_shares(law.start_weight);
  if (law.viscous > 0 && (!open || law.normal_old > 0)) add_damping(law, piece, g, pressure, shares, result, out);
  if (open) return;
  out.presses = true;
  out.pressure = value(pressure);
  T shear(0.0);
  if (law.friction) shear = shear_stress(law, g, piece, x, old, pressure, out);
  out.shear = value(shear);
  if (conserves) result.share = chain(g.gap, shares.end.value / law.end_weight, shares.end.slope / law.end_weight);
  spread(piece, g, (pressure * g.normal.x + shear * g.along.x) * law.area,
         (pressure * g.normal.y + shear * g.along.y) * law.area, result.end);
}

}  // namespace

void node_force(const NodeLaw& law, const SurfacePiece& piece, const NodeFoot& foot, const NodeCoordinates& old,
                const NodeCoordinates& now, bool want_tangent, NodeForce& out) {
  out = {};
  if (!want_tangent) {
    Forces<double> force;
    evaluate(law, piece, foot, plain(old), plain(now), force, out);
    std::copy_n(force.end, node_dofs, out.f);
    std::copy_n(force.damping, node_dofs, out.damping);
    out.share = force.share;
    return;
  }
  using T = Dual<node_dofs>;
  Forces<T> force;
  evaluate(law, piece, foot, plain(old), variables<T>(now), force, out);
  out.share = value(force.share);
  std::copy_n(force.gap.d, node_dofs, out.gap_slope);
  const double weight = 1 / (1 - law.start_weight);
  for (int a = 0; a < node_dofs; ++a) {
    out.f[a] = value(force.end[a]);
    out.damping[a] = value(force.damping[a]);
    const T acting = force.end[a] * force.share + weight * force.damping[a];
    std::copy_n(acting.d, node_dofs, out.k[a]);
  }
}

}  // namespace mudline
