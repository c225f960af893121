#include "bodies/body_water.hpp"

#include <cmath>

namespace mudline {

namespace {

/// One number for each axis of the body.
void add_by_axis(Parameters& p, const std::string& name, std::vector<double>& member, const std::string& unit,
                 const std::string& doc) {
  p.add(name, member, unit, non_negative(), doc);
  if (!member.empty() && member.size() != 3)
    p.deck().fail("needs three numbers, along the body's x, y and z axes", name);
}

}  // namespace

void BodyWater::parameters(Parameters& p) {
  p.add("density", density, "kg/m3", non_negative(), "of the water around the body; 0: no water");
  p.add("drag coefficient", drag, "-", non_negative(), "C_d of the drag 1/2 rho C_d A |v| v");
  p.add("drag area", area, "m2", non_negative(),
        "A of the drag; 0: the largest section of the contour across the vertical, in space the shadow of the surface "
        "along its z axis");
  p.add("added mass coefficient", added_mass, "-", non_negative(),
        "mass of water accelerated with the body over that of its volume");
  p.add("mudline", mudline, "m", any(),
        "in the plane: height of the seabed: buoyancy and drag act on the volume above it; absent: on all of it");
  has_mudline = p.given("mudline");
  if (p.dimension() < 3) return;
  add_by_axis(p, "drag coefficients", drags, "-",
              "in space, instead of one coefficient: C_i of the drag -1/2 rho C_i A_i |v| v_i along the body's axes, "
              "which turn with it, at the middle of its volume");
  add_by_axis(p, "drag areas", areas, "m2", "A_i of those; absent: the shadows of the surface along its axes");
  add_by_axis(p, "drag moments", spin_drag, "N m s2",
              "in space: c_i of the moments -c_i |w_i| w_i that brake the spin w about the body's axes");
  add_by_axis(p, "added mass coefficients", added_masses, "-",
              "in space, instead of one coefficient: mass of water accelerated with the body along each of its axes, "
              "over that of its volume");
  add_by_axis(p, "added moments of inertia", added_inertia, "kg m2",
              "in space: of the water that turns with the body, about its axes");
}

void BodyWater::check(const BodyProperties& body, bool rotates, const Section& section) const {
  const bool by_axis = !added_masses.empty() || !added_inertia.empty() || !spin_drag.empty();
  if (density == 0 && (drags_at_all() || added_mass > 0 || has_mudline || by_axis)) {
    const char* entries[] = {
        "drag coefficient",        "drag coefficients",        "mudline",     "added mass coefficient",
        "added mass coefficients", "added moments of inertia", "drag moments"};
    for (const char* entry : entries)
      if (section.has_parameter(entry)) section.fail("there is no water: its 'density' is 0 or missing", entry);
  }
  if (area > 0 && drag == 0) section.fail("without a 'drag coefficient' it does nothing", "drag area");
  if (!areas.empty() && drags.empty()) section.fail("without 'drag coefficients' it does nothing", "drag areas");
  if (!drags.empty() && drag > 0) section.fail("there is a 'drag coefficient' for all directions", "drag coefficients");
  if (!added_masses.empty() && added_mass > 0)
    section.fail("there is an 'added mass coefficient' for all directions", "added mass coefficients");
  const bool space = body.geometry == Geometry::space;
  if (density > 0 && body.volume <= 0)
    section.fail(std::string("the body's ") + (space ? "surface" : "contour") +
                     " is open: its buoyancy needs a 'volume' of the body",
                 "density");
  if (has_mudline && (rotates || space || body.turned))
    section.fail(std::string(space         ? "a body in space"
                             : body.turned ? "a body with a 'rotation' at the start"
                                           : "a body that may rotate") +
                     " is wholly in the water: it takes no 'mudline'",
                 "mudline");
  const bool unknown_area = space && ((drag > 0 && area == 0) || (!drags.empty() && areas.empty()));
  if (unknown_area && body.frontal_areas[2] == 0)
    section.fail("the body's surface is open: its drag needs an area",
                 drags.empty() ? "drag coefficient" : "drag coefficients");
}

AddedMass BodyWater::moved(const BodyProperties& body) const {
  AddedMass result;
  for (int i = 0; i < 3; ++i) {
    result.mass[i] = (added_masses.empty() ? added_mass : added_masses[i]) * density * body.volume;
    result.inertia[i] = added_inertia.empty() ? 0.0 : added_inertia[i];
  }
  return result;
}

void BodyWater::act(const BodyProperties& body, const Point& gravity, const BodyInstant& at, BodyLoad& load) const {
  if (density == 0) return;
  if (body.geometry == Geometry::space)
    act_in_space(body, gravity, at, load);
  else
    act_in_plane(body, gravity, at, load);
}

void BodyWater::act_in_plane(const BodyProperties& body, const Point& gravity, const BodyInstant& at,
                             BodyLoad& load) const {
  BodyNumber share(1.0);  // of the volume above the mudline
  if (has_mudline) {
    const BodyNumber height = mudline - at.position[1];
    share = 1.0 - chain(height, body.enclosed->below(height.v), body.enclosed->section(height.v)) / body.volume;
    if (share.v <= 0) share = BodyNumber(0.0);
  }
  const double displaced = density * body.volume, across = area > 0 ? area : body.frontal_area;
  const double factor = 0.5 * density * drag * across;
  BodyNumber squares = at.velocity[0] * at.velocity[0] + at.velocity[1] * at.velocity[1];
  const BodyNumber speed = squares.v > 0 ? square_root(squares) : BodyNumber(0.0);
  for (int i = 0; i < 2; ++i) load.force[i] -= share * (displaced * gravity[i] + factor * (speed * at.velocity[i]));
}

void BodyWater::act_in_space(const BodyProperties& body, const Point& gravity, const BodyInstant& at,
                             BodyLoad& load) const {
  const BodyVector middle = constant_vector(body.middle), arm = at.axes.outward(middle);
  load.add(constant_vector(-density * body.volume * gravity), arm);
  if (drags_at_all()) {
    // past the middle of the volume, along the body's axes
    const BodyVector past = at.axes.inward(at.velocity) + cross(at.spin, middle);
    const BodyNumber squares = dot(past, past), speed = squares.v > 0 ? square_root(squares) : BodyNumber(0.0);
    BodyVector force;
    for (int i = 0; i < 3; ++i) {
      const double across = drags.empty() ? (area > 0 ? area : body.frontal_areas[2])
                                          : (areas.empty() ? body.frontal_areas[i] : areas[i]);
      force[i] = -0.5 * density * (drags.empty() ? drag : drags[i]) * across * (speed * past[i]);
    }
    load.add(at.axes.outward(force), arm);
  }
  if (spin_drag.empty()) return;
  BodyVector moment;
  for (int i = 0; i < 3; ++i) moment[i] = at.spin[i] * at.spin[i] * (at.spin[i].v > 0 ? -spin_drag[i] : spin_drag[i]);
  load.moment = load.moment + at.axes.outward(moment);
}

}  // namespace mudline
