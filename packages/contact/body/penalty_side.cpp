#include "contact/body/penalty_side.hpp"

#include <algorithm>

#include "contact/body/body_foot.hpp"
#include "core/space_vector.hpp"

namespace mudline {

namespace {

constexpr int max_side_dofs = 4 * max_side_nodes + 6;

/// Areas of the contact points [m2] and their derivatives by the nodes' places [m] (node, axis).
template <int D>
struct SideAreas {
  static constexpr int places = D * (D == 2 ? max_line_nodes : max_side_nodes);
  double area[max_contact_points], slope[max_contact_points][places];
  double old[max_contact_points];  // at the start of the step, with a film

  bool measure(const SideContact& side, bool want_slopes) {
    if (side.film.acts && !contact_areas<D>(side.rule, side.x_old, side.geometry, old)) return false;
    if (!want_slopes) return contact_areas<D>(side.rule, side.x, side.geometry, area);
    SpatialVector<Dual<places>, D> node[max_side_nodes];
    for (int a = 0; a < side.rule.nodes; ++a)
      for (int i = 0; i < D; ++i) node[a][i] = Dual<places>(side.x[a][i], D * a + i);
    Dual<places> numbers[max_contact_points];
    if (!contact_areas<D>(side.rule, node, side.geometry, numbers)) return false;
    for (int c = 0; c < side.rule.points; ++c) {
      area[c] = numbers[c].v;
      std::copy_n(numbers[c].d, places, slope[c]);
    }
    return true;
  }
};

/// Force on the soil and moment about the body's centre as the body's unknowns feel it, as numbers.
template <class T, int D>
struct PointAction {
  SpatialVector<T, D> force = SpatialVector<T, D>::zero();
  Tangential<T, D> moment = no_tangential<T, D>();
  void add(const SpatialVector<T, D>& more, const Tangential<T, D>& turning) {
    force = force + more;
    moment = moment + turning;
  }
  /// By direction of the body.
  T operator[](int direction) const {
    if (direction < D) return force[direction];
    if constexpr (D == 2)
      return moment;
    else
      return moment[direction - D];
  }
};

/// Pore pressure's shapes at point c: those of the nodes that carry it.
const double* pressure_shape(const SideContact& side, int c) {
  const bool corners = side.pressure_nodes < side.rule.nodes;
  return corners ? side.rule.corner[c].data() : side.rule.shape[c].data();
}

double pore_pressure(const SideContact& side, int c) {
  double result = side.start[c].soil.pore_pressure;
  for (int a = 0; a < side.pressure_nodes; ++a) result += pressure_shape(side, c)[a] * side.pressure[a];
  return result;
}

template <class T, int D>
ContactMotion<T, D> motion_of_point(const SideContact& side, int c, const PointNumbers<T, D>& x,
                                    const typename BodyFoot<T, D>::Nearest& at, const BodyFoot<T, D>& foot) {
  const ContactStart& start = side.start[c];
  ContactMotion<T, D> motion;
  motion.gap = foot.gap;
  motion.area = x.area;
  motion.shift = T(start.shift);
  motion.member = start.member;
  motion.soil = start.soil;
  motion.pore_pressure = x.pore_pressure;
  const bool shears = side.law.friction && presses(side.law, motion);
  if (!shears && !side.law.conserves && !(side.law.viscous > 0) && !side.film.flows) return motion;
  motion.position = side.rule.place(c, side.x_old);
  const auto before = BodyFoot<T, D>::nearest(side.body, side.placement_old, motion.position);
  motion.gap_old = T(before.gap - start.offset);
  motion.force_old = T(start.normal_force);
  if (!shears) return motion;
  motion.opened = T(before.gap - start.offset - start.shift_old);
  foot.start(side, before, at, start.shear.shear, motion);
  motion.slip_old = start.shear.slip;
  motion.slid = start.shear.slides;
  return motion;
}

template <class T, int D>
void keep(const SpatialVector<T, D>& force, const Tangential<T, D>& moment, PointForce& to) {
  for (int i = 0; i < D; ++i) to.force[i] = value(force[i]);
  if constexpr (D == 2)
    to.moment[2] = value(moment);
  else
    for (int i = 0; i < D; ++i) to.moment[i] = value(moment[i]);
}

/// What a point's response means in forces: at the end of the step, and what comes on top in the mean over it.
template <class T, int D>
void act(const SideContact& side, int c, const PointNumbers<T, D>& x, const BodyFoot<T, D>& foot,
         const ContactResponse<T, D>& now, ContactPoint& point, PointAction<T, D>& end, PointAction<T, D>& more) {
  const SpatialVector<T, D> friction = foot.traction(now.shear * x.area),
                            force = foot.normal * (now.pressure * x.area) + friction,
                            damping = foot.normal * now.damping;
  const auto in_space = cross(x.arm, force);
  const auto moment = foot.felt(in_space, side.placement);
  end.add(force, moment);
  if (side.law.conserves) {
    PointAction<T, D> old;
    for (int i = 0; i < D; ++i) old.force[i] = T(side.start[c].force.force[i]);
    old.moment = BodyFoot<T, D>::felt_before(side.start[c].force.moment, side.placement_old);
    const T later = now.end_share - (1 - side.law.start_weight), sooner = now.start_share - side.law.start_weight;
    more.add(force * later, moment * later);
    more.add(old.force * sooner, old.moment * sooner);
  }
  if (side.law.viscous > 0) more.add(damping, foot.felt(cross(x.arm, damping), side.placement));
  keep<T, D>(force, in_space, point.total);
  for (int i = 0; i < D; ++i) {
    point.friction[i] = value(friction[i]);
    point.damping[i] = value(damping[i]);
  }
}

/// Derivatives of a number of point c by the dofs of the side. D: dimension.
template <class T, int D>
void spread(const SideContact& side, int c, const SideAreas<D>& areas, const T& number, double* column) {
  using X = PointNumbers<T, D>;
  const BodyUnknowns& body = side.body.unknowns();
  const int nodes = side.rule.nodes, pressures = D * nodes, first_body = pressures + side.pressure_nodes;
  const double* d = number.d;
  for (int b = 0; b < nodes; ++b)
    for (int j = 0; j < D; ++j)
      column[D * b + j] = side.rule.shape[c][b] * d[j] + d[X::of_area] * areas.slope[c][D * b + j];
  for (int b = 0; b < side.pressure_nodes; ++b) column[pressures + b] = pressure_shape(side, c)[b] * d[X::of_pressure];
  for (int k = 0; k < body.count; ++k) column[first_body + k] = d[X::of_body + k];
}

/// Adds the actions of point c to the side's forces and tangent.
template <class T, int D>
void add_to_side(const SideContact& side, int c, const SideAreas<D>& areas, const PointAction<T, D>& end,
                 const PointAction<T, D>& more, SideForce& out) {
  const BodyUnknowns& body = side.body.unknowns();
  const int nodes = side.rule.nodes, first_body = D * nodes + side.pressure_nodes;
  const double weight = 1 / (1 - side.law.start_weight);
  const auto& shape = side.rule.shape[c];
  for (int r = 0; r < D + body.count; ++r) {
    const int direction = r < D ? r : body.direction[r - D];
    const double sign = r < D ? 1.0 : -body.scale[r - D];
    const T last = end[direction], above = more[direction];
    double column[max_side_dofs];
    if constexpr (!std::is_same_v<T, double>) spread<T, D>(side, c, areas, sign * (last + weight * above), column);
    for (int a = 0; a < (r < D ? nodes : 1); ++a) {
      const int row = r < D ? D * a + r : first_body + r - D;
      const double share = r < D ? shape[a] : 1.0;
      out.f[row] += share * sign * value(last);
      out.correction[row] += share * sign * value(above);
      if constexpr (!std::is_same_v<T, double>)
        for (int b = 0; b < out.dofs; ++b) out.k[row * out.dofs + b] += share * column[b];
    }
  }
}

/// Gradients along the side [1/m] of the pore pressure's shapes at point c, as the side was at the start of the step.
template <int D>
void pressure_slopes(const SideContact& side, int c, Point* slope) {
  const ContactRule& rule = side.rule;
  const bool corners = side.pressure_nodes < rule.nodes;
  const double* dP = (corners ? rule.corner_slope : rule.shape_slope)[c].data();
  SideMap<D> map;
  map.compute(rule.nodes, rule.shape[c].data(), rule.shape_slope[c].data(),
              [&](int a, int i) { return side.x_old[a][i]; });
  constexpr int K = D - 1;
  double metric[K][K], inverse[K][K];
  for (int k = 0; k < K; ++k)
    for (int l = 0; l < K; ++l) {
      metric[k][l] = 0;
      for (int i = 0; i < D; ++i) metric[k][l] += map.along[k][i] * map.along[l][i];
    }
  if constexpr (K == 1) {
    inverse[0][0] = 1 / metric[0][0];
  } else {
    const double det = metric[0][0] * metric[1][1] - metric[0][1] * metric[1][0];
    for (int k = 0; k < K; ++k)
      for (int l = 0; l < K; ++l) inverse[k][l] = (k == l ? metric[1 - k][1 - k] : -metric[k][l]) / det;
  }
  for (int a = 0; a < side.pressure_nodes; ++a) {
    slope[a] = {};
    for (int k = 0; k < K; ++k)
      for (int l = 0; l < K; ++l)
        for (int i = 0; i < D; ++i) slope[a][i] += inverse[k][l] * dP[K * a + l] * map.along[k][i];
  }
}

/// Thickness of the film [m].
template <class T>
T film_thickness(const T& gap, double aperture) {
  const T root = square_root(gap * gap + 4 * aperture * aperture);
  return value(gap) > 0 ? 0.5 * (gap + root) : T(2 * aperture * aperture) / (root - gap);
}

/// The film's water at point c, which stays where the gap's growth draws it or flows along the side. Its rates go into
/// the rows of the pore pressures; its water, vapour and force into `point`.
template <class T, int D>
void add_film(const SideContact& side, int c, const SideAreas<D>& areas, const PointNumbers<T, D>& x,
              const BodyFoot<T, D>& foot, double gap_old, ContactPoint& point, SideForce& out) {
  const SideFilm& film = side.film;
  const ContactStart& start = side.start[c];
  const T thickness = film_thickness(foot.gap, film.aperture);
  const T lack = start.cavitation - x.pore_pressure;
  const T vapour = value(lack) > 0 ? thickness * lack * (1 / film.softness) : T(0.0), water = thickness - vapour;
  point.water = value(water) * point.area;
  point.vapour = value(vapour);
  for (int i = 0; i < D; ++i) point.film[i] = value(foot.normal[i]) * value(x.pore_pressure) * point.area;
  if (!film.flows) return;
  const double water_old = (film_thickness(gap_old, film.aperture) - start.vapour) * areas.old[c];
  const T growth = (water * x.area - water_old) * (1 / side.law.dt);  // [m3/s]
  const T open = value(water) > 0 ? water : T(0.0);
  const T conduction = open * open * open * (areas.old[c] / (12 * film.viscosity));  // [m5/(Pa s)]
  Point slope[max_side_nodes], drive = scaled(-1, film.weight);
  pressure_slopes<D>(side, c, slope);
  for (int a = 0; a < side.pressure_nodes; ++a) drive = plus(drive, side.pressure[a], slope[a]);
  const int first = D * side.rule.nodes;
  for (int a = 0; a < side.pressure_nodes; ++a) {
    const double share = pressure_shape(side, c)[a];
    const T flow = growth * share + conduction * dot(slope[a], drive);
    out.f[first + a] += value(flow);
    if constexpr (!std::is_same_v<T, double>) {
      double column[max_side_dofs], *row = &out.k[(first + a) * out.dofs];
      spread<T, D>(side, c, areas, flow, column);
      for (int b = 0; b < out.dofs; ++b) row[b] += column[b];
      for (int b = 0; b < side.pressure_nodes; ++b) row[first + b] += value(conduction) * dot(slope[a], slope[b]);
    }
  }
}

template <class T, int D>
ContactPoint evaluate_point(const SideContact& side, int c, const SideAreas<D>& areas, SideForce& out) {
  const Point at = side.rule.place(c, side.x);
  const PointNumbers<T, D> x(side, at, areas.area[c], pore_pressure(side, c));
  const auto nearest = BodyFoot<T, D>::nearest(side.body, side.placement, at);
  BodyFoot<T, D> foot(nearest, x);
  foot.gap = foot.gap - side.start[c].offset;  // from here on only what counts
  const ContactMotion<T, D> motion = motion_of_point(side, c, x, nearest, foot);
  ContactResponse<T, D> now = respond(side.law, motion);
  const bool reached = !now.presses && value(foot.gap) < side.reach;
  if (reached) now.pressure = now.pressure + chain(foot.gap, 0.0, -side.reach_share * side.law.penalty);
  ContactPoint point{};
  point.gap = value(foot.gap);
  point.pressure = value(now.pressure);
  point.area = areas.area[c];
  point.active = now.presses;
  point.height = side.body.height(side.placement, at);
  point.damped = now.damping_heat;
  const ShearState& old = side.start[c].shear;  // slip and heat stay when the shear stress goes
  point.shear = {BodyFoot<T, D>::plain_shear(now.shear), old.slip + now.slip, old.dissipated + now.heat, now.slides};
  if (side.film.acts) add_film<T, D>(side, c, areas, x, foot, value(motion.gap_old), point, out);
  if (!now.presses && !reached && !side.law.conserves && !(side.law.viscous > 0) && !side.film.acts) return point;
  PointAction<T, D> end, more;
  act(side, c, x, foot, now, point, end, more);
  add_to_side(side, c, areas, end, more, out);
  return point;
}

template <int D>
bool evaluate_side(const SideContact& side, bool want_tangent, SideForce& out, std::vector<ContactPoint>& points) {
  SideAreas<D> areas;
  if (!areas.measure(side, want_tangent)) return false;
  for (int c = 0; c < side.rule.points; ++c)
    points[c] = want_tangent ? evaluate_point<Dual<PointNumbers<double, D>::unknowns>, D>(side, c, areas, out)
                             : evaluate_point<double, D>(side, c, areas, out);
  return true;
}

}  // namespace

bool penalty_side(const SideContact& side, bool want_tangent, SideForce& out, std::vector<ContactPoint>& points) {
  const bool space = side.geometry == Geometry::space;
  out.dofs = dimension(side.geometry) * side.rule.nodes + side.pressure_nodes + side.body.unknowns().count;
  out.f.assign(out.dofs, 0.0);
  out.correction.assign(out.dofs, 0.0);
  out.k.assign(want_tangent ? out.dofs * out.dofs : 0, 0.0);
  points.assign(side.rule.points, {});
  return space ? evaluate_side<3>(side, want_tangent, out, points) : evaluate_side<2>(side, want_tangent, out, points);
}

}  // namespace mudline
