#include "contact/body/penalty_side.hpp"

#include <cmath>
#include <type_traits>

#include "contact/body/body_projection.hpp"
#include "core/caught_in_kernel.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

template <int D>
constexpr int max_side_dofs = D == 2 ? 3 * max_line_nodes + 3 : 4 * max_side_nodes + 6;

/// Forces of one side [N] on the soil and on the body, and their derivatives [N/m, m2].
template <class T, int D>
struct SideForce {
  static constexpr bool tangent = !std::is_same_v<T, double>;
  int dofs;
  double f[max_side_dofs<D>];           // at the end of the step
  double correction[max_side_dofs<D>];  // to be added at the alpha level: shares of impacts, damping
  double k[tangent ? max_side_dofs<D> * max_side_dofs<D>
                   : 1];  // (dof, dof) of f + correction / (1 - start_weight), in rows of pressures of f

  explicit SideForce(int dofs_) : dofs(dofs_) {
    for (int a = 0; a < dofs; ++a) f[a] = correction[a] = 0;
    if constexpr (tangent)
      for (int i = 0; i < dofs * dofs; ++i) k[i] = 0;
  }
};

/// Areas of the contact points [m2] and their derivatives by the nodes' places [m] (node, axis).
template <int D>
struct SideAreas {
  static constexpr int places = D * (D == 2 ? max_line_nodes : max_side_nodes);
  double area[max_contact_points], slope[max_contact_points][places];
  double old[max_contact_points];  // at the start of the step, with a film

  bool measure(const ContactSides& on, const SideContact& side, bool want_slopes) {
    if (side.film.acts && !contact_areas<D>(on.rule, side.x_old, on.geometry, old)) return false;
    if (!want_slopes) return contact_areas<D>(on.rule, side.x, on.geometry, area);
    Vec<Dual<places>, D> node[max_side_nodes];
    for (int a = 0; a < on.rule.nodes; ++a)
      for (int i = 0; i < D; ++i) node[a][i] = Dual<places>(side.x[a][i], D * a + i);
    Dual<places> numbers[max_contact_points];
    if (!contact_areas<D>(on.rule, node, on.geometry, numbers)) return false;
    for (int c = 0; c < on.rule.points; ++c) {
      area[c] = numbers[c].v;
      for (int i = 0; i < places; ++i) slope[c][i] = numbers[c].d[i];
    }
    return true;
  }
};

/// Force on the soil, and moment about the body's centre conjugate to the body's rotations, as numbers of type T.
template <class T, int D>
struct PointAction {
  Vec<T, D> force = Vec<T, D>::zero();
  Tangential<T, D> moment = no_tangential<T, D>();
  void add(const Vec<T, D>& more, const Tangential<T, D>& turning) {
    force = force + more;
    moment = moment + turning;
  }
  /// Component by direction of the body's unknown.
  T operator[](int direction) const {
    if (direction < D) return force[direction];
    if constexpr (D == 2)
      return moment;
    else
      return moment[direction - D];
  }
};

/// Shape functions of the pore pressure at point c, for the nodes that carry it.
const double* pressure_shape(const ContactSides& on, const SideContact& side, int c) {
  const bool corners = side.pressure_nodes < on.rule.nodes;
  return corners ? &on.rule.corner(c, 0) : &on.rule.shape(c, 0);
}

double pore_pressure(const ContactSides& on, const SideContact& side, int c) {
  double result = on.starts(side.first + c).soil.pore_pressure;
  for (int a = 0; a < side.pressure_nodes; ++a) result += pressure_shape(on, side, c)[a] * side.pressure[a];
  return result;
}

/// The closest point of a point, with the gap that counts.
template <class T, int D>
BodyProjection<T, D> counted_projection(const ContactStart& start, const PointNumbers<T, D>& x) {
  BodyProjection<T, D> projection(start.now, x);
  projection.gap = projection.gap - start.offset;
  return projection;
}

template <class T, int D>
ContactMotion<T, D> motion_of_point(const ContactSides& on, const SideContact& side, int c, const PointNumbers<T, D>& x,
                                    const BodyProjection<T, D>& projection) {
  const ContactStart& start = on.starts(side.first + c);
  ContactMotion<T, D> motion;
  motion.gap = projection.gap;
  motion.area = x.area;
  motion.shift = T(start.shift);
  motion.soil = start.soil;
  motion.pore_pressure = x.pore_pressure;
  if (!looks_back(side, start.shift, value(projection.gap))) return motion;
  motion.position = on.rule.place(c, side.x_old);
  motion.gap_old = T(start.before.gap - start.offset);
  motion.force_old = T(start.normal_force);
  if (!side.law.friction || !presses(side.law, motion)) return motion;
  motion.opened = T(start.before.gap - start.offset - start.shift_old);
  projection.start(on.body, start, motion);
  motion.slip_old = start.shear.slip;
  motion.slid = start.shear.slides;
  return motion;
}

