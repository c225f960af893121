#pragma once

#include <type_traits>
#include <vector>

#include "contact/laws/contact_point.hpp"
#include "contact/parts/film_law.hpp"

namespace mudline {

/// A point of the slave in a step, before the point law is asked.
struct PointInStep {
  const ContactPointLaw& law;
  const SideFilm& film;
  const std::vector<int>& candidates;  // pieces of the target
  double capture = 0;                  // [m]
  ConstCoordinateView x_old, x;        // [m] of the mesh, at both ends of the step
  Point place_old{}, place{};          // [m] of the point there
  Point outward{};                     // direction out of the slave
  PointHistory old = {};
  double area = 0, area_old = 0;       // [m2]
  const double* area_slope = nullptr;  // [m] by the positions of the side's nodes (node, axis); null: it is constant
  double far = 0;                      // [m] from the origin: size of the numbers that cancel in the gap
  double pore_pressure = 0;            // [Pa] of the slave at the point
  int nodes = 0, pressures = 0;        // of the side; those that carry pore pressure
  const double *shape = nullptr, *pressure_shape = nullptr;  // at the point
  const double* old_columns = nullptr;                       // of the target, in the row of the committed state
  const double* leaving = nullptr;                           // [N] old forces on the target's dofs; null: none on these
  /// [m] Points nearer than this count as pressing and sticking in the tangent, not in the force: a body without
  /// inertia that touches nothing yet would have no stiffness at all.
  double reach = 0;
  double reach_share = 1;                 // of the penalty that such points have in the tangent
  const Point* pressure_slope = nullptr;  // [1/m] gradients of the pressure's shapes along the side, for a film
  Point drive{};                          // [Pa/m] gradient of the film's pressure less the water's weight
};

/// Forces between one side of the slave and one piece of the target, by their dofs: displacements of the side's nodes,
/// node after node; dofs of the piece; pore pressures of the side's first nodes, whose rows are the water that leaves
/// the slave [m3/s] into a film.
struct SideAction {
  static constexpr int most = 63;  // dofs: of two faces of nine nodes, and nine pressures
  int slave = 0, target = 0, pressures = 0;
  bool tangent = false;
  double f[most];          // at the end of the step
  double later[most];      // to be added at the alpha level: shares of impacts, damping
  double k[most * most];   // (dof, dof) of f + later / (1 - start_weight), in rows of pressures of f
  double area;             // [m2] of all points
  double cancelled[most];  // sizes before they cancelled in gaps, see ResidualView

  int dofs() const { return slave + target + pressures; }
  int first_pressure() const { return slave + target; }
  void open(int slave_dofs, int target_dofs, int pressure_dofs) {
    slave = slave_dofs;
    target = target_dofs;
    pressures = pressure_dofs;
    area = 0;
    for (int a = 0; a < dofs(); ++a) f[a] = later[a] = cancelled[a] = 0;
    for (int i = 0; tangent && i < dofs() * dofs(); ++i) k[i] = 0;
  }
};

/// Whether the response of a point with this gap depends on the start of the step.
inline bool looks_back(const PointInStep& point, double gap) {
  if (point.law.conserves || point.law.viscous > 0 || point.film.flows) return true;
  return point.law.friction && gap - point.old.shift < point.law.touch;
}

/// A vector perpendicular to `from` after the smallest rotation that takes `from` to `to`; both are unit vectors.
template <class T>
Vec<T, 3> transported(const Vec<T, 3>& v, const Vec<T, 3>& from, const Vec<T, 3>& to) {
  const T both = 1.0 + dot(from, to), part = dot(v, to);
  constexpr double opposite = 1e-6;  // the point has gone round the target: the rotation is not unique
  if (value(both) < opposite) return v - to * part;
  return v - (from + to) * (part / both);
}

/// Evaluation of a point against what it sees of a target, `Seen`, as numbers of type T, in D dimensions: its pressure
/// t along the target's normal n and shear stress s give f_a = N_a (t n + s) A on the side's nodes, and the opposite on
/// the target's dofs. With a film t is the sum of the normal law's pressure and the pore pressure; a film takes the
/// rate of its water from the soil, and conducts h^3/(12 viscosity) (gradient of its pressure less the water's weight),
/// with gradients along the side as it was at the start of the step.
///
/// All depends on the displacement d of the point against the target's material at its closest point, the first D of
/// Seen::motions numbers; what the others are is the target's affair. After them come the point's area and its pore
/// pressure. Seen has `gap` [m, counted], `normal`, and the functions
///   look_back(point)            finds its gap at the start of the step, `gap_old` [m, counted];
///   start(point, motion)        sets travel, old shear stress and gap before touch, for friction;
///   sliding(), traction(shear)  d along the surface; the vector of a shear stress;
///   forces(force, f)            forces on the target's dofs, of the force on the point;
///   spread(number, column)      derivatives of a number by the target's dofs;
///   weight(dof)                 of a dof of the target in the gap;
///   rounding(weight)            share of the rounding of the gap that counts at a dof of this weight.
template <class T, int D, class Seen>
class PointAction {
 public:
  PointAction(const PointInStep& point, Seen& seen, SideAction& to)
      : point_(point),
        seen_(seen),
        to_(to),
        area_(unknown<T>(point.area, Seen::motions)),
        pore_pressure_(unknown<T>(point.pore_pressure, Seen::motions + 1)) {}

