#include "contact/mortar/pair_segment.hpp"

#include <algorithm>
#include <cmath>

#include "contact/vector.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// Shapes of the 2 or 3 nodes of a line: ends at -1 and 1, middle at 0.
template <class T>
void line_shapes(int nodes, const T& xi, T (&N)[max_line_nodes]) {
  if (nodes == 2) {
    N[0] = 0.5 * (1.0 - xi);
    N[1] = 0.5 * (1.0 + xi);
    N[2] = T(0.0);
  } else {
    N[0] = 0.5 * xi * (xi - 1.0);
    N[1] = 0.5 * xi * (xi + 1.0);
    N[2] = 1.0 - xi * xi;
  }
}

/// A straight or parabolic side.
template <class T>
struct Curve {
  int nodes;
  Vec<T, 2> node[max_line_nodes];

  SideMap<2, T> map(const T& xi) const {
    T N[max_line_nodes];
    const T dN[max_line_nodes] = {nodes == 2 ? T(-0.5) : xi - 0.5, nodes == 2 ? T(0.5) : xi + 0.5, -2.0 * xi};
    line_shapes(nodes, xi, N);
    SideMap<2, T> result;
    result.compute(nodes, N, dN, [&](int a, int i) { return node[a][i]; });
    return result;
  }
  Vec<T, 2> point(const T& xi) const { return map(xi).x; }
  Vec<T, 2> slope(const T& xi) const { return map(xi).along[0]; }
  Vec<T, 2> bend() const {
    if (nodes == 2) return {T(0.0), T(0.0)};
    const T N[max_line_nodes] = {T(1.0), T(1.0), T(-2.0)};
    return combine(nodes, N, node);
  }
};

/// Side whose coordinates are unknowns, with derivative indices from `first` on.
template <class T>
Curve<T> curve(int nodes, const SideCoordinates& x, int first = 0) {
  Curve<T> result{nodes, {}};
  for (int a = 0; a < nodes; ++a) result.node[a] = unknown<T>(x[a], first + 2 * a);
  return result;
}

template <class T>
Curve<T> resting_curve(int nodes, const SideCoordinates& x) {
  Curve<T> result{nodes, {}};
  for (int a = 0; a < nodes; ++a) result.node[a] = constant<T>(x[a]);
  return result;
}

/// Newton's method on plain numbers, f(xi, slope), then one step with dual numbers for the derivatives. False without
/// convergence.
template <class T, class F, class G>
bool solve(double guess, F plain, G with_derivatives, T& result) {
  double xi = guess;
  bool converged = false;
  for (int i = 0; i < 30; ++i) {
    double slope = 0;
    const double f = plain(xi, slope);
    if (!(std::abs(slope) > 0)) return false;
    const double step = std::max(-1.0, std::min(1.0, f / slope));
    xi -= step;
    if (!(std::abs(xi) < 20)) return false;
    converged = std::abs(step) < 1e-14;
    if (i == 29) converged = std::abs(step) < 1e-12;
    if (converged) break;
  }
  if (!converged) return false;
  double slope = 0;
  plain(xi, slope);
  result = T(xi) - with_derivatives(T(xi)) / slope;
  return true;
}

/// Where the slave side is crossed by the line across an end of the master side: a bound of the segment, within [-1,
/// 1]. False where there is none.
template <class T>
bool segment_end(const Curve<double>& slave, const Curve<double>& master, const Curve<T>& slave_t,
                 const Curve<T>& master_t, double end, T& xi) {
  const Vec<double, 2> corner = master.point(end), along = master.slope(end);
  const double first = dot(slave.node[0] - corner, along), second = dot(slave.node[1] - corner, along);
  if (first == second) return false;
  const double guess = (first + second) / (first - second);
  // far outside there is nothing to solve: the whole slave side is on one side of the line
  if (guess < -3 || guess > 3) {
    xi = T(guess < 0 ? -1.0 : 1.0);
    return true;
  }
  const Vec<T, 2> corner_t = master_t.point(T(end)), along_t = master_t.slope(T(end));
  const bool found = solve<T>(
      guess,
      [&](double at, double& slope) {
        slope = dot(slave.slope(at), along);
        return dot(slave.point(at) - corner, along);
      },
      [&](const T& at) { return dot(slave_t.point(at) - corner_t, along_t); }, xi);
  if (!found) return false;
  if (value(xi) < -1) xi = T(-1.0);
  if (value(xi) > 1) xi = T(1.0);
  return true;
}

/// One point of the slave side and its closest point.
template <class T>
struct Projection {
  T eta, gap;
  Vec<T, 2> normal, along;
};