template <class T, int D>
void keep(const Vec<T, D>& force, const Tangential<T, D>& moment, PointForce& to) {
  for (int i = 0; i < D; ++i) to.force[i] = value(force[i]);
  if constexpr (D == 2)
    to.moment[2] = value(moment);
  else
    for (int i = 0; i < D; ++i) to.moment[i] = value(moment[i]);
}

/// Forces of a point's response: at the end of the step, and the addition to the mean over the step.
template <class T, int D>
void act(const ContactSides& on, const SideContact& side, int c, const PointNumbers<T, D>& x,
         const BodyProjection<T, D>& projection, const ContactResponse<T, D>& now, ContactPoint& point,
         PointAction<T, D>& end, PointAction<T, D>& more) {
  const PointForce& before = on.starts(side.first + c).force;
  const Vec<T, D> friction = projection.traction(now.shear * x.area),
                  force = projection.normal * (now.pressure * x.area) + friction,
                  damping = projection.normal * now.damping;
  const auto in_space = cross(x.from_centre, force);
  const auto moment = projection.body_moment(in_space, on.body.now);
  end.add(force, moment);
  if (side.law.conserves) {
    PointAction<T, D> old;
    for (int i = 0; i < D; ++i) old.force[i] = T(before.force[i]);
    old.moment = BodyProjection<T, D>::old_body_moment(before.moment, on.body.old);
    const T later = now.end_share - (1 - side.law.start_weight), sooner = now.start_share - side.law.start_weight;
    more.add(force * later, moment * later);
    more.add(old.force * sooner, old.moment * sooner);
  }
  if (side.law.viscous > 0) more.add(damping, projection.body_moment(cross(x.from_centre, damping), on.body.now));
  keep<T, D>(force, in_space, point.total);
  for (int i = 0; i < D; ++i) {
    point.friction[i] = value(friction[i]);
    point.damping[i] = value(damping[i]);
  }
}

/// Derivatives of a number of point c by the dofs of the side. D: dimension.
template <class T, int D>
void spread(const ContactSides& on, const SideContact& side, int c, const SideAreas<D>& areas, const T& number,
            double* column) {
  using X = PointNumbers<T, D>;
  const BodyUnknowns& body = on.body.unknowns;
  const int nodes = on.rule.nodes, pressures = D * nodes, first_body = pressures + side.pressure_nodes;
  const double* d = number.d;
  for (int b = 0; b < nodes; ++b)
    for (int j = 0; j < D; ++j)
      column[D * b + j] = on.rule.shape(c, b) * d[j] + d[X::of_area] * areas.slope[c][D * b + j];
  for (int b = 0; b < side.pressure_nodes; ++b)
    column[pressures + b] = pressure_shape(on, side, c)[b] * d[X::of_pressure];
  for (int k = 0; k < body.count; ++k) column[first_body + k] = d[X::of_body + k];
}

/// Adds the actions of point c to the side's forces and tangent.
template <class T, int D>
void add_to_side(const ContactSides& on, const SideContact& side, int c, const SideAreas<D>& areas,
                 const PointAction<T, D>& end, const PointAction<T, D>& more, SideForce<T, D>& out) {
  const BodyUnknowns& body = on.body.unknowns;
  const int nodes = on.rule.nodes, first_body = D * nodes + side.pressure_nodes;
  const double weight = 1 / (1 - side.law.start_weight);
  for (int r = 0; r < D + body.count; ++r) {
    const int direction = r < D ? r : body.direction[r - D];
    const double sign = r < D ? 1.0 : -body.scale[r - D];
    const T last = end[direction], above = more[direction];
    double column[max_side_dofs<D>];
    if constexpr (!std::is_same_v<T, double>) spread<T, D>(on, side, c, areas, sign * (last + weight * above), column);
    for (int a = 0; a < (r < D ? nodes : 1); ++a) {
      const int row = r < D ? D * a + r : first_body + r - D;
      const double share = r < D ? on.rule.shape(c, a) : 1.0;
      out.f[row] += share * sign * value(last);
      out.correction[row] += share * sign * value(above);
      if constexpr (!std::is_same_v<T, double>)
        for (int b = 0; b < out.dofs; ++b) out.k[row * out.dofs + b] += share * column[b];
    }
  }
}

