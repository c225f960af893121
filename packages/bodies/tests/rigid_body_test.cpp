#include "bodies/rigid_body.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bodies/tests/rigid_body_deck.hpp"
#include "core/tests/input_error.hpp"

namespace mudline {
namespace {

std::unique_ptr<BodyMotion> motion(const std::string& parameters) {
  BodyDeck deck(body_xml("b", "", parameters));
  return deck.motions.create(deck.deck.root().section("bodies").section("b").section("motion"));
}

TEST(BodyMotion, RampedVelocityIsIntegratedExactly) {
  const auto push = motion(text_parameter("type", "prescribed velocity") + number_parameter("velocity y", -2.0) +
                           number_parameter("ramp time", 0.5));
  // the second step straddles the end of the ramp: half of the ramp time is lost in total
  BodyState state = push->advance({}, 10.0, 10.3);
  const double s = 0.3 / 0.5;
  EXPECT_NEAR(state.displacement[1], -2 * 0.5 * (s * s * s - 0.5 * s * s * s * s), 1e-15);
  EXPECT_NEAR(state.velocity[1], -2 * s * s * (3 - 2 * s), 1e-14);
  state = push->advance(state, 10.3, 12.0);
  EXPECT_NEAR(state.displacement[1], -2 * (2.0 - 0.25), 1e-14);
  EXPECT_EQ(state.velocity[1], -2);
  EXPECT_EQ(state.displacement[0], 0);
}

TEST(BodyMotion, VelocityFollowsTheAbsoluteTime) {
  const auto shake = motion(text_parameter("type", "prescribed velocity") + text_parameter("velocity x", "cos(3*t)"));
  BodyState state;
  for (int i = 0; i < 20; ++i) state = shake->advance(state, 0.1 * i, 0.1 * (i + 1));
  EXPECT_NEAR(state.displacement[0], std::sin(6.0) / 3, 1e-9);
  EXPECT_TRUE(shake->moves(0));
}

TEST(BodyMotion, SpinInSpaceTurnsAboutItsAxis) {
  const std::string space =
      "<ParameterList name=\"mesh\">\n" + text_parameter("geometry", geometry_in_space) + "</ParameterList>\n";
  BodyDeck deck(space + body_xml("b", "",
                                 text_parameter("type", "prescribed velocity") + number_parameter("velocity z", -0.5) +
                                     number_parameter("spin x", 0.3) + text_parameter("spin y", "-0.6*t") +
                                     number_parameter("spin z", 0.2),
                                 "0, 0, 0"));
  const auto screw = deck.motions.create(deck.deck.root().section("bodies").section("b").section("motion"));
  EXPECT_TRUE(screw->turns());
  EXPECT_TRUE(screw->moves(2));
  EXPECT_FALSE(screw->moves(0));
  const BodyState end = screw->advance({}, 0.0, 2.0);
  EXPECT_NEAR(end.displacement[2], -1.0, 1e-14);
  const Point turned{0.6, -1.2, 0.4}, spin{0.3, -1.2, 0.2};  // the rotation vector is the integral of the spin
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(end.turn.vector()[i], turned[i], 1e-14);
    EXPECT_NEAR(end.spin[i], spin[i], 1e-14);
  }
}

TEST(BodyMotion, DisplacementCountsChangesOnly) {
  const auto pull = motion(text_parameter("type", "prescribed displacement") + text_parameter("y", "1 + t^2"));
  const BodyState state = pull->advance({{0, 5}, {}, {}, {}, 0}, 1.0, 3.0);
  EXPECT_NEAR(state.displacement[1], 5 + 8, 1e-14);
  EXPECT_NEAR(state.velocity[1], 4, 1e-14);
  EXPECT_FALSE(pull->moves(0));
}

TEST(RigidBody, ALyingBeamIsAsWideAsItsSectionWhereItMovesDown) {
  BodyDeck deck(shaped_xml("surface", beam(4, 0.3, 0.3), "", "1, 2, 3"));
  const auto body = deck.body("b", Geometry::space);
  const BodyPlacement placement = body->initial_placement();
  EXPECT_NEAR(body->shadow(placement, {0, 0, -1}).width, 0.3, 0.005);
  EXPECT_NEAR(body->shadow(placement, {0, 0, -1}).length, 4, 0.05);
  EXPECT_NEAR(body->shadow(placement, {1, 0, 0}).length, 0.3, 0.005);
}

TEST(RigidBody, TurnedAtTheStartItIsTheBodyThatIsDrawnTurned) {
  // a quarter turn about x takes y to z and z to -y
  const auto read = [](const std::string& surface, const std::string& more) {
    BodyDeck deck(shaped_xml("surface", surface, more, "1, 2, 3"));
    return deck.body("b", Geometry::space);
  };
  const std::string mass = number_parameter("mass", 100);
  const auto turned = read(beam(0.8, 0.5, 0.2), mass + array_parameter("rotation", "90, 0, 0") +
                                                    array_parameter("centre of mass", "0.1, 0.05, -0.02")),
             drawn = read(beam(0.8, 0.2, 0.5), mass + array_parameter("centre of mass", "0.1, 0.02, 0.05"));
  const BodyPlacement a = turned->initial_placement(), b = drawn->initial_placement();
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a.centre[i], b.centre[i], 1e-14);
  for (const Point& x : {Point{1.7, 2.3, 3.4}, Point{1.1, 1.7, 3.05}, Point{0.3, 2, 2.9}}) {
    EXPECT_NEAR(turned->gap(a, x), drawn->gap(b, x), 1e-12);
    const SurfaceProjection here = turned->projection(a, x), there = drawn->projection(b, x);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(here.normal[i], there.normal[i], 1e-9);
      EXPECT_NEAR(here.point[i], there.point[i], 1e-9);
    }
  }
  EXPECT_NEAR(turned->shadow(a, {0, 0, 1}).width, 0.2, 0.005);
  EXPECT_NEAR(turned->own_height(), 0.2, 1e-9);
  const BodyInstant at = turned->initial_instant();
  EXPECT_NEAR(at.axes.axis[1][2].v, 1, 1e-15);
  EXPECT_NEAR(at.axes.axis[2][1].v, -1, 1e-15);
}