template <class T>
bool find_projection(const Curve<double>& master, const Curve<T>& master_t, const Vec<T, 2>& at,
                     Projection<T>& projection) {
  const Vec<double, 2> x{value(at[0]), value(at[1])};
  const Vec<double, 2> chord = master.node[1] - master.node[0];
  const double guess = 2 * dot(x - master.node[0], chord) / dot(chord, chord) - 1;
  const bool found = solve<T>(
      guess,
      [&](double eta, double& slope) {
        const Vec<double, 2> offset = x - master.point(eta), along = master.slope(eta);
        slope = dot(offset, master.bend()) - dot(along, along);
        return dot(offset, along);
      },
      [&](const T& eta) { return dot(at - master_t.point(eta), master_t.slope(eta)); }, projection.eta);
  if (!found) return false;
  const SideMap<2, T> map = master_t.map(projection.eta);
  projection.along = map.along[0] / map.stretch;
  projection.normal = map.normal / map.stretch;
  projection.gap = dot(at - map.x, projection.normal);
  return true;
}

/// Slave and master side at the end of the step and at its start.
template <class T>
struct Sides {
  Sides(const PairLaw& law, const PairCoordinates& old, const PairCoordinates& now)
      : slave_at(curve<double>(law.nodes, now.slave)),
        master_at(curve<double>(law.nodes, now.master)),
        slave(curve<T>(law.nodes, now.slave)),
        master(curve<T>(law.nodes, now.master, 2 * law.nodes)),
        slave_old(resting_curve<T>(law.nodes, old.slave)),
        master_old(resting_curve<T>(law.nodes, old.master)) {}
  /// Ends of the part of the slave side that faces the master side; false where there is none.
  bool segment(T& from, T& to) const {
    // sides that are back to back do not meet
    if (dot(slave_at.node[1] - slave_at.node[0], master_at.node[1] - master_at.node[0]) >= 0) return false;
    return segment_end(slave_at, master_at, slave, master, 1.0, from) &&
           segment_end(slave_at, master_at, slave, master, -1.0, to) && value(to) - value(from) > 1e-12;
  }
  Curve<double> slave_at, master_at;
  Curve<T> slave, master, slave_old, master_old;
};

/// One quadrature point.
template <class T>
struct SegmentPoint {
  T xi, length, area, shape[side_multipliers];  // length: without the circumference [m]
  Vec<T, 2> at;
  Projection<T> projection;
  T field(const double (&corners)[side_multipliers]) const { return shape[0] * corners[0] + shape[1] * corners[1]; }
};

/// Interpolates linearly between the corners.
TouchingSoil soil_between(const TouchingSoil (&corner)[side_multipliers], double xi) {
  const double from = 0.5 * (1 - xi), to = 0.5 * (1 + xi);
  return {from * corner[0].pore_pressure + to * corner[1].pore_pressure,
          from * corner[0].temperature + to * corner[1].temperature,
          from * corner[0].mean_stress + to * corner[1].mean_stress,
          from * corner[0].undrained_strength + to * corner[1].undrained_strength};
}

/// Pore pressure of the slave at a point, beside that of `law.soil` [Pa].
template <class T>
T pore_pressure(const PairLaw& law, const T& xi) {
  T N[max_line_nodes], result(0.0);
  line_shapes(law.pressures, xi, N);
  for (int a = 0; a < law.pressures; ++a) result += N[a] * unknown<T>(law.pore_pressure[a], 4 * law.nodes + a);
  return result;
}

template <class T>
ContactMotion<T> motion_of_point(const PairLaw& law, const Sides<T>& sides, const SegmentPoint<T>& point) {
  ContactMotion<T> motion;
  motion.gap = point.projection.gap;
  const T multiplier = point.field(law.normal), before = point.field(law.pressure_old);
  motion.shift = multiplier / law.penalty;
  motion.soil = soil_between(law.soil, value(point.xi));
  motion.pore_pressure = T(motion.soil.pore_pressure);
  if (law.pressures > 0) motion.pore_pressure += pore_pressure(law, point.xi);
  motion.slip_old = value(point.shape[0]) * law.slip_old[0] + value(point.shape[1]) * law.slip_old[1];
  motion.area = point.area;
  if (!(law.viscous > 0) && !(law.friction && presses(law, motion))) return motion;
  const Vec<T, 2> was = sides.slave_old.point(point.xi), projection_was = sides.master_old.point(point.projection.eta);
  motion.gap_old = dot(was - projection_was, point.projection.normal);
  if (value(before) > 0) motion.force_old = before * motion.area;
  if (value(multiplier) == 0) motion.opened = motion.gap_old;
  motion.travel =
      dot((point.at - was) - (sides.master.point(point.projection.eta) - projection_was), point.projection.along);
  motion.shear_old = point.field(law.shear);
  motion.position = plain(was);
  return motion;
}

