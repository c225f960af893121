// Plausibility checks of rigid bodies: their size and place, mass and water, and motion.
#include <algorithm>
#include <cmath>

#include "checks/body_setup.hpp"
#include "tensor/mat.hpp"
#include "tensor/sym6.hpp"

namespace mudline {

namespace {

double largest_of(const Section& section, const std::string& name) {
  std::vector<double> values;
  if (section.has_parameter(name)) Parameters(section).add(name, values, "", any(), "");
  double largest = 0;
  for (double value : values) largest = std::max(largest, value);
  return largest;
}

/// Load [N] on a released body of the given mass [kg] at its place at the start and a time [s].
Point load_at(const BodySetup& of, const ReleasedMotion& motion, double mass, double time) {
  BodyProperties properties = of.body.properties();
  properties.mass = mass;
  BodyInstant at = of.body.initial_instant();
  at.time = time;
  const BodyLoad load = motion.load(properties, at);
  return {load.force[0].v, load.force[1].v, load.force[2].v};
}

/// The gravity [m/s2] from which a released body has its weight.
Point gravity_of(const BodySetup& of, const ReleasedMotion& motion) {
  const double mass = of.body.properties().mass;
  return 1 / mass * (load_at(of, motion, mass, 0) - load_at(of, motion, 0, 0));
}

void largest_extent(const BodySetup& of, const Judge& judge) {
  judge(of.size, of.called() + ": its largest extent",
        "give lengths in m (a file in mm has a thousand times as much), or the file's 'scale'");
}

void width_of(const BodySetup& of, const Judge& judge) {
  judge(of.width, of.called() + ": its width", "give lengths in m, or with a unit, as \"50 cm\"");
}

void over_mesh(const BodySetup& of, const Judge& judge) {
  const Bounds& mesh = of.model.mesh().bounds();
  double most = 0, half = 0;
  for (int i = 0; i < of.up; ++i) {
    const double room =
        std::max({mesh.high[i] - of.body.initial_position()[i], of.body.initial_position()[i] - mesh.low[i], 1e-300});
    if (of.length_of(i) / 2 / room <= most) continue;
    half = of.length_of(i) / 2;
    most = half / room;
  }
  // a plate over a column of soil is wider on purpose; a ratio above this one points to lengths in mm
  constexpr double plate = 25;
  const bool round = of.body.of_revolution() || (of.dim == 3 && of.model.soil()->pressure >= 0);
  if (of.surfaces.sides > 0 && (round || most > plate))
    judge(most, of.called() + ": its half width, " + readable(half, "m", 3) + ", over the mesh's on its wider side",
          "make the mesh wider, or give the body's lengths in m");
}

void aside(const BodySetup& of, const Judge& judge) {
  if (of.surfaces.sides == 0) return;
  double away = 0;
  for (int i = 0; i < of.up; ++i)
    away = std::max({away, of.surfaces.box.low[i] - of.box.high[i], of.box.low[i] - of.surfaces.box.high[i]});
  judge(away / of.width, of.called() + ": its distance beside the surface that it may touch, in widths,",
        "move its 'position' over the surface, or name another 'surface'");
}

void facing(const BodySetup& of, const Judge& judge) {
  if (of.surfaces.sides > 0)
    judge(of.surfaces.facing,
          of.called() + ": the cosine between the nearest sides of its contact's surface and its own surface there",
          "name the side set that looks at the body as 'surface'; an open contour has its body on the left of its "
          "direction of travel");
}

void fit(const BodySetup& of, const Judge& judge) {
  if (of.surfaces.misfit > 0 && of.surfaces.reach > 0)
    judge(of.surfaces.misfit / of.surfaces.reach,
          of.called() + ": the distance between its shape and the hole of the mesh that it lies in, " +
              readable(of.surfaces.misfit, "m", 3) + ", in sides,",
          "give mesh and body the same lengths (tip, diameter, position)");
}

/// Whether the two ends of a contour are one point, or a half contour ends on its axis.
bool is_closed(const Contour& contour) {
  const ContourPiece &first = *contour.pieces().front(), &last = *contour.pieces().back();
  const PlanePoint from = first.point(0), to = last.point(last.length());
  const double apart =
      contour.extent() == ContourExtent::half ? std::abs(to[0]) : std::hypot(to[0] - from[0], to[1] - from[1]);
  return apart <= 1e-9 * contour.length();
}

/// Lines at the ends of an open contour extend to infinity. Where they extend neither upwards nor to both sides, a side
/// is missing.
void open_contour(const BodySetup& of, const Judge& judge) {
  if (of.dim == 3 || of.body.contour().extent() == ContourExtent::half || is_closed(of.body.contour())) return;
  const auto& pieces = of.body.contour().pieces();
  const PlanePoint in = pieces.front()->tangent(0), out = pieces.back()->tangent(pieces.back()->length());
  const double x = out[0] - in[0], y = out[1] - in[1], size = std::hypot(x, y);
  constexpr double both_sides = 0.5;
  if (size > both_sides)
    judge(
        y / size,
        of.called() + ": the cosine between the vertical and the direction in which its open contour runs on for ever",
        "close the contour: its last point is its first one (in a box of four corners give five points)");
}

/// An end that is no line is not extended: beyond it the body has no side.
void contour_end(const BodySetup& of, const Judge& judge) {
  if (of.dim == 3 || is_closed(of.body.contour())) return;
  const auto& pieces = of.body.contour().pieces();
  const bool half = of.body.contour().extent() == ContourExtent::half;
  const auto line = [](const ContourPiece& piece) { return dynamic_cast<const LinePiece*>(&piece) != nullptr; };
  const double curves = (line(*pieces.back()) ? 0 : 1) + (half || line(*pieces.front()) ? 0 : 1);
  judge(curves, of.called() + ": the number of open ends of its contour that are curves",
        half ? "end it on the axis x = 0, or by a straight line, which runs on for ever"
             : "let the last piece end where the first one starts, or end it by straight lines, which run on for ever");
}

/// Whether a stage prescribes a displacement or a rotation.
bool driven(const BodySetup& of) {
  for (const auto& motion : of.motions) {
    if (motion.law->turns()) return true;
    for (int i = 0; i < of.dim; ++i)
      if (motion.law->moves(i)) return true;
  }
  return false;
}

void contacts_of(const BodySetup& of, const Judge& judge) {
  double count = 0;
  for (const auto& [name, contact] : of.model.contacts()) count += contact->partners().body == &of.body;
  if (driven(of) || of.free())
    judge(count, of.called() + ": the number of its contacts", "give 'contacts' an entry for it");
}

void in_space_only_gap(const BodySetup& of, const Judge& judge) {
  if (of.dim == 3 && of.surfaces.sides > 0)
    judge(std::max(0.0, of.surfaces.gap) / of.width, of.called() + ": its distance from the soil, in widths,",
          "move its 'position' nearer; a fall through water needs no steps: give the speed at the soil instead");
}

void in_space_density(const BodySetup& of, const Judge& judge) {
  const BodyProperties& p = of.body.properties();
  if (of.dim == 3 && of.free() && p.mass > 0 && p.volume > 0 && length(gravity_of(of, *of.release)) > 0)
    judge(p.mass / p.volume, of.called() + ": its mass over its volume of " + told(p.volume) + " m3",
          "give 'mass' in kg and lengths in m");
}

void in_space_sides(const BodySetup& of, const Judge& judge) {
  if (of.dim == 3 && of.surfaces.sides > 0 && of.surfaces.gap < any_size)
    judge(of.width / of.surfaces.shortest,
          of.called() + ": its width over the shortest side of the surface that it touches",
          "refine the surface below the body, or give its lengths in m");
}

void volume(const BodySetup& of, const Judge& judge) {
  const double given = number_in(of.entry, "volume", 0);
  double own = of.body.surface() ? of.body.surface()->moments().volume : of.body.properties().enclosed->total();
  if (given > 0 && own > 0)
    judge(given / own, of.called() + ": its 'volume' over that of its shape, " + told(own) + " m3,",
          "give it in m3, or leave it out");
}

/// Principal values of a symmetric tensor, the largest first.
Vec<double, 3> principal(const Mat<double, 3>& a) {
  const double components[6] = {a[0][0], a[1][1], a[2][2], a[1][2], a[0][2], a[0][1]};
  Vec<double, 3> values;
  sym6::principal_values(components, values.data());
  return values;
}

void inertia_triangle(const BodySetup& of, const Judge& judge) {
  if (of.dim == 2 || !of.entry.has_parameter("inertia tensor")) return;
  const Vec<double, 3> moments = principal(of.body.properties().inertia);
  judge(moments[0] / (moments[2] + moments[1]),
        of.called() + ": its largest principal moment of inertia over the sum of the other two",
        "no body has more than 1: give the tensor about the centre of mass, products with the sign of -int x y dm");
}

void gyration(const BodySetup& of, const Judge& judge) {
  const BodyProperties& p = of.body.properties();
  if (!of.free() || !of.release->rotates() || !(p.mass > 0)) return;
  const auto tell = [&](double inertia) {
    judge(std::sqrt(inertia / p.mass) / of.size,
          of.called() + ": a radius of gyration over its largest extent, " + readable(of.size, "m", 3) + ",",
          "give the moments of inertia in kg m2 about the centre of mass, and the mass in kg");
  };
  if (of.dim == 2) {
    tell(p.moment_of_inertia);
  } else if (of.entry.has_parameter("inertia tensor")) {
    const auto values = principal(p.inertia);
    tell(values[2]);
    tell(values[0]);
  }
}

void centre_of_mass(const BodySetup& of, const Judge& judge) {
  if (!of.entry.has_parameter("centre of mass")) return;
  const Point at = of.body.initial_placement().centre;
  double outside = 0;
  for (int i = 0; i < of.dim; ++i) outside = std::max({outside, of.box.low[i] - at[i], at[i] - of.box.high[i]});
  judge(outside / of.size, of.called() + ": how far its 'centre of mass' is outside of it, in its largest extents,",
        "give it in m from the reference point, along the body's axes");
}

void added_water(const BodySetup& of, const Judge& judge, const char* one, const char* several) {
  for (const auto& motion : of.motions) {
    const Section water = motion.entry.section("water");
    const double most = std::max(number_in(water, one, 0), largest_of(water, several));
    if (most > 0) judge(most, of.called() + ": '" + one + "' in stage '" + motion.stage + "'", "it has no unit");
  }
}

void drag(const BodySetup& of, const Judge& judge) { added_water(of, judge, "drag coefficient", "drag coefficients"); }
void added_mass(const BodySetup& of, const Judge& judge) {
  added_water(of, judge, "added mass coefficient", "added mass coefficients");
}

void water_around(const BodySetup& of, const Judge& judge) {
  for (const auto& motion : of.motions) {
    const double density = number_in(motion.entry.section("water"), "density", 0);
    if (density > 0)
      judge(density, of.called() + ": the density of the water around it in stage '" + motion.stage + "'",
            "give it in kg/m3, as 1000 or 1025");
  }
}

void drag_area(const BodySetup& of, const Judge& judge) {
  const BodyProperties& p = of.body.properties();
  const double own = of.dim == 2 ? p.frontal_area : p.frontal_areas[2];
  for (const auto& motion : of.motions) {
    const double area = number_in(motion.entry.section("water"), "drag area", 0);
    if (area > 0 && own > 0)
      judge(area / own, of.called() + ": its 'drag area' over that of its shape, " + told(own) + " m2,",
            "give it in m2, or leave it out");
  }
}

void mudline_height(const BodySetup& of, const Judge& judge) {
  for (const auto& motion : of.motions) {
    const Section water = motion.entry.section("water");
    if (water.has_parameter("mudline") && of.surfaces.sides > 0)
      judge(std::abs(number_in(water, "mudline", 0) - of.surfaces.box.high[of.up]) / of.size,
            of.called() + ": the distance of its 'mudline' from the top of the soil, in its extents,",
            "give the height of the seabed in m");
  }
}

void prescribed_speed(const BodySetup& of, const Judge& judge) {
  if (of.surfaces.sides > 0)
    judge(of.largest_speed(), of.called() + ": its prescribed speed",
          "give it in m/s (mm/s and km/h are larger numbers)");
}

/// Calls f(velocity, spin, text that names the stage) for every stage that gives the body an initial velocity.
template <class F>
void for_each_start(const BodySetup& of, F&& f) {
  for (const auto& motion : of.motions) {
    Point velocity{}, spin{};
    if (motion.law->released() && motion.law->released()->initial_velocity(velocity, spin))
      f(velocity, spin, " in stage '" + motion.stage + "'");
  }
}

void start_speed(const BodySetup& of, const Judge& judge) {
  for_each_start(of, [&](const Point& velocity, const Point&, const std::string& where) {
    judge(length(velocity), of.called() + ": its initial velocity" + where,
          "give it in m/s (mm/s and km/h are larger numbers)");
  });
}

void start_spin(const BodySetup& of, const Judge& judge) {
  for_each_start(of, [&](const Point&, const Point& spin, const std::string& where) {
    judge(length(spin), of.called() + ": its initial spin" + where,
          "give it in rad/s (degrees per second and turns per minute are larger numbers)");
  });
}

void turned(const BodySetup& of, const Judge& judge) {
  judge(of.places.back().angle, of.called() + ": the angle that it is turned by", "give rotations in rad");
}

void way(const BodySetup& of, const Judge& judge) {
  if (of.free() || of.surfaces.sides == 0 || of.motions.empty()) return;
  double farthest = 0;
  for (const auto& place : of.places)
    farthest = std::max(farthest, length(place.displacement) + place.angle * of.size / 2);
  if (driven(of))
    judge(farthest / of.surfaces.shortest,
          of.called() + ": its prescribed displacement, " + readable(farthest, "m", 3) +
              ", over the shortest side of the surface",
          "its motion does not move it within the stages: look at its function, the stages' durations and the ramp");
}

void depth(const BodySetup& of, const Judge& judge) {
  if (of.surfaces.sides == 0) return;
  double down = 0;
  for (const auto& place : of.places) down = std::min(down, place.displacement[of.up]);
  const double top = of.surfaces.box.high[of.up], bottom = of.model.mesh().bounds().low[of.up];
  const double below = top - (of.box.low[of.up] + down);
  if (down < 0 && top > bottom)  // a surface at the mesh's bottom looks away from the body, which 'facing' tells
    judge(
        below / (top - bottom),
        of.called() + ": the depth that its prescribed path reaches, " + readable(below, "m", 3) + ", over the mesh's",
        "velocity times duration is its displacement: look at units (mm/s, minutes), or make the mesh deeper");
}

void ways_aside(const BodySetup& of, const Judge& judge) {
  if (of.surfaces.sides == 0) return;
  const Bounds& mesh = of.model.mesh().bounds();
  for (int i = 0; i < of.up; ++i) {
    double far = 0;
    for (const auto& place : of.places) far = std::max(far, std::abs(place.displacement[i]));
    if (far > 0)
      judge(far / (mesh.high[i] - mesh.low[i]),
            of.called() + ": its prescribed displacement along " + axis_names[i] + ", " + readable(far, "m", 3) +
                ", over the mesh's extent",
            "velocity times duration is its displacement: look at units, or make the mesh wider");
  }
}

void ramp(const BodySetup& of, const Judge& judge) {
  for (const auto& motion : of.motions) {
    const double time = number_in(motion.entry, "ramp time", 0);
    if (time > 0)
      judge(time / motion.duration, of.called() + ": its 'ramp time' over the duration of stage '" + motion.stage + "'",
            "it does not come to its velocity: give the ramp in s, or a longer stage");
  }
}

void leaves_in_space(const BodySetup& of, const Judge& judge) {
  if (of.surfaces.sides == 0) return;
  double way = 0;
  for (const auto& place : of.places) way = std::min(way, place.displacement[of.up]);
  Point velocity{}, spin{};
  double rise = 0;
  const bool prescribed = of.places.size() > 1;
  if (of.dim == 3 && prescribed && way >= 0) rise = of.places.back().displacement[of.up];
  if (of.dim == 3 && !prescribed && of.free() && of.release->initial_velocity(velocity, spin)) rise = velocity[of.up];
  if (of.box.low[of.up] > of.surfaces.box.high[of.up] - 1e-6 * of.size)  // a body below the top is pulled out
    judge(rise, of.called() + ": how it moves away from the soil, m or m/s upwards,", "down is negative");
}

void soil_gravity(const BodySetup& of, const Judge& judge) {
  const Point& soil = of.soil_gravity;
  if (!(length(soil) > 0) || !(of.body.properties().mass > 0)) return;
  for (const auto& motion : of.motions) {
    const ReleasedMotion* released = motion.law->released();
    if (!released) continue;
    const Point own = gravity_of(of, *released);
    // in total stresses a smaller gravity may stand for the submerged weight of the soil
    const double scale = of.model.soil()->pressure >= 0 ? 1.0 : length(own) / length(soil);
    if (length(own) > 0)
      judge(length(own - scale * soil) / length(own),
            of.called() + ": the difference of its gravity in stage '" + motion.stage + "', {" + told(own[0]) + ", " +
                told(own[1]) + (of.dim == 3 ? ", " + told(own[2]) : "") + "} m/s2, from that of physics, over its own,",
            "give the motion's 'gravity' as 'physics' has it");
  }
}

void force_size(const BodySetup& of, const Judge& judge) {
  if (of.surfaces.sides == 0) return;
  double modulus = 0;
  for (const auto& [name, contact] : of.model.contacts())
    if (contact->partners().body == &of.body && modulus == 0) {
      const SoilBehind soil = soil_behind(of.model, contact->partners().surface);
      modulus = soil.modulus;
    }
  for (const auto& motion : of.motions) {
    const ReleasedMotion* released = motion.law->released();
    if (!released) continue;
    double most = 0;
    for (int k = 0; k <= 50; ++k)
      most = std::max(
          most, length(load_at(of, *released, of.body.properties().mass, motion.begin + motion.duration * k / 50)));
    const double area =
        of.body.properties().geometry == Geometry::plane_strain ? of.width : of.width * of.shadow.length;
    if (most > 0 && modulus > 0)
      judge(most / area / modulus,
            of.called() + ": its largest load in stage '" + motion.stage + "', " + readable(most, "N", 3) +
                ", over its width times its length (plane strain: width) and the soil's modulus, " +
                readable(modulus, "Pa", 3) + ",",
            "give forces in N and mass in kg");
  }
}

void speed_gain(const BodySetup& of, const Judge& judge) {
  if (of.motions.empty() || !of.motions.front().law->released() || !(of.body.properties().mass > 0)) return;
  const ReleasedMotion& motion = *of.motions.front().law->released();
  Point velocity{}, spin{};
  if (!motion.initial_velocity(velocity, spin) || !(velocity[of.up] < 0) || !(of.surfaces.gap > 0)) return;
  const AddedMass more = motion.added_mass(of.body.properties());
  const double fall =
      -load_at(of, motion, of.body.properties().mass, 0)[of.up] / (of.body.properties().mass + more.mass[of.up]);
  if (!(fall > 0) || of.surfaces.gap >= any_size) return;
  const double then = std::sqrt(velocity[of.up] * velocity[of.up] + 2 * fall * of.surfaces.gap);
  // an initial velocity that is small against the speed of the fall is no doubt; one of about that speed was probably
  // counted twice
  if (then > -2 * velocity[of.up]) return;
  judge(then / -velocity[of.up],
        of.called() + ": the speed at the soil, " + told(then) + " m/s after a fall of " +
            readable(of.surfaces.gap, "m", 3) + ", over its initial velocity",
        "an initial velocity is that at the body's 'position': start it at the soil, or from rest");
}

void load_points(const BodySetup& of, const Judge& judge) {
  for (const auto& motion : of.motions) {
    const Section loads = motion.entry.section("loads");
    for (const std::string& name : loads.section_names()) {
      Point at{};
      Parameters(loads.section(name)).add("point", at, "", "");
      double outside = 0;
      const Point x = of.body.initial_placement().turn(at) + of.body.initial_position();
      for (int i = 0; i < of.dim; ++i) outside = std::max({outside, of.box.low[i] - x[i], x[i] - of.box.high[i]});
      judge(outside / of.size,
            of.called() + ": how far the point of load '" + name + "' is outside of it, in its extents,",
            "give 'point' in m from the reference point");
    }
  }
}

void apex(const BodySetup& of, const Judge& judge) {
  const double angle = number_in(of.entry.section("contour"), "apex angle [deg]", 60);
  judge(angle, of.called() + ": its 'apex angle [deg]'", "give it in degrees, as 60 (1.05 is in rad)");
}

void tip(const BodySetup& of, const Judge& judge) {
  const double height = number_in(of.entry, "tip height", 0);
  if (height > 0)
    judge(height / of.body.own_height(), of.called() + ": its 'tip height' over its own height",
          "give it in m above the reference point");
}

}  // namespace

std::vector<Check<BodySetup>> body_checks() {
  return {
      {{"body size", "m", {1e-3, 200}, "of a body, its largest extent as far as it is drawn"}, largest_extent},
      {{"body width", "m", {1e-3, 100}, "of a body, across the vertical"}, width_of},
      {{"body over mesh", "-", {0, 1.001}, "half width of a body over that of the mesh from its middle on"}, over_mesh},
      {{"beside the surface", "-", {0, 1e-6}, "how far a body stands beside its contact's surface, in widths"}, aside},
      {{"facing", "-", {0, 1.001}, "cosine between the sides that are nearest to a body and its surface there"},
       facing},
      {{"fit in a hole", "-", {0, 0.25}, "distance of a body from the sides of a hole that it lies in, in sides"}, fit},
      {{"open contour", "-", {0.5, 1.0001}, "cosine between the vertical and the way in which an open contour runs on"},
       open_contour},
      {{"ends of a contour", "-", {0, 0}, "open ends of a contour that are curves and do not run on"}, contour_end},
      {{"contacts of a body", "-", {1, any_size}, "number of contacts of a body that moves"}, contacts_of},
      {{"gap in space", "-", {0, 5}, "distance of a body in space from the soil over its width"}, in_space_only_gap},
      {{"density in space", "kg/m3", {1000, 20000}, "mass over volume of a body in space that may move freely"},
       in_space_density},
      {{"width over side", "-", {1, any_size}, "width of a body in space over the shortest side of its surface"},
       in_space_sides},
      {{"volume of a body", "-", {0.5, 2}, "a body's given volume over that of its shape"}, volume},
      {{"triangle of inertia", "-", {0, 1.0001}, "largest principal moment of inertia over the sum of the others"},
       inertia_triangle},
      {{"radius of gyration", "-", {0.02, 0.6}, "radius of gyration over a body's largest extent"}, gyration},
      {{"centre of mass", "-", {0, 0.01}, "how far the centre of mass is outside the body's box, in its extents"},
       centre_of_mass},
      {{"body gravity", "-", {0, 0.05}, "difference of a body's gravity from that of the soil, over the latter"},
       soil_gravity},
      {{"drag coefficient", "-", {0, 5}, "of the water around a body"}, drag},
      {{"added mass", "-", {0, 5}, "coefficient of the water around a body"}, added_mass},
      {{"water around", "kg/m3", {900, 1300}, "density of the water around a body"}, water_around},
      {{"drag area", "-", {0.1, 10}, "a body's given drag area over that of its shape"}, drag_area},
      {{"mudline", "-", {0, 1}, "distance of a body's mudline from the top of the soil over the body's extent"},
       mudline_height},
      {{"prescribed speed", "m/s", {0, 30}, "of a body"}, prescribed_speed},
      {{"initial speed", "m/s", {0, 50}, "of a body"}, start_speed},
      {{"initial spin", "rad/s", {0, 30}, "of a body in space"}, start_spin},
      {{"turned by", "rad", {0, 6.4}, "angle by which a prescribed motion turns a body"}, turned},
      {{"prescribed way", "-", {1e-4, any_size}, "of a body over the shortest side of its surface"}, way},
      {{"prescribed depth", "-", {0, 0.95}, "depth that a prescribed path reaches, over the mesh's"}, depth},
      {{"way aside", "-", {0, 0.75}, "prescribed displacement across the vertical over the mesh's extent"}, ways_aside},
      {{"ramp time", "-", {0, 1}, "of a prescribed velocity over the stage's duration"}, ramp},
      {{"rise", "-", {-any_size, 0}, "way or speed by which a body in space moves away from the soil"},
       leaves_in_space},
      {{"load over modulus", "-", {1e-7, 1}, "force on a body over its width squared and the soil's modulus"},
       force_size},
      {{"speed gain", "-", {1, 1.2}, "speed of a falling body at the soil over its initial velocity"}, speed_gain},
      {{"load point", "-", {0, 1}, "how far a load's point is outside the body, in its extents"}, load_points},
      {{"apex angle", "deg", {10, 180}, "of a cone"}, apex},
      {{"tip height of a body", "-", {0, 1}, "over the body's height as far as it is drawn"}, tip},
  };
}

}  // namespace mudline