/// Adds the film's water at point c, which fills the growing gap or flows along the side. Its rates go into the rows of
/// the pore pressures; its water, vapour and force into `point`.
template <class T, int D>
void add_film(const ContactSides& on, const SideContact& side, int c, const SideAreas<D>& areas,
              const PointNumbers<T, D>& x, const BodyProjection<T, D>& projection, double gap_old, ContactPoint& point,
              SideForce<T, D>& out) {
  const SideFilm& film = side.film;
  const ContactStart& start = on.starts(side.first + c);
  const FilmWater<T> at(film, start, projection.gap, gap_old, x.area, areas.old[c], x.pore_pressure, side.law.dt);
  point.water = value(at.water) * point.area;
  point.vapour = value(at.vapour);
  for (int i = 0; i < D; ++i) point.film[i] = value(projection.normal[i]) * value(x.pore_pressure) * point.area;
  if (!film.flows) return;
  Point slope[max_side_nodes], drive = -film.weight;
  pressure_slopes<D>(on.rule, c, side.x_old, side.pressure_nodes, slope);
  for (int a = 0; a < side.pressure_nodes; ++a) drive += side.pressure[a] * slope[a];
  const int first = D * on.rule.nodes;
  for (int a = 0; a < side.pressure_nodes; ++a) {
    const double share = pressure_shape(on, side, c)[a];
    const T flow = at.growth * share + at.conduction * dot(slope[a], drive);
    out.f[first + a] += value(flow);
    if constexpr (!std::is_same_v<T, double>) {
      double column[max_side_dofs<D>], *row = &out.k[(first + a) * out.dofs];
      spread<T, D>(on, side, c, areas, flow, column);
      for (int b = 0; b < out.dofs; ++b) row[b] += column[b];
      for (int b = 0; b < side.pressure_nodes; ++b) row[first + b] += value(at.conduction) * dot(slope[a], slope[b]);
    }
  }
}

/// A point that the body is about to touch has no force, but the stiffness of one that presses. With friction it also
/// sticks: without traction it has no strength, and sides that spread under the body would all slide at the first
/// guess, then be dragged back too far, and oscillate.
template <class T, int D>
void add_stiffness_of_touch(const SideContact& side, const BodyProjection<T, D>& projection,
                            ContactResponse<T, D>& now) {
  const double stiffness = side.reach_share * side.law.penalty;
  now.pressure = now.pressure + chain(projection.gap, 0.0, -stiffness);
  if (side.law.friction) now.shear = now.shear - projection.sliding() * (side.law.tangential_factor * stiffness);
}

template <class T, int D>
ContactPoint evaluate_point(const ContactSides& on, const SideContact& side, int c, const SideAreas<D>& areas,
                            SideForce<T, D>& out) {
  const ContactStart& start = on.starts(side.first + c);
  const PointNumbers<T, D> x(on.body, on.rule.place(c, side.x), areas.area[c], pore_pressure(on, side, c));
  const BodyProjection<T, D> projection = counted_projection(start, x);
  const ContactMotion<T, D> motion = motion_of_point(on, side, c, x, projection);
  ContactResponse<T, D> now = respond(side.law, motion);
  const bool reached = !now.presses && value(projection.gap) < side.reach;
  if (reached) add_stiffness_of_touch(side, projection, now);
  ContactPoint point{};
  point.gap = value(projection.gap);
  point.pressure = value(now.pressure);
  point.area = areas.area[c];
  point.active = now.presses;
  point.height = start.height;
  point.damped = now.damping_heat;
  const ShearState& old = start.shear;  // slip and heat stay when the shear stress goes
  point.shear = {BodyProjection<T, D>::plain_shear(now.shear), old.slip + now.slip, old.dissipated + now.heat,
                 now.slides};
  if (side.film.acts) add_film<T, D>(on, side, c, areas, x, projection, value(motion.gap_old), point, out);
  if (!now.presses && !reached && !side.law.conserves && !(side.law.viscous > 0) && !side.film.acts) return point;
  PointAction<T, D> end, more;
  act(on, side, c, x, projection, now, point, end, more);
  add_to_side(on, side, c, areas, end, more, out);
  return point;
}

template <int D>
int dofs_of(const ContactSides& on, const SideContact& side) {
  return D * on.rule.nodes + side.pressure_nodes + on.body.unknowns.count;
}

// Kernels over the sides of a shape.

template <int D>
struct SideForces {
  ContactSides on;
  VectorScatter to;
  PointView later;
  CaughtInKernel* caught;  // exception that a law throws

  /// Counts degenerate sides.
  void operator()(int s, int& failed) const {
    to.open(s);
    for (std::size_t a = 0; a < later.extent(1); ++a) later(s, a) = 0;
    const SideContact& side = on.sides(s);
    if (!side.near) return;
    CaughtInKernel::run(caught, [&] {
      failed += !evaluate(s, side);
      return true;
    });
  }

