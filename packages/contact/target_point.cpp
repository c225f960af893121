#include "contact/target_point.hpp"

#include <algorithm>
#include <type_traits>

namespace mudline {

namespace {

using Number = Dual<TargetForce::unknowns>;

/// A number with its derivatives by the motions.
template <class T>
T number(double value, const double* slope) {
  T result(value);
  if constexpr (!std::is_same_v<T, double>) std::copy_n(slope, ClosestPoint::motions, result.d);
  return result;
}

template <class T, int D>
Vec<T, D> constant(const Point& x) {
  Vec<T, D> result;
  for (int i = 0; i < D; ++i) result[i] = T(x[i]);
  return result;
}

template <class T, int D>
Point plain(const Vec<T, D>& a) {
  Point result{};
  for (int i = 0; i < D; ++i) result[i] = value(a[i]);
  return result;
}

/// The part of the point's geometry that depends on motions. `along`: in the plane the direction of travel.
template <class T, int D>
struct Geometry {
  explicit Geometry(const TargetPoint& point) {
    const ClosestPoint& at = point.closest;
    gap = number<T>(at.gap, at.gap_slope) - point.old.offset;
    for (int i = 0; i < D; ++i) normal[i] = number<T>(at.normal[i], at.normal_slope[i]);
    if constexpr (D == 2) along = {-1.0 * normal[1], normal[0]};
  }
  /// Vector from the closest point's material to the point at the start of the step [m].
  Vec<T, D> apart_old(const TargetPoint& point) const {
    const ClosestPoint& at = point.closest;
    Vec<T, D> result = constant<T, D>(point.place_old);
    for (int a = 0; a < at.nodes; ++a) {
      const T weight = number<T>(at.weight[a], at.weight_slope[a]);
      for (int i = 0; i < D; ++i) result[i] -= weight * point.target_old[a][i];
    }
    return result;
  }
  T gap;  // [m] counted
  Vec<T, D> normal, along;
};

/// A vector perpendicular to `from` after the smallest rotation that takes `from` to `to`; both are unit vectors.
template <class T>
Vec<T, 3> transported(const Point& v, const Point& from, const Vec<T, 3>& to) {
  const Vec<T, 3> old = constant<T, 3>(from), shear = constant<T, 3>(v);
  const T both = 1.0 + dot(old, to), part = dot(shear, to);
  constexpr double opposite = 1e-6;
  if (value(both) < opposite) return shear - to * part;
  return shear - (old + to) * (part / both);
}

template <class T, int D>
ContactMotion<T, D> motion_of(const TargetPoint& point, const Geometry<T, D>& at) {
  const PointHistory& old = point.old;
  ContactMotion<T, D> motion;
  motion.gap = at.gap;
  motion.shift = T(old.shift);
  motion.gap_old = T(point.gap_old);
  motion.force_old = T(old.normal_force);
  motion.area = T(point.area);
  motion.soil = old.soil;
  motion.pore_pressure = T(point.pore_pressure);
  if constexpr (!std::is_same_v<T, double>) motion.pore_pressure.d[ClosestPoint::motions] = 1;
  if (!point.law.friction || !presses(point.law, motion)) return motion;
  const Vec<T, D> apart = at.apart_old(point);
  if (old.shift == 0) motion.opened = dot(apart, at.normal) - old.offset;
  if constexpr (D == 2) {
    motion.travel = -1.0 * dot(at.along, apart);
    motion.shear_old = T(old.shear.shear[0]);
  } else {
    motion.travel = at.normal * dot(at.normal, apart) - apart;
    motion.shear_old = transported(old.shear.shear, point.normal_old, at.normal);
  }
  motion.slip_old = old.shear.slip;
  motion.slid = D == 3 && old.shear.slides;
  motion.position = point.place_old;
  return motion;
}

template <class T>
void add_water(const TargetPoint& point, const T& gap, const T& pore_pressure, TargetForce& out) {
  const FilmWater<T> film(point.film, point.old, gap, point.gap_old, T(point.area), point.area, pore_pressure,
                          point.law.dt);
  out.point.water = value(film.water) * point.area;
  out.point.vapour = value(film.vapour);
  out.growth = value(film.growth);
  out.conduction = value(film.conduction);
  if constexpr (!std::is_same_v<T, double>) {
    std::copy_n(film.growth.d, TargetForce::unknowns, out.growth_slope);
    std::copy_n(film.conduction.d, TargetForce::unknowns, out.conduction_slope);
  }
}

template <class T, int D>
TargetForce evaluate(const TargetPoint& point) {
  const Geometry<T, D> at(point);
  const ContactMotion<T, D> motion = motion_of(point, at);
  const ContactResponse<T, D> now = respond(point.law, motion);
  const double weight = 1 / (1 - point.law.start_weight);
  const T share = now.end_share * weight;
  Vec<T, D> force = Vec<T, D>::zero(), friction = force, damping = force;
  const bool acts = now.presses || point.film.acts;
  if (acts) {
    if constexpr (D == 2)
      friction = at.along * now.shear * point.area;
    else
      friction = now.shear * point.area;
    force = at.normal * now.pressure * point.area + friction;
  }
  if (point.law.viscous > 0) damping = at.normal * now.damping;
  const Vec<T, D> acting = force * share + damping * weight;

  TargetForce out;
  ContactPoint& result = out.point;
  result.gap = value(at.gap);
  result.pressure = value(now.pressure);
  result.active = now.presses && (point.film.acts || result.pressure > 0);
  result.area = point.area;
  result.total.force = plain(force);
  result.friction = plain(friction);
  result.damping = plain(damping);
  result.damped = now.damping_heat;
  const ShearState& old = point.old.shear;
  result.shear = {{}, old.slip + now.slip, old.dissipated + now.heat, now.slides};
  if constexpr (D == 2)
    result.shear.shear[0] = value(now.shear);
  else
    result.shear.shear = plain(now.shear);
  out.acts = acts;
  out.acting = plain(acting);
  out.start_share = value(now.start_share);
  if (acts) out.share = value(share);
  if constexpr (!std::is_same_v<T, double>) {
    for (int i = 0; i < D; ++i) std::copy_n(acting[i].d, TargetForce::unknowns, out.acting_slope[i]);
    std::copy_n(now.start_share.d, TargetForce::unknowns, out.start_share_slope);
  }
  if (point.film.acts) add_water(point, at.gap, motion.pore_pressure, out);
  for (int i = 0; point.film.acts && i < D; ++i)
    result.film[i] = value(at.normal[i]) * point.pore_pressure * point.area;
  return out;
}

}  // namespace

template <int D>
TargetForce target_force(const TargetPoint& point, bool want_tangent) {
  return want_tangent ? evaluate<Number, D>(point) : evaluate<double, D>(point);
}
template TargetForce target_force<2>(const TargetPoint& point, bool want_tangent);
template TargetForce target_force<3>(const TargetPoint& point, bool want_tangent);

}  // namespace mudline