  ContactPoint evaluate() {
    const ContactPointLaw& law = point_.law;
    const ContactMotion<T, D> motion = in_motion();
    ContactResponse<T, D> now = respond(law, motion);
    const bool reached = !now.presses && point_.reach > 0 && value(seen_.gap) < point_.reach;
    if (reached) add_stiffness_of_touch(now);
    ContactPoint result{};
    result.gap = value(seen_.gap);
    result.pressure = value(now.pressure);
    result.area = point_.area;
    result.active = now.presses && (point_.film.acts || result.pressure > 0);
    result.normal = plain(seen_.normal);
    result.damped = now.damping_heat;
    const ShearState& old = point_.old.shear;  // slip and heat stay when the shear stress goes
    result.shear = {plain_shear(now.shear), old.slip + now.slip, old.dissipated + now.heat, now.slides};
    if (point_.film.acts) add_film(result);
    if (now.presses || reached || law.conserves || law.viscous > 0 || point_.film.acts) add_forces(now, result);
    to_.area += result.area;
    return result;
  }

 private:
  static constexpr bool tangent = !std::is_same_v<T, double>;

  ContactMotion<T, D> in_motion() {
    const PointHistory& old = point_.old;
    ContactMotion<T, D> motion;
    motion.gap = seen_.gap;
    motion.area = area_;
    motion.shift = T(old.shift);
    motion.soil = old.soil;
    motion.pore_pressure = pore_pressure_;
    if (!looks_back(point_, value(seen_.gap))) return motion;
    seen_.look_back(point_);
    motion.position = point_.place_old;
    motion.gap_old = T(seen_.gap_old);
    motion.force_old = T(old.normal_force);
    if (!point_.law.friction || !presses(point_.law, motion)) return motion;
    motion.slip_old = old.shear.slip;
    seen_.start(point_, motion);
    return motion;
  }

  static Point plain_shear(const Tangential<T, D>& shear) {
    if constexpr (D == 2)
      return {value(shear), 0, 0};
    else
      return plain(shear);
  }

  /// A point that a body is about to touch has no force, but the stiffness of one that presses. With friction it also
  /// sticks: without traction it has no strength, and sides that spread under the body would all slide at the first
  /// guess, then be dragged back too far, and oscillate.
  void add_stiffness_of_touch(ContactResponse<T, D>& now) const {
    const double stiffness = point_.reach_share * point_.law.penalty;
    now.pressure = now.pressure + chain(seen_.gap, 0.0, -stiffness);
    if (point_.law.friction) now.shear = now.shear - seen_.sliding() * (point_.law.tangential_factor * stiffness);
  }

