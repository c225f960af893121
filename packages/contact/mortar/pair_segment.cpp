#include "contact/mortar/pair_segment.hpp"

#include <algorithm>
#include <cmath>

#include "contact/laws/contact_damping.hpp"
#include "core/pi.hpp"
#include "tensor/dual.hpp"

namespace mudline {

namespace {

template <class T>
struct Vec {
  T x, y;
  Vec operator-(const Vec& b) const { return {x - b.x, y - b.y}; }
};
template <class T>
T dot(const Vec<T>& a, const Vec<T>& b) {
  return a.x * b.x + a.y * b.y;
}

/// A straight or parabolic side: ends at -1 and 1, middle at 0.
template <class T>
struct Curve {
  int nodes;
  Vec<T> node[max_side_nodes];

  void shapes(const T& xi, T (&N)[max_side_nodes]) const {
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
  Vec<T> point(const T& xi) const {
    T N[max_side_nodes];
    shapes(xi, N);
    return combine(N);
  }
  Vec<T> slope(const T& xi) const {
    if (nodes == 2) return {0.5 * (node[1].x - node[0].x), 0.5 * (node[1].y - node[0].y)};
    const T N[max_side_nodes] = {xi - 0.5, xi + 0.5, -2.0 * xi};
    return combine(N);
  }
  Vec<T> bend() const {
    if (nodes == 2) return {T(0.0), T(0.0)};
    const T N[max_side_nodes] = {T(1.0), T(1.0), T(-2.0)};
    return combine(N);
  }
  Vec<T> combine(const T (&N)[max_side_nodes]) const {
    Vec<T> sum{T(0.0), T(0.0)};
    for (int a = 0; a < nodes; ++a) {
      sum.x += N[a] * node[a].x;
      sum.y += N[a] * node[a].y;
    }
    return sum;
  }
};

Curve<double> curve(int nodes, const SideCoordinates& x) {
  Curve<double> result{nodes, {}};
  for (int a = 0; a < nodes; ++a) result.node[a] = {x[a][0], x[a][1]};
  return result;
}

/// With each coordinate a variable, numbered from `first`.
template <int N>
Curve<Dual<N>> variable_curve(int nodes, const SideCoordinates& x, int first) {
  Curve<Dual<N>> result{nodes, {}};
  for (int a = 0; a < nodes; ++a)
    result.node[a] = {Dual<N>(x[a][0], first + 2 * a), Dual<N>(x[a][1], first + 2 * a + 1)};
  return result;
}

template <class T>
Curve<T> curve_as(const Curve<double>& plain) {
  Curve<T> result{plain.nodes, {}};
  for (int a = 0; a < plain.nodes; ++a) result.node[a] = {T(plain.node[a].x), T(plain.node[a].y)};
  return result;
}

/// Newton's method on plain numbers, f(xi, slope); then the derivatives, by one step with them. False without
/// convergence.
template <class T, class F, class G>
bool solve(double guess, F plain, G with_derivatives, T& result) {
  double xi = guess;
  bool converged = false;
  for (int i = 0; i < 30 && !converged; ++i) {
    double slope = 0;
    const double f = plain(xi, slope);
    if (!(std::abs(slope) > 0)) return false;
    const double step = std::max(-1.0, std::min(1.0, f / slope));
    xi -= step;
    if (!(std::abs(xi) < 20)) return false;
    converged = std::abs(step) < 1e-14;
    if (i == 29) converged = std::abs(step) < 1e-12;
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
  const Vec<double> corner = master.point(end), along = master.slope(end);
  const double first = dot(slave.node[0] - corner, along), second = dot(slave.node[1] - corner, along);
  if (first == second) return false;
  const double guess = (first + second) / (first - second);
  // far outside there is nothing to solve: the side is on one side of the line
  if (guess < -3 || guess > 3) {
    xi = T(guess < 0 ? -1.0 : 1.0);
    return true;
  }
  const Vec<T> corner_t = master_t.point(T(end)), along_t = master_t.slope(T(end));
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

template <class T>
T magnitude(const T& a) {
  return value(a) < 0 ? -1.0 * a : a;
}

/// One point of the slave side and its foot.
template <class T>
struct Foot {
  T eta, gap;
  Vec<T> normal, along;
};

template <class T>
bool find_foot(const Curve<double>& master, const Curve<T>& master_t, const Vec<T>& at, Foot<T>& foot) {
  const Vec<double> x{value(at.x), value(at.y)};
  const Vec<double> chord = master.node[1] - master.node[0];
  const double guess = 2 * dot(x - master.node[0], chord) / dot(chord, chord) - 1;
  const bool found = solve<T>(
      guess,
      [&](double eta, double& slope) {
        const Vec<double> way = x - master.point(eta), along = master.slope(eta);
        slope = dot(way, master.bend()) - dot(along, along);
        return dot(way, along);
      },
      [&](const T& eta) { return dot(at - master_t.point(eta), master_t.slope(eta)); }, foot.eta);
  if (!found) return false;
  const Vec<T> along = master_t.slope(foot.eta);
  const T length = square_root(dot(along, along));
  foot.along = {along.x / length, along.y / length};
  foot.normal = {foot.along.y, -1.0 * foot.along.x};
  foot.gap = dot(at - master_t.point(foot.eta), foot.normal);
  return true;
}

/// Shear stress of a point that presses, and what it adds to the sums but for the weight.
template <class T>
struct Shear {
  T stress{0.0};
  bool slides = false;
  double slip = 0;  // [m] of this step
};

template <class T>
Shear<T> shear_stress(const PairLaw& law, const T& multiplier, const T& pressure, const T& travel,
                      const PlanePoint& place) {
  Shear<T> result;
  const double stiffness = law.friction->tangential_factor() * law.penalty;
  result.stress = multiplier - stiffness * travel;
  if (law.first_guess) return result;
  const ShearStrength strength =
      law.friction->strength({value(pressure), place, 0.0, law.time, std::abs(value(travel)) / law.dt});
  const double trial = value(result.stress);
  if (std::abs(trial) <= strength.value) return result;
  const double direction = trial > 0 ? 1 : -1;
  result.slides = true;
  result.slip = (std::abs(trial) - strength.value) / stiffness;
  result.stress = chain(pressure, direction * strength.value, direction * strength.slope);
  const double by_travel = direction * strength.rate_slope * (value(travel) > 0 ? 1 : -1) / law.dt;
  result.stress = result.stress + by_travel * (travel - value(travel));
  return result;
}

/// Forces on the slave's nodes, then on the master's; what damping adds.
template <class T>
struct Forces {
  Forces() {
    for (int a = 0; a < pair_dofs; ++a) end[a] = damping[a] = T(0.0);
  }
  T end[pair_dofs], damping[pair_dofs];
};

/// Adds a traction on the slave and its opposite on the master.
template <class T>
struct Spread {
  int nodes;
  T N[max_side_nodes], M[max_side_nodes], area;
  void add(const T& x, const T& y, T (&to)[pair_dofs]) const {
    const T force[2] = {x * area, y * area};
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < 2; ++i) {
        to[2 * a + i] += N[a] * force[i];
        to[2 * (nodes + a) + i] -= M[a] * force[i];
      }
  }
};

template <class T>
bool integrate(const PairLaw& law, const PairCoordinates& old, const PairCoordinates& now, const Curve<T>& slave_t,
               const Curve<T>& master_t, Forces<T>& forces, PairSums& sums) {
  const int nodes = law.nodes;
  const Curve<double> slave = curve(nodes, now.slave), master = curve(nodes, now.master);
  const Curve<double> slave_old = curve(nodes, old.slave), master_old = curve(nodes, old.master);
  if (dot(slave.node[1] - slave.node[0], master.node[1] - master.node[0]) >= 0) return false;  // back to back
  T from, to;
  if (!segment_end(slave, master, slave_t, master_t, 1.0, from) ||
      !segment_end(slave, master, slave_t, master_t, -1.0, to))
    return false;
  if (!(value(to) - value(from) > 1e-12)) return false;
  const double tiny = 1e-9 * std::sqrt(dot(slave.node[1] - slave.node[0], slave.node[1] - slave.node[0]));
  bool seen = false;
  sums.closest = law.capture;
  for (std::size_t q = 0; q < law.rule.weights.size(); ++q) {
    const T half = 0.5 * (to - from), xi = from + half * (1.0 + law.rule.points[q][0]);
    const Vec<T> at = slave_t.point(xi), along = slave_t.slope(xi);
    Foot<T> foot;
    if (!find_foot(master, master_t, at, foot)) return false;
    if (std::abs(value(foot.gap)) > law.capture) continue;
    seen = true;
    sums.closest = std::min(sums.closest, value(foot.gap));
    const T length = law.rule.weights[q] * half * square_root(dot(along, along));
    const T area = law.axisymmetric ? length * (2 * pi * at.x) : length;
    const T shape[side_multipliers] = {0.5 * (1.0 - xi), 0.5 * (1.0 + xi)};
    const T multiplier = shape[0] * law.normal[0] + shape[1] * law.normal[1];
    T pressure = multiplier - law.penalty * foot.gap;
    const double weight = value(length);
    for (int a = 0; a < side_multipliers; ++a) {
      sums.length[a] += weight * value(shape[a]);
      sums.gap[a] += weight * value(shape[a]) * value(foot.gap);
    }
    // surfaces that meet without overlap have stiffness, but no pull
    const bool open = !(value(pressure) > -law.penalty * tiny);
    if (open && !(law.viscous > 0)) continue;
    if (open) pressure = T(0.0);
    if (value(pressure) < 0) pressure = chain(pressure, 0.0, 1.0);
    Vec<T> was{T(0.0), T(0.0)}, foot_was = was;
    if (law.friction || law.viscous > 0) {
      was = curve_as<T>(slave_old).point(xi);
      foot_was = curve_as<T>(master_old).point(foot.eta);
    }
    const T gap_old = dot(was - foot_was, foot.normal);
    Spread<T> spread{nodes, {}, {}, area};
    slave_t.shapes(xi, spread.N);
    master_t.shapes(foot.eta, spread.M);
    if (law.viscous > 0) {
      const T before = shape[0] * law.pressure_old[0] + shape[1] * law.pressure_old[1];
      const T mean = law.start_weight * (value(before) > 0 ? before : T(0.0)) + (1 - law.start_weight) * pressure;
      const ContactDamping damping = contact_damping(law.viscous, value(gap_old), value(foot.gap), law.dt);
      const T size = chain(foot.gap - gap_old, damping.factor, damping.slope) * mean;
      spread.add(size * foot.normal.x, size * foot.normal.y, forces.damping);
      sums.damped += value(size) * value(area) * (value(gap_old) - value(foot.gap));
    }
    if (open) continue;
    Shear<T> shear;
    const T start = shape[0] * law.shear[0] + shape[1] * law.shear[1];
    if (law.friction) {
      T travel = dot((at - was) - (master_t.point(foot.eta) - foot_was), foot.along);
      // a point that was open counts what it travelled after it touched, as if the gap had closed evenly
      if (value(multiplier) == 0 && value(gap_old) > 0) travel = travel * foot.gap / (foot.gap - gap_old);
      shear = shear_stress(law, start, pressure, travel, {value(was.x), value(was.y)});
    }
    spread.add(pressure * foot.normal.x + shear.stress * foot.along.x,
               pressure * foot.normal.y + shear.stress * foot.along.y, forces.end);
    for (int a = 0; a < side_multipliers; ++a) {
      sums.pressure[a] += weight * value(shape[a]) * value(pressure);
      sums.shear[a] += weight * value(shape[a]) * value(shear.stress);
      if (law.friction && !shear.slides)
        sums.stretch[a] += weight * value(shape[a]) * (value(shear.stress) - value(start));
      for (int b = 0; b < side_multipliers; ++b) sums.touching[a][b] += weight * value(shape[a]) * value(shape[b]);
    }
    sums.area += value(area);
    sums.heat += std::abs(value(shear.stress)) * shear.slip * value(area);
    sums.deepest = std::min(sums.deepest, value(foot.gap));
    if (shear.slides) sums.sliding += weight;
  }
  return seen;
}

}  // namespace

bool pair_segment(const PairLaw& law, const PairCoordinates& old, const PairCoordinates& now, bool want_tangent,
                  PairForce& out) {
  out = {};
  const int half = 2 * law.nodes;
  if (!want_tangent) {
    Forces<double> forces;
    if (!integrate(law, old, now, curve(law.nodes, now.slave), curve(law.nodes, now.master), forces, out.sums))
      return false;
    std::copy_n(forces.end, 2 * half, out.f);
    std::copy_n(forces.damping, 2 * half, out.damping);
    return true;
  }
  using T = Dual<pair_dofs>;
  Forces<T> forces;
  if (!integrate(law, old, now, variable_curve<pair_dofs>(law.nodes, now.slave, 0),
                 variable_curve<pair_dofs>(law.nodes, now.master, half), forces, out.sums))
    return false;
  const double weight = 1 / (1 - law.start_weight);
  for (int a = 0; a < 2 * half; ++a) {
    out.f[a] = value(forces.end[a]);
    out.damping[a] = value(forces.damping[a]);
    const T acting = forces.end[a] + weight * forces.damping[a];
    std::copy_n(acting.d, 2 * half, out.k[a]);
  }
  return true;
}

}  // namespace mudline
