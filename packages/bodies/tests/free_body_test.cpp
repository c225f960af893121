// Bodies with unknowns: what a state means, momentum, inertia, and how they start to move.
#include "bodies/tests/free_body.hpp"

#include <gtest/gtest.h>

#include "core/pi.hpp"

namespace mudline {
namespace {

std::string sphere(double diameter) {
  return text_parameter("type", "sphere") + text_parameter("extent", "full") + number_parameter("diameter", diameter);
}

/// Mass 50 kg and 2 kg m2 about a centre 0.3 m beside and 0.4 m above the reference point at (1, 2).
FreeBody in_plane(const std::string& motion) {
  return FreeBody(body_xml("b", sphere(1), motion, "1, 2",
                           number_parameter("mass", 50) + number_parameter("moment of inertia", 2) +
                               array_parameter("centre of mass", "0.3, 0.4")),
                  Geometry::plane_strain);
}

TEST(FreeBodies, InThePlaneAnArcIsTheUnknownOfTheRotation) {
  const FreeBody free = in_plane(released_xml("free", "x, y, rotation"));
  ASSERT_EQ(free.body->unknowns().count, 3);
  EXPECT_NEAR(free.scale(2), std::sqrt(50 / 2.0), 1e-14);  // one over the radius of gyration
  State state = free.store.committed();
  const double value[] = {0.1, -0.2, pi / 2 / free.scale(2)}, rate[] = {3, 4, 0.5};
  for (int k = 0; k < 3; ++k) {
    state.value(free.dof(k)) = value[k];
    state.rate(free.dof(k)) = rate[k];
  }
  const Point place = free.body->position(state), velocity = free.body->velocity(state);
  // the centre of mass moves by (0.1, -0.2); from there to the reference point: (-0.3, -0.4), turned: (0.4, -0.3)
  EXPECT_NEAR(place[0], 1.3 + 0.1 + 0.4, 1e-14);
  EXPECT_NEAR(place[1], 2.4 - 0.2 - 0.3, 1e-14);
  const double spin = 0.5 * free.scale(2);
  EXPECT_NEAR(free.body->spin(state)[2], spin, 1e-14);
  EXPECT_NEAR(velocity[0], 3 + spin * 0.3, 1e-13);
  EXPECT_NEAR(velocity[1], 4 + spin * 0.4, 1e-13);
  EXPECT_NEAR(free.body->rotation(state)[2], pi / 2, 1e-14);
  const BodyMomentum now = momentum(*free.body, state);
  EXPECT_NEAR(now.linear[0], 150, 1e-12);
  EXPECT_NEAR(now.angular[2], 2 * spin, 1e-12);
  EXPECT_NEAR(now.kinetic, 0.5 * 50 * 25 + 0.5 * 2 * spin * spin, 1e-11);
}

TEST(FreeBodies, FallInWaterWithTheWaterThatMovesAlong) {
  const std::string water =
      section_xml("water", number_parameter("density", 1000) + number_parameter("drag coefficient", 0.5) +
                               number_parameter("added mass coefficient", 0.5));
  FreeBody free(body_xml("b", text_parameter("type", "sphere") + number_parameter("diameter", 2),
                         released_xml("free", "y", array_parameter("initial velocity", "0, -2") + water), "0, 0",
                         number_parameter("mass", 9000)),
                Geometry::axisymmetric);
  const double volume = 4 * pi / 3, drag = 0.5 * 1000 * 0.5 * pi * 4;
  EXPECT_NEAR(moving_mass(*free.body), 9000 + 500 * volume, 1e-8);
  const double acceleration = (-9.81 * (9000 - 1000 * volume) + drag) / (9000 + 500 * volume);
  EXPECT_NEAR(free.release()[0], acceleration, 1e-12);
  EXPECT_EQ(free.store.committed().rate(free.dof(0)), -2);
}

TEST(FreeBodies, AnEccentricForceTurnsABodyInThePlane) {
  const std::string line =
      section_xml("loads", section_xml("line", array_parameter("point", "0.3, 1.4") + number_parameter("force x", 10)));
  FreeBody free = in_plane(released_xml("force", "x, y, rotation", line));
  const std::vector<double> a = free.release();
  EXPECT_NEAR(a[0], 10 / 50.0, 1e-14);
  EXPECT_NEAR(a[1], 0, 1e-14);
  EXPECT_NEAR(a[2], -10 * 1.0 / 2, 1e-13);  // a metre above the centre of mass
}

TEST(FreeBodies, ADirectionThatIsNotReleasedFollowsItsPrescribedMotion) {
  FreeBody free =
      in_plane(released_xml("free", "y", section_xml("prescribed velocity", number_parameter("velocity x", 0.25))));
  const std::vector<double> a = free.release();
  EXPECT_EQ(a[0], 0);
  EXPECT_NEAR(a[1], -9.81, 1e-14);
  Constraints to(free.space.dofs()->num_overlap_dofs());
  free.body->prescribe(free.store.committed(), 0, 2, to);
  EXPECT_EQ(to.mask(free.dof(0)), 1);
  EXPECT_NEAR(to.value(free.dof(0)), 0.5, 1e-15);
  EXPECT_NEAR(to.rate(free.dof(0)), 0.25, 1e-15);
  EXPECT_EQ(to.mask(free.dof(1)), 0);
  EXPECT_EQ(to.mask(free.dof(2)), 1);  // and does not turn
  EXPECT_EQ(to.value(free.dof(2)), 0);
}

/// A body in space with the moments of inertia 1, 2, 3 kg m2 along its axes and a mass of 4 kg.
FreeBody in_space(const std::string& motion, const std::string& rotation = "0, 0, 0") {
  return FreeBody(shaped_xml("surface", beam(1, 1, 2),
                             number_parameter("mass", 4) + array_parameter("inertia tensor", "1, 2, 3") +
                                 array_parameter("centre of mass", "0, 0, 0") + array_parameter("rotation", rotation),
                             "0, 0, 0", motion),
                  Geometry::space);
}

TEST(FreeBodies, ASpinningBodyFollowsEulersEquations) {
  FreeBody free = in_space(released_xml("force", "x, y, z, rotation x, rotation y, rotation z"));
  const Point spin{0.5, -1, 2};
  for (int k = 0; k < 3; ++k) free.store.committed().rate(free.dof(3 + k)) = spin[k] / free.scale(3 + k);
  const std::vector<double> a = free.release();
  // J dw/dt = -w x J w with J = diag(1, 2, 3)
  const Point turned{0.5 * 1, -1 * 2, 2 * 3}, moment = cross(spin, turned);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(a[i], 0, 1e-14);
    EXPECT_NEAR(a[3 + i], -moment[i] / (i + 1), 1e-13);
  }
  const BodyMomentum now = momentum(*free.body, free.store.committed());
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(now.angular[i], turned[i], 1e-13);
  EXPECT_NEAR(now.kinetic, 0.5 * dot(spin, turned), 1e-13);
}

TEST(FreeBodies, SpinIsAboutTheBodysOwnAxes) {
  FreeBody free = in_space(
      released_xml("free", "x, y, z, rotation x, rotation y, rotation z", array_parameter("initial spin", "0, 0, 3")),
      "90, 0, 0");  // the body's z axis is the model's -y axis, and its y axis the model's z axis
  free.release();
  const State& state = free.store.committed();
  EXPECT_NEAR(free.body->spin(state)[2], 3, 1e-14);
  EXPECT_NEAR(state.rate(free.dof(4)) * free.scale(4), 3, 1e-14);
  EXPECT_NEAR(state.rate(free.dof(5)), 0, 1e-14);
  EXPECT_NEAR(momentum(*free.body, state).angular[2], 2 * 3, 1e-13);
}

TEST(FreeBodies, AnIncrementTurnsAboutTheBodysAxes) {
  const FreeBody free = in_space(released_xml("free", "x, y, z, rotation x, rotation y, rotation z"));
  State state = free.store.committed();
  const Point increment{0.1, -0.3, 0.2};
  for (int k = 0; k < 3; ++k) state.value(free.dof(3 + k)) = increment[k] / free.scale(3 + k);
  const Rotation exact = Rotation::by_increment(increment);
  const BodyPlacement placement = free.body->placement(state);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(placement.increment[i], increment[i], 1e-15);
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(placement.turn.matrix[i][j], exact.matrix[i][j], 1e-14);
  }
  // turning() is the derivative of the rotation, as a vector in the world frame
  constexpr double h = 1e-6;
  for (int k = 0; k < 3; ++k) {
    NodalView ahead("ahead", state.value.extent(0));
    ahead(free.dof(3 + k)) = h / free.scale(3 + k);
    const Rotation more = free.body->placement(state, ahead).turn * placement.turn.inverse();
    const Point slope = placement.turning(k);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(more.vector()[i] / h, slope[i], 1e-5);
  }
}