  /// Adds the forces of a response at the end of the step, and those that complete the mean over the step.
  void add_forces(const ContactResponse<T, D>& now, ContactPoint& result) {
    const ContactPointLaw& law = point_.law;
    const Vec<T, D> friction = seen_.traction(now.shear * area_),
                    force = seen_.normal * (now.pressure * area_) + friction, damping = seen_.normal * now.damping;
    const bool more = law.conserves || law.viscous > 0;
    Vec<T, D> above = Vec<T, D>::zero();
    T sooner(0.0);
    const double cancelled = now.presses ? law.penalty * point_.area * point_.far : 0.0;
    if (law.conserves) {
      above = force * (now.end_share - (1 - law.start_weight));
      sooner = now.start_share - law.start_weight;
    }
    if (law.viscous > 0) above += damping;
    for (int i = 0; i < D; ++i) {
      const T later = point_.leaving ? above[i] + point_.old.force[i] * sooner : above[i];
      take(force[i], later);
      for (int a = 0; a < point_.nodes; ++a) {
        if (point_.shape[a] != 0) put(D * a + i, point_.shape[a], force[i], later);
        to_.cancelled[D * a + i] += seen_.rounding(point_.shape[a]) * cancelled;
      }
    }
    T end[Seen::most_dofs], later[Seen::most_dofs];
    seen_.forces(force, end);
    if (more) seen_.forces(above, later);
    for (int r = 0; r < to_.target; ++r) {
      if (!more) later[r] = T(0.0);
      if (point_.leaving) later[r] += point_.leaving[r] * sooner;
      take(end[r], later[r]);
      put(to_.slave + r, 1.0, end[r], later[r]);
      to_.cancelled[to_.slave + r] += seen_.rounding(seen_.weight(r)) * cancelled;
    }
    result.force = plain(force);
    result.friction = plain(friction);
    result.damping = plain(damping);
  }

  /// Adds the film's water, which fills the growing gap or flows along the side. Its rates go into the rows of the pore
  /// pressures; its water, vapour and force into `result`.
  void add_film(ContactPoint& result) {
    const FilmWater<T> film(point_.film, point_.old, seen_.gap, seen_.gap_old, area_, point_.area_old, pore_pressure_,
                            point_.law.dt);
    result.water = value(film.water) * result.area;
    result.vapour = value(film.vapour);
    for (int i = 0; i < D; ++i) result.film[i] = result.normal[i] * point_.pore_pressure * result.area;
    if (!point_.film.flows) return;
    const int first = to_.first_pressure();
    const Point* const slope = point_.pressure_slope;
    for (int a = 0; a < point_.pressures; ++a) {
      const T flow = film.growth * point_.pressure_shape[a] + film.conduction * dot(slope[a], point_.drive);
      take(flow, T(0.0));
      put(first + a, 1.0, flow, T(0.0));
      for (int b = 0; tangent && b < point_.pressures; ++b)
        to_.k[(first + a) * to_.dofs() + first + b] += value(film.conduction) * dot(slope[a], slope[b]);
    }
  }

  /// Prepares put(): derivatives, by the dofs, of a force at the end of the step and what completes it.
  void take(const T& end, const T& later) {
    if constexpr (tangent) {
      const T number = end + 1 / (1 - point_.law.start_weight) * later;
      const double* const d = number.d;
      for (int b = 0; b < point_.nodes; ++b)
        for (int j = 0; j < D; ++j) {
          column_[D * b + j] = point_.shape[b] * d[j];
          if (point_.area_slope) column_[D * b + j] += d[Seen::motions] * point_.area_slope[D * b + j];
        }
      seen_.spread(number, column_ + to_.slave);
      for (int b = 0; b < to_.pressures; ++b)
        column_[to_.first_pressure() + b] = point_.pressure_shape[b] * d[Seen::motions + 1];
    }
  }
  void put(int row, double share, const T& end, const T& later) {
    to_.f[row] += share * value(end);
    to_.later[row] += share * value(later);
    if constexpr (tangent) {
      double* const to = &to_.k[row * to_.dofs()];
      for (int b = 0; b < to_.dofs(); ++b) to[b] += share * column_[b];
    }
  }

  const PointInStep& point_;
  Seen& seen_;
  SideAction& to_;
  T area_, pore_pressure_;
  double column_[tangent ? SideAction::most : 1];
};

/// Evaluates a point against what it sees of a target, Seen(of_target, point, place), with derivatives where a tangent
/// is asked for.
template <template <class, int> class Seen, int D, class OfTarget, class Place>
ContactPoint act_on(const OfTarget& of_target, const PointInStep& point, const Place& place, SideAction& to) {
  const auto evaluated = [&](auto number) {
    using T = decltype(number);
    Seen<T, D> seen(of_target, point, place);
    return PointAction<T, D, Seen<T, D>>(point, seen, to).evaluate();
  };
  return to.tangent ? evaluated(Dual<Seen<double, D>::motions + 2>()) : evaluated(0.0);
}

}  // namespace mudline