/// Adds a force on the slave and its opposite on the master.
template <class T>
void act(const Sides<T>& sides, const SegmentPoint<T>& point, const Vec<T, 2>& force, T (&to)[pair_dofs]) {
  T N[max_line_nodes], M[max_line_nodes];
  line_shapes(sides.slave.nodes, point.xi, N);
  line_shapes(sides.slave.nodes, point.projection.eta, M);
  spread(sides.slave.nodes, N, force, to);
  spread(sides.slave.nodes, M, force * -1.0, to + 2 * sides.slave.nodes);
}

template <class T>
void sum_up(const PairLaw& law, const SegmentPoint<T>& point, const ContactMotion<T>& motion,
            const ContactResponse<T>& now, PairForce& out) {
  PairSums& sums = out.sums;
  const double weight = value(point.length);
  sums.damped += now.damping_heat;
  if (!now.presses) return;
  for (int a = 0; a < side_multipliers; ++a) {
    const double share = weight * value(point.shape[a]);
    sums.pressure[a] += share * value(now.pressure);
    sums.shear[a] += share * value(now.shear);
    sums.slip[a] += share * now.slip;
    if (law.friction && !now.slides) sums.stretch[a] += share * (value(now.shear) - value(motion.shear_old));
    for (int b = 0; b < side_multipliers; ++b) sums.touching[a][b] += share * value(point.shape[b]);
  }
  sums.area += value(motion.area);
  sums.heat += now.heat;
  const double eta = value(point.projection.eta), on_master[side_multipliers] = {0.5 * (1 - eta), 0.5 * (1 + eta)};
  for (int a = 0; a < side_multipliers; ++a) {
    out.heat[0][a] += now.heat * value(point.shape[a]);
    out.heat[1][a] += now.heat * on_master[a];
  }
  sums.deepest = std::min(sums.deepest, value(point.projection.gap));
  if (now.slides) sums.sliding += weight;
}

template <class T>
bool integrate(const PairLaw& law, const PairCoordinates& old, const PairCoordinates& at, PairForce& out) {
  const Sides<T> sides(law, old, at);
  StepForces<T, pair_dofs> forces;
  PairSums& sums = out.sums;
  T from, to;
  if (!sides.segment(from, to)) return false;
  bool seen = false;
  sums.closest = law.capture;
  for (std::size_t q = 0; q < law.rule.weights.size(); ++q) {
    SegmentPoint<T> point;
    const T half = 0.5 * (to - from);
    point.xi = from + half * (1.0 + law.rule.points[q][0]);
    const SideMap<2, T> map = sides.slave.map(point.xi);
    point.at = map.x;
    if (!find_projection(sides.master_at, sides.master, point.at, point.projection)) return false;
    const double gap = value(point.projection.gap);
    if (std::abs(gap) > law.capture) continue;
    seen = true;
    sums.closest = std::min(sums.closest, gap);
    point.length = law.rule.weights[q] * half * map.stretch;
    point.area = point.length * measure(law.geometry, map.x.data());
    point.shape[0] = 0.5 * (1.0 - point.xi);
    point.shape[1] = 0.5 * (1.0 + point.xi);
    for (int a = 0; a < side_multipliers; ++a) {
      sums.length[a] += value(point.length) * value(point.shape[a]);
      sums.gap[a] += value(point.length) * value(point.shape[a]) * gap;
    }
    const ContactMotion<T> motion = motion_of_point(law, sides, point);
    if (!presses(law, motion) && !(law.viscous > 0)) continue;
    const ContactResponse<T> now = respond(law, motion);
    const Projection<T>& projection = point.projection;
    if (now.presses)
      act(sides, point, (projection.normal * now.pressure + projection.along * now.shear) * motion.area, forces.end);
    if (law.viscous > 0) act(sides, point, projection.normal * now.damping, forces.more);
    sum_up(law, point, motion, now, out);
  }
  forces.write(T(1.0), 1 / (1 - law.start_weight), out.f, out.damping, out.k);
  return seen;
}

}  // namespace

bool pair_segment(const PairLaw& law, const PairCoordinates& old, const PairCoordinates& now, bool want_tangent,
                  PairForce& out) {
  out = {};
  return want_tangent ? integrate<Dual<pair_unknowns>>(law, old, now, out) : integrate<double>(law, old, now, out);
}

}  // namespace mudline