TEST(BodyMotion, TurnsAboutChangingAxes) {
  const std::string space = section_xml("mesh", text_parameter("geometry", geometry_in_space));
  BodyDeck deck(space + body_xml("b", "",
                                 text_parameter("type", "prescribed displacement") + text_parameter("z", "2*t") +
                                     text_parameter("rotation x", "0.5*t") + number_parameter("rotation y", 0.3),
                                 "0, 0, 0"));
  const auto motion = deck.motions.create(deck.deck.root().section("bodies").section("b").section("motion"));
  BodyState state;
  for (const double t : {0.0, 0.5}) state = motion->advance(state, t, t + 0.5);
  EXPECT_NEAR(state.displacement[2], 2, 1e-15);
  EXPECT_NEAR(state.velocity[2], 2, 1e-15);
  // R(0.5, 0.3, 0) R(0, 0.3, 0)^-1, however many steps lead there
  const Rotation exact = Rotation::by({0.5, 0.3, 0}) * Rotation::by({0, 0.3, 0}).inverse();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(state.turn.matrix[i][j], exact.matrix[i][j], 1e-14);
}

TEST(BodyMotion, AHeldBodyForgetsItsVelocity) {
  BodyDeck deck(body_xml("b", "", text_parameter("type", "held")));
  const auto held = deck.motions.create(deck.deck.root().section("bodies").section("b").section("motion"));
  BodyState state;
  state.displacement = {1, 2, 0};
  state.velocity = {3, 4, 0};
  state.spin = {0, 0, 5};
  state.turn = Rotation::by({0, 0, 0.1});
  const BodyState after = held->advance(state, 0, 2);
  EXPECT_EQ(after.displacement, state.displacement);
  EXPECT_EQ(length(after.velocity) + length(after.spin), 0);
  EXPECT_EQ(after.turn.matrix[1][0], state.turn.matrix[1][0]);
  EXPECT_EQ(after.moving_time, 2);
}

}  // namespace
}  // namespace mudline