  /// Whether the side is not degenerate.
  bool evaluate(int s, const SideContact& side) const {
    SideForce<double, D> force(dofs_of<D>(on, side));
    SideAreas<D> areas;
    const bool sound = areas.measure(on, side, false);
    double pressing = 0, whole = 0;  // [m2]
    for (int c = 0; c < on.rule.points; ++c) {
      const ContactPoint point = sound ? evaluate_point<double, D>(on, side, c, areas, force) : ContactPoint{};
      on.points(side.first + c) = point;
      pressing += point.active ? point.area : 0;
      whole += point.area;
    }
    add(s, side, force, pressing, whole);
    return sound;
  }

  void add(int s, const SideContact& side, const SideForce<double, D>& force, double pressing, double whole) const {
    double far = 0;  // [m] of a node from the origin
    for (int a = 0; a < on.rule.nodes; ++a) {
      const double distance = std::sqrt(dot(side.x[a], side.x[a]));
      if (distance > far) far = distance;
    }
    const double cancelled = side.law.penalty * pressing * far;
    const int soil = D * on.rule.nodes, first_body = soil + side.pressure_nodes;
    for (int a = 0; a < force.dofs; ++a) {
      if (a >= soil && a < first_body) {  // rate of water into a film, all of it added later
        later(s, a) = -force.f[a];
        if (force.f[a] != 0) to.add(s, a, 0.0, 0.0, whole * far / side.law.dt);
        continue;
      }
      const double size = std::abs(force.f[a]);
      to.add(s, a, -force.f[a], size, size + cancelled);
      later(s, a) = force.correction[a];
    }
  }
};

template <int D>
struct SideTangents {
  ContactSides on;
  MatrixScatter to;
  SideWeights weights;
  CaughtInKernel* caught;

  void operator()(int s) const {
    to.open(s);
    const SideContact& side = on.sides(s);
    if (!side.near) return;
    CaughtInKernel::run(caught, [&] {
      evaluate(s, side);
      return true;
    });
  }

  void evaluate(int s, const SideContact& side) const {
    using T = Dual<PointNumbers<double, D>::unknowns>;
    SideAreas<D> areas;
    if (!areas.measure(on, side, true)) return;
    SideForce<T, D> force(dofs_of<D>(on, side));
    for (int c = 0; c < on.rule.points; ++c) evaluate_point<T, D>(on, side, c, areas, force);
    const int soil = D * on.rule.nodes, first_body = soil + side.pressure_nodes;
    for (int a = 0; a < force.dofs; ++a)
      for (int b = 0; b < force.dofs; ++b) {
        double& entry = force.k[a * force.dofs + b];
        if (a >= soil && a < first_body)
          entry = weights.film ? entry : 0.0;
        else
          entry *= -weights.weight * (b >= soil && b < first_body ? 1.0 : weights.moved);
      }
    to.add(s, force.dofs, force.k);
  }
};

/// The loops run on the host, where the laws are.
using HostRange = Kokkos::RangePolicy<Kokkos::DefaultHostExecutionSpace>;

}  // namespace

int add_side_forces(const ContactSides& on, const RowLists& rows, const VectorScatter& to, const PointView& later) {
  int degenerate = 0;
  CaughtInKernel caught;
  in_order("contact rows", rows, 0, static_cast<int>(on.sides.extent(0)), to,
           [&](int first, int last, const VectorScatter& target) {
             const HostRange range(first, last);
             int here = 0;
             if (on.geometry == Geometry::space)
               Kokkos::parallel_reduce("contact", range, SideForces<3>{on, target, later, &caught}, here);
             else
               Kokkos::parallel_reduce("contact", range, SideForces<2>{on, target, later, &caught}, here);
             degenerate += here;
           });
  caught.rethrow();
  return degenerate;
}

void add_side_tangents(const ContactSides& on, const RowLists& rows, const MatrixScatter& to,
                       const SideWeights& weights) {
  CaughtInKernel caught;
  in_order("contact matrix rows", rows, 0, static_cast<int>(on.sides.extent(0)), to,
           [&](int first, int last, const MatrixScatter& target) {
             const HostRange range(first, last);
             if (on.geometry == Geometry::space)
               Kokkos::parallel_for("contact tangent", range, SideTangents<3>{on, target, weights, &caught});
             else
               Kokkos::parallel_for("contact tangent", range, SideTangents<2>{on, target, weights, &caught});
           });
  caught.rethrow();
}

}  // namespace mudline