TEST(RigidBody, ATurnedContourCoversWhatItCoversTurned) {
  const std::string plate = text_parameter("type", "strip") + text_parameter("extent", "full") +
                            number_parameter("width", 2) + number_parameter("thickness", 0.5);
  const auto read = [&](const std::string& rotation) {
    BodyDeck deck(shaped_xml("contour", plate, array_parameter("rotation", rotation), "0, 1"));
    return deck.body("b", Geometry::plane_strain);
  };
  const auto lies = read("0"), stands = read("90");
  EXPECT_NEAR(lies->properties().frontal_area, 2, 1e-12);
  EXPECT_NEAR(stands->properties().frontal_area, 0.5, 1e-12);
  EXPECT_NEAR(stands->shadow(stands->initial_placement(), {1, 0, 0}).width, 2, 1e-12);
  // it stands to the left of its reference point, the middle of its base
  EXPECT_NEAR(stands->gap(stands->initial_placement(), {0.25, 1}), 0.25, 1e-12);
  EXPECT_NEAR(stands->gap(stands->initial_placement(), {-0.25, 2.3}), 0.3, 1e-12);
}

TEST(RigidBody, WrongEntriesAreNamed) {
  const std::string pile = text_parameter("type", "flat pile") + number_parameter("diameter", 1);
  const std::string still = text_parameter("type", "prescribed velocity");
  const auto error = [](const std::string& xml, Geometry geometry) {
    return input_error([&] { BodyDeck(xml).body("b", geometry); });
  };
  const auto has = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  has(error(body_xml("b", pile + text_parameter("extent", "full"), still), Geometry::axisymmetric),
      "a half contour, not a full one");
  has(error(body_xml("b", pile, still, "0.1, 0"), Geometry::axisymmetric), "bodies/b/position: the axis");
  has(error(body_xml("b", pile, still, "0, 0", array_parameter("rotation", "30")), Geometry::axisymmetric),
      "bodies/b/rotation: a body with a half contour stands upright on its axis");
  has(error(body_xml("b", pile, still, "0, 0", array_parameter("rotation", "0, 0, 30")), Geometry::plane_strain),
      "bodies/b/rotation: expected 1 number, the angle in degrees, given 3");
  has(error(body_xml("b", pile, still + number_parameter("velocity x", 1)), Geometry::plane_strain),
      "cannot leave its axis");
  has(error(body_xml("b", pile, still + number_parameter("ramp time", -1)), Geometry::plane_strain), "ramp time");
  has(error(body_xml("b", pile, text_parameter("type", "fall")), Geometry::plane_strain), "unknown motion type 'fall'");
  has(error(body_xml("b", pile, still + number_parameter("velocty y", 1)), Geometry::plane_strain), "velocty y");
}

}  // namespace
}  // namespace mudline
