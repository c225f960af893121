// Axes of a body, loads at its points, buoyancy and drag.
#include "bodies/body_load.hpp"

#include <gtest/gtest.h>

#include "bodies/tests/free_body.hpp"
#include "core/pi.hpp"

namespace mudline {
namespace {

void expect_near(const Point& is, const Point& exact, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(is[i], exact[i], tolerance) << "component " << i;
}

TEST(BodyAxes, OutwardAndInwardAreInverse) {
  const Rotation turn = Rotation::by({0.3, -1.1, 0.5});
  const BodyAxes axes(turn);
  const Point x{1, 2, -3};
  expect_near(plain_vector(axes.outward(constant_vector(x))), turn(x), 1e-15);
  expect_near(plain_vector(axes.inward(axes.outward(constant_vector(x)))), x, 1e-14);
}

TEST(BodyAxes, AnIncrementTurnsAsTheRotationDoes) {
  const Rotation turn = Rotation::by({0.3, -1.1, 0.5});
  const Point increment{0.2, 0.1, -0.4};
  const BodyAxes turned = BodyAxes(turn).turned_on(constant_vector(increment)),
                 exact(turn * Rotation::by_increment(increment)), mixed = turned.mixed(0.25, BodyAxes(turn));
  for (int i = 0; i < 3; ++i) {
    expect_near(plain_vector(turned.axis[i]), plain_vector(exact.axis[i]), 1e-14);
    expect_near(plain_vector(mixed.axis[i]),
                0.25 * plain_vector(exact.axis[i]) + 0.75 * plain_vector(BodyAxes(turn).axis[i]), 1e-14);
  }
}

/// Load on a body at an instant.
BodyLoad load_at(const FreeBody& free, const BodyInstant& at) {
  return free.body->released()->load(free.body->properties(), at);
}

TEST(PointLoad, HasTheMomentOfItsArm) {
  const auto force_at_eye = [](bool turns) {
    return section_xml("loads",
                       section_xml("line", array_parameter("point", "0.5, 0, 1") + number_parameter("force x", 20) +
                                               number_parameter("force z", -3) + number_parameter("moment y", 4) +
                                               "<Parameter name=\"turns with the body\" type=\"bool\" value=\"" +
                                               (turns ? "true" : "false") + "\"/>\n"));
  };
  const std::string more = number_parameter("mass", 2) + array_parameter("centre of mass", "0, 0, 0.4") +
                           array_parameter("inertia tensor", "1, 1, 1");
  const std::string all = "x, y, z, rotation x, rotation y, rotation z";
  BodyInstant quarter;  // turned about z: x to y
  quarter.axes = BodyAxes(Rotation::by({0, 0, pi / 2}));
  for (const bool turns : {false, true}) {
    const FreeBody free(
        shaped_xml("surface", beam(1, 1, 2), more, "0, 0, 0", released_xml("force", all, force_at_eye(turns))),
        Geometry::space);
    const BodyLoad start = load_at(free, free.body->initial_instant()), turned = load_at(free, quarter);
    const Point force{20, 0, -3}, arm{0.5, 0, 0.6}, moment{0, 4, 0};
    expect_near(plain_vector(start.force), force, 1e-14);
    expect_near(plain_vector(start.moment), cross(arm, force) + moment, 1e-13);
    const Point force_now = turns ? Point{0, 20, -3} : force, moment_now = turns ? Point{-4, 0, 0} : moment;
    expect_near(plain_vector(turned.force), force_now, 1e-13);
    expect_near(plain_vector(turned.moment), cross(Point{0, 0.5, 0.6}, force_now) + moment_now, 1e-13);
  }
}

TEST(PointLoad, AForceOfThePositionHasItsSlope) {
  const FreeBody free(shaped_xml("contour", text_parameter("type", "sphere") + number_parameter("diameter", 1),
                                 number_parameter("mass", 3), "0, 1",
                                 released_xml("force", "y", text_parameter("force y", "-100*y^2 + 7*t"))),
                      Geometry::plane_strain);
  BodyInstant at;
  at.time = 2;
  at.position[1] = BodyNumber(0.5, 1);
  const BodyLoad load = load_at(free, at);
  EXPECT_NEAR(load.force[1].v, -25 + 14, 1e-13);
  EXPECT_NEAR(load.force[1].d[1], -100, 1e-6);
  EXPECT_EQ(load.force[0].v, 0);
}

std::string water(const std::string& more) { return section_xml("water", number_parameter("density", 1000) + more); }

TEST(BodyWater, BuoyancyIsTheWeightOfTheWaterAboveTheMudline) {
  const FreeBody free(body_xml("b", text_parameter("type", "sphere") + number_parameter("diameter", 2),
                               released_xml("free", "y", water(number_parameter("mudline", 1.5))), "0, 1",
                               number_parameter("mass", 8000)),
                      Geometry::axisymmetric);
  BodyInstant at = free.body->initial_instant();  // half a metre of the sphere is below the mudline
  at.position[1].d[0] = 1;
  const double below = pi * 0.25 * 2.5 / 3, volume = 4 * pi / 3;
  const BodyLoad load = load_at(free, at);
  EXPECT_NEAR(load.force[1].v, -9.81 * 8000 + 9810 * (volume - below), 1e-8);
  EXPECT_NEAR(load.force[1].d[0], 9810 * pi * 0.5 * 1.5, 1e-8);  // by the section at the mudline
  at.position[1] = BodyNumber(5.0);
  EXPECT_NEAR(load_at(free, at).force[1].v, -9.81 * 8000 + 9810 * volume, 1e-8);
  at.position[1] = BodyNumber(-3.0);
  EXPECT_NEAR(load_at(free, at).force[1].v, -9.81 * 8000, 1e-8);
}

TEST(BodyWater, DragInThePlaneOpposesTheVelocity) {
  const FreeBody free(
      body_xml("b",
               text_parameter("type", "cylinder") + text_parameter("extent", "full") + number_parameter("diameter", 2),
               released_xml(
                   "free", "x, y",
                   water(number_parameter("drag coefficient", 0.8) + number_parameter("added mass coefficient", 0.5))),
               "0, 0", number_parameter("mass", 1000 * pi)),  // floats
      Geometry::plane_strain);
  BodyInstant at = free.body->initial_instant();
  at.velocity = constant_vector({3, -4, 0});
  const double factor = 0.5 * 1000 * 0.8 * 2 * 5;
  expect_near(plain_vector(load_at(free, at).force), {-3 * factor, 4 * factor, 0}, 1e-1);
  const AddedMass added = free.body->released()->added_mass(free.body->properties());
  EXPECT_NEAR(added.mass[1], 500 * pi, 1e-9);
}

TEST(BodyWater, InSpaceDragAndBuoyancyActAtTheMiddleOfTheVolume) {
  const std::string more = number_parameter("mass", 100) + number_parameter("volume", 0.2) +
                           array_parameter("centre of mass", "0, 0, -0.5") +
                           array_parameter("inertia tensor", "1, 2, 3");
  const FreeBody free(shaped_xml("surface", beam(1, 1, 2), more, "0, 0, 0",
                                 released_xml("free", "x, y, z, rotation x, rotation y, rotation z",
                                              water(array_parameter("drag coefficients", "1, 2, 0.5") +
                                                    array_parameter("drag areas", "3, 1, 4") +
                                                    array_parameter("drag moments", "10, 20, 30")))),
                      Geometry::space);
  BodyInstant at = free.body->initial_instant();
  at.velocity = constant_vector({1, 0, 0});
  at.spin = constant_vector({0, 2, -1});
  // the middle is 0.5 above the centre of mass: it moves by v + w x (0, 0, 0.5) = (2, 0, 0)
  const BodyLoad load = load_at(free, at);
  const double drag = 0.5 * 1000 * 1 * 3 * 2 * 2;
  expect_near(plain_vector(load.force), {-drag, 0, 9.81 * (0.2 * 1000 - 100)}, 1e-9);
  expect_near(plain_vector(load.moment), {0, -0.5 * drag - 20 * 4, 30}, 1e-9);
}

}  // namespace
}  // namespace mudline
