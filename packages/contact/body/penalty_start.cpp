// Initial gaps and pressures of a contact from the state in which it first acts.
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

#include "contact/body/penalty_contact.hpp"
#include "discretisation/side_map.hpp"
#include "tensor/midpoint_rule.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// Unit normal of a side at a point of its rule, out of the soil.
template <int D>
Point outward_normal(const ContactRule& rule, int c, const SideCoordinates& x) {
  SideMap<D> map;
  map.compute(rule.nodes, &rule.shape(c, 0), &rule.shape_slope(c, 0), [&](int a, int i) { return x[a][i]; });
  Point result{};
  for (int i = 0; i < D; ++i) result[i] = map.normal[i] / map.stretch;
  return result;
}

/// Gap [m] of a point, and the body's normal at its closest point.
std::pair<double, Point> nearest(const RigidBody& body, const BodyPlacement& placement, const Point& place) {
  if (body.dimension() == 3) {
    const SurfaceProjection projection = body.projection(placement, place);
    return {projection.gap, projection.normal};
  }
  const ContourProjection projection = body.closest(placement, in_plane(place));
  return {projection.gap, {projection.normal[0], projection.normal[1], 0}};
}

}  // namespace

void PenaltyContact::first_act(State& committed) {
  if (!deck_.initial_gap.adjusts()) return;
  const Comm& comm = *context_.space.mesh().comm();
  const PointView& penalties = committed.arrays[penalties_];
  const int acted = penalties.extent(0) > 0 && penalties(0, 0) > 0;
  int anywhere = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, acted, Teuchos::outArg(anywhere));
  if (anywhere > 0) return;
  deck_.start_penalties(*surface_, context_.stiffness, penalties);
  const BodyPlacement placement = body_->placement(committed);
  FirstTouch found;
  for (std::size_t s = 0; s < surface_->sides().size(); ++s) touch_first(s, committed, placement, found);
  found.everywhere(comm).tell(name_, deck_.initial_gap.presses());
}

void PenaltyContact::touch_first(std::size_t side, const State& committed, const BodyPlacement& placement,
                                 FirstTouch& found) const {
  constexpr double facing = 0.7;  // [-] cosine: a side that does not face the body does not touch it
  const SurfaceSide& at = surface_->sides()[side];
  const ContactRule& points = rule(at);
  const SideCoordinates x = side_coordinates(at, committed.coordinates);
  const double reach = deck_.initial_gap.reach(edges(at, committed.coordinates).second);
  double area[max_contact_points];
  if (!contact_areas(points, x, context_.space.mesh().geometry(), area)) return;
  found.reach = std::max(found.reach, reach);
  for (int c = 0; c < points.points; ++c) {
    ++found.points;
    const Point place = points.place(c, x);
    const auto [gap, normal] = nearest(*body_, placement, place);
    const Point outward = axes() == 2 ? outward_normal<2>(points, c, x) : outward_normal<3>(points, c, x);
    if (-dot(outward, normal) < facing) continue;
    if (std::abs(gap) > reach) {
      found.deep += gap < 0;
      found.deepest = std::max(found.deepest, -gap);
      continue;
    }
    double pressure = 0;
    if (deck_.initial_gap.presses()) pressure = in_situ_pressure(side, c, committed, place, outward, normal);
    found.pulled += pressure < 0;
    const double depth = in_situ_penetration(side, c, committed, std::max(0.0, pressure));
    const bool bears = pressure > 0 && std::isfinite(depth);
    found.beyond += pressure > 0 && !bears;
    found.close(gap, bears ? pressure : 0.0);
    const int row = first_row_[side] + c;
    deck_.initial_gap.set_offset(committed, row, gap + (bears ? depth : 0.0));
    if (!bears) continue;
    if (deck_.augmented()) rows_.normal_multiplier(committed, row) = pressure;
    ContactPoint point{};
    point.gap = -depth;
    point.active = true;
    point.area = area[c];
    point.height = body_->height(placement, place);
    point.pressure = deck_.has_film() ? pressure + pore_pressure(side, c, committed) : pressure;
    point.total.force = point.pressure * area[c] * normal;
    point.total.moment = cross(place - placement.centre, point.total.force);
    rows_.writer(committed).write(row, point);
    deck_.film.writer(committed).write(row, point);
  }
}

double PenaltyContact::in_situ_penetration(std::size_t side, int point, const State& committed, double pressure) const {
  if (deck_.augmented()) return 0;  // multipliers carry it
  const SurfaceSide& at = surface_->sides()[side];
  TouchingSoil soil = laws_.soil(committed, at, rule(at).xi[point].data());
  soil.pore_pressure += pore_pressure(side, point, committed);
  return penetration_under(laws_.normal(), pressure, committed.arrays[penalties_](side, 0), soil);
}

double PenaltyContact::in_situ_pressure(std::size_t side, int point, const State& committed, const Point& at,
                                        const Point& outward, const Point& normal) const {
  const SurfaceSide& here = surface_->sides()[side];
  const auto stress = context_.stress(committed, here.block, here.element, at);
  double pressure = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) pressure += normal[i] * stress[six(i, j)] * outward[j];
  // the film's pressure is the pore pressure; the rest is the law's
  return deck_.has_film() ? pressure - pore_pressure(side, point, committed) : pressure;
}

double PenaltyContact::pore_pressure(std::size_t side, int point, const State& state) const {
  const SurfaceSide& at = surface_->sides()[side];
  const ContactRule& points = rule(at);
  const int nodes = surface_->pressure_nodes(at.shape);
  const double* shape = nodes < points.nodes ? &points.corner(point, 0) : &points.shape(point, 0);
  double result = 0;
  for (int a = 0; a < nodes; ++a)
    result += shape[a] * state.value(surface_->dofs(at.shape)(at.row, axes() * at.count + a));
  return result;
}

}  // namespace mudline
