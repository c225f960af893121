#include "contact/parts/in_situ_contact.hpp"

#include <algorithm>
#include <cmath>

#include "tensor/midpoint_rule.hpp"

namespace mudline {

void InSituContact::touch(std::size_t side, FirstTouch& found, const Write& write) const {
  constexpr double facing = 0.7;  // [-] cosine: a side that does not face the target does not touch it
  const SurfaceSide& at = surface.sides()[side];
  const ContactRule& points = surface.rule(at);
  const SideCoordinates x = side_coordinates(at, committed.coordinates);
  const double edge = edges(at, committed.coordinates).second, reach = gaps.reach(edge);
  double area[max_contact_points];
  if (!point_areas(points, x, context.space.mesh().geometry(), area)) return;
  found.reach = std::max(found.reach, reach);
  const double distance = std::max(edge, reach);
  const std::vector<int> candidates = target.near(surface.box(side, committed.coordinates), distance);
  for (int c = 0; c < points.points; ++c) {
    ++found.points;
    const Place place{side, c, points.place(c, x), points.outward(c, x)};
    TargetPlace there;
    if (!target.find(candidates, place.at, place.outward, distance, committed.coordinates, there)) continue;
    ContactPoint point{};
    target.complete(there, place.at, committed.coordinates, point);
    if (-dot(place.outward, point.normal) < facing) continue;
    if (std::abs(there.gap) > reach) {
      found.deep += there.gap < 0;
      found.deepest = std::max(found.deepest, -there.gap);
      continue;
    }
    press(place, area[c], there, point, found, write);
  }
}

void InSituContact::press(const Place& place, double area, const TargetPlace& there, ContactPoint& point,
                          FirstTouch& found, const Write& write) const {
  double pressure = gaps.presses() ? dot(point.normal, traction(place, place.outward, point.normal)) : 0.0;
  // the film's pressure is the pore pressure; the rest is the law's
  if (gaps.presses() && film) pressure -= pore_pressure(place);
  found.pulled += pressure < 0;
  const double depth = penetration(place, std::max(0.0, pressure));
  const bool bears = pressure > 0 && std::isfinite(depth);
  found.beyond += pressure > 0 && !bears;
  found.close(there.gap, bears ? pressure : 0.0);
  gaps.set_offset(committed, row(place), there.gap + (bears ? depth : 0.0));
  if (!bears) return;
  if (augmented) rows.normal_multiplier(committed, row(place)) = pressure;
  point.gap = -depth;
  point.active = true;
  point.area = area;
  point.pressure = pressure;
  if (film) point.pressure += pore_pressure(place);
  point.force = point.pressure * area * point.normal;
  point.shear = rows.shear(committed, row(place));
  if (laws.friction()) {
    const Point along = shear(place, point.normal), &n = point.normal;
    const bool plane = context.space.mesh().dimension() == 2;
    point.shear.shear = plane ? Point{n[0] * along[1] - n[1] * along[0], 0, 0} : along;
    if (augmented) rows.set_shear_multiplier(committed, row(place), point.shear.shear);
    point.friction = area * along;
    point.force = point.force + point.friction;
  }
  target.complete(there, place.at, committed.coordinates, point);
  write(row(place), there, point);
}

Point InSituContact::shear(const Place& place, const Point& normal) const {
  // on the target's surface: a facet of the mesh beside it would bear a part of the pressure as shear
  const Point along = traction(place, -normal, normal);
  return along - dot(normal, along) * normal;
}

double InSituContact::pore_pressure(const Place& place) const {
  const SurfaceSide& side = surface.sides()[place.side];
  return laws.pore_pressure(side, surface.rule(side), place.point, committed.value);
}

double InSituContact::penetration(const Place& place, double pressure) const {
  if (augmented) return 0;  // multipliers carry it
  const SurfaceSide& side = surface.sides()[place.side];
  TouchingSoil soil = laws.soil(committed, side, surface.rule(side).xi[place.point].data());
  soil.pore_pressure += pore_pressure(place);
  return penetration_under(laws.normal(), pressure, penalties(place.side, 0), soil);
}

Point InSituContact::traction(const Place& place, const Point& outward, const Point& normal) const {
  if (const double given = rows.pressure(committed, row(place)); given > 0)
    return given * normal + (context.space.mesh().dimension() == 3 ? rows.shear(committed, row(place)).shear : Point{});
  const SurfaceSide& side = surface.sides()[place.side];
  const auto stress = context.stress(committed, side.block, side.element, place.at);
  Point result{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) result[i] += stress[six(i, j)] * outward[j];
  return result;
}

}  // namespace mudline
