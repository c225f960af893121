#include <gtest/gtest.h>

#include "contact/contact_rule.hpp"
#include "contact_model.hpp"
#include "core/pi.hpp"
#include "core/tests/input_error.hpp"

namespace mudline {
namespace {

constexpr double eps = 1e6;

/// 3 x 3 x 1 cells over [-0.6, 0.6]^2 x [-0.5, 0], the side set "surface" on top.
GlobalMesh block(const std::string& cell, double distortion = 0) {
  return box_in_space(cell, "{3, 3, 1}", "-0.6, -0.6, -0.5", "0.6, 0.6, 0", distortion);
}

std::string in_space(const std::string& surface, const std::string& motion, const std::string& position) {
  return "<ParameterList name=\"bodies\">\n<ParameterList name=\"b\">\n" + array_parameter("position", position) +
         "<ParameterList name=\"surface\">\n" + surface + "</ParameterList>\n<ParameterList name=\"motion\">\n" +
         text_parameter("type", "prescribed displacement") + motion +
         "</ParameterList>\n</ParameterList>\n</ParameterList>\n";
}
std::string plate(const std::string& motion, const std::string& position) {
  return in_space(text_parameter("type", "box") + number_parameter("length x", 4) + number_parameter("length y", 4) +
                      number_parameter("length z", 1) + array_parameter("position", "0, 0, 0.5"),
                  motion, position);
}
std::string ball(const std::string& motion, const std::string& position) {
  return in_space(text_parameter("type", "revolved") + "<ParameterList name=\"contour\">\n" +
                      text_parameter("type", "sphere") + number_parameter("diameter", 2) + "</ParameterList>\n",
                  motion, position);
}
std::string function(const std::string& name, const std::string& value) { return text_parameter(name, value); }
std::string coulomb(double coefficient, double adhesion) {
  return "<ParameterList name=\"friction\">\n" + text_parameter("type", "coulomb") +
         number_parameter("coefficient", coefficient) + number_parameter("adhesion", adhesion) +
         text_parameter("on", "effective") + "</ParameterList>\n";
}
std::string contact() { return contact_parameters("surface quadrature", eps); }

TEST(ContactRule, IntegralsOfMultiplierShapesArePositive) {
  for (CellShape side : {CellShape::line2, CellShape::line3, CellShape::tri3, CellShape::tri6, CellShape::quad4,
                         CellShape::quad8, CellShape::quad9}) {
    const ContactRule rule(SideRule::At::gauss, side, 5);
    double sum = 0;
    for (int a = 0; a < rule.multipliers; ++a) {
      double integral = 0;
      for (int c = 0; c < rule.points; ++c) integral += rule.weight(c, c) * rule.multiplier_shape(c)[a];
      EXPECT_GT(integral, 0.02 * reference_size(side)) << name(side) << ", node " << a;
      sum += integral;
    }
    EXPECT_NEAR(sum, reference_size(side), 1e-13) << name(side);
  }
}

class ContactInSpace : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Contact, ContactInSpace,
                         testing::Values("tet4", "tet10", "hex8", "hex27", "wedge6", "wedge15"));

TEST_P(ContactInSpace, PlatePressesUniformly) {
  ContactModel model(Geometry::space, block(GetParam(), 0.2), plate("", "0, 0, -0.01"), contact());
  const auto values = model.step(1);
  EXPECT_NEAR(values.at("contact/c/reaction z").value, eps * 0.01 * 1.44, 1e-8);
  EXPECT_NEAR(values.at("contact/c/reaction x").value, 0, 1e-9);
  EXPECT_NEAR(values.at("contact/c/contact area").value, 1.44, 1e-13);
  const auto pressure = model.contact->nodal_pressure(model.store.committed());
  for (int node = 0; node < model.mesh.num_nodes(); ++node)
    EXPECT_NEAR(pressure[node], model.mesh.place(node)[2] == 0 ? eps * 0.01 : 0, 1e-6);
}

TEST_P(ContactInSpace, MultipliersOfAFixedGapGrowByThePenaltyTimesIt) {
  const double depth = 0.01;
  ContactModel model(Geometry::space, block(GetParam(), 0.2), plate("", "0, 0, -0.01"),
                     contact() + text_parameter("enforcement", "augmented Lagrangian"));
  model.begin(1);
  for (int count = 0; count < 4; ++count) {
    model.residual();
    const PointView& rows = model.points(model.store.trial());
    for (std::size_t row = 0; row < rows.extent(0); ++row)
      EXPECT_NEAR(rows(row, 1), (count + 1) * eps * depth, 1e-3 * eps * depth);
    EXPECT_TRUE(model.contact->augment(model.view, count).again);
  }
}

TEST_P(ContactInSpace, HeightsAreThoseOfTheCells) {
  ContactModel model(Geometry::space, block(GetParam()), plate("", "0, 0, -0.01"),
                     text_parameter("body", "b") + text_parameter("surface", "surface"), [](int, int) { return 3e5; });
  model.begin(1);
  const PointView& rows = model.store.trial().arrays[model.store.find("contact/c/penalty")];
  ASSERT_GT(rows.extent(0), 0u);
  for (std::size_t s = 0; s < rows.extent(0); ++s) EXPECT_NEAR(10 * 3e5 / rows(s, 0), 0.5, 1e-12);
}

TEST_P(ContactInSpace, JacobianIsTheDifferencedResidual) {
  // a ball moves along the surface, rotates and presses in one step: some points stick, others slide
  const std::string motion = function("x", "0.004*t") + function("y", "-0.007*t") + function("z", "-0.03*t") +
                             function("rotation x", "0.01*t") + function("rotation z", "0.02*t");
  for (const char* more : {"", "smooth", "augmented"}) {
    std::string parameters = contact();
    if (std::string(more) != "smooth") parameters += coulomb(0.3, 400);
    if (std::string(more) == "augmented") parameters += text_parameter("enforcement", "augmented Lagrangian");
    ContactModel model(Geometry::space, block(GetParam(), 0.2), ball(motion, "0.1, 0.05, -0.02"), parameters, {},
                       std::string(more) == "smooth" ? "frictionless penalty" : "penalty");
    model.step(1);
    model.begin(1);
    deform(model, 0.003);
    EXPECT_LT(jacobian_error(model), 2e-6) << more;
    if (std::string(more) != "smooth") {
      EXPECT_LT(jacobian_error(model, Moved::pressures), 1e-6) << more;
      int stick = 0, slide = 0;
      const PointView& points = model.points(model.store.trial());
      const PointView& shear = model.store.trial().arrays[model.store.find("contact/c/friction")];
      for (std::size_t row = 0; row < points.extent(0); ++row)
        if (points(row, 2) > 0) (shear(row, 5) > 0 ? slide : stick) += 1;
      EXPECT_GT(stick, 0);
      EXPECT_GT(slide, 0);
    }
    EXPECT_EQ(model.failures, 0);
  }
}

TEST_P(ContactInSpace, FrictionIsAVectorAgainstTheTravel) {
  // pressed first, then dragged in the direction (3, 4, 0)
  const std::string motion =
      function("z", "-0.01*min(t,1)") + function("x", "3e-3*max(t-1,0)") + function("y", "4e-3*max(t-1,0)");
  ContactModel model(Geometry::space, block(GetParam()), plate(motion, "0, 0, 0"), contact() + coulomb(0.2, 0), {},
                     "penalty");
  model.step(1);
  auto values = model.step(0.2);  // 1 mm: the spring along the surface is as stiff as the normal one
  const double normal = eps * 0.01 * 1.44;
  EXPECT_NEAR(values.at("contact/c/friction x").value, -0.6 * normal * 0.1, 1e-9 * normal);
  EXPECT_NEAR(values.at("contact/c/friction y").value, -0.8 * normal * 0.1, 1e-9 * normal);
  EXPECT_EQ(values.at("contact/c/sliding points").value, 0);
  values = model.step(1);
  EXPECT_NEAR(values.at("contact/c/friction x").value, -0.6 * normal * 0.2, 1e-9 * normal);
  EXPECT_NEAR(values.at("contact/c/friction y").value, -0.8 * normal * 0.2, 1e-9 * normal);
  // the travel is 6 mm, of which the spring keeps 2 mm; the heat is force times path
  EXPECT_NEAR(values.at("contact/c/friction heat").value, 0.2 * normal * 0.004, 1e-9 * normal);
  EXPECT_NEAR(values.at("contact/c/friction z").value, 0, 1e-9 * normal);
}

TEST_P(ContactInSpace, HistoryStaysWhereItIsWhenTheMeshMoves) {
  // a plate that turns a little and sticks: the shear stress is that of a twist, linear over the surface
  const double angle = 1e-3;
  const std::string motion =
      function("z", "-0.01*min(t,1)") + function("rotation z", std::to_string(angle) + "*max(t-1,0)");
  ContactModel model(Geometry::space, block(GetParam()), plate(motion, "0, 0, 0"), contact() + coulomb(0.9, 0), {},
                     "penalty");
  model.step(1);
  model.step(1);
  State& committed = model.store.committed();
  const PointView& rows = committed.arrays[model.store.find("contact/c/friction")];
  std::vector<Point> before;  // shear: -stiffness angle (-y, x), to first order in the angle
  double largest = 0;
  for (std::size_t row = 0; row < rows.extent(0); ++row) {
    before.push_back({rows(row, 0), rows(row, 1), rows(row, 2)});
    largest = std::max({largest, std::abs(rows(row, 0)), std::abs(rows(row, 1))});
  }
  ASSERT_GT(largest, 100);
  CoordinateView old("old", committed.coordinates.extent(0), 3);
  Kokkos::deep_copy(old, committed.coordinates);
  for (int node = 0; node < model.mesh.num_nodes(); ++node) {
    committed.coordinates(node, 0) += 0.05 * old(node, 0) - 0.03 * old(node, 1);
    committed.coordinates(node, 1) += 0.02 * old(node, 0) + 0.04 * old(node, 1);
  }
  model.follow(old);
  for (std::size_t row = 0; row < rows.extent(0); ++row) {
    const double x = before[row][1], y = -before[row][0];  // in proportion to the position
    EXPECT_NEAR(rows(row, 0), before[row][0] - (0.02 * x + 0.04 * y), 0.08 * angle * largest);
    EXPECT_NEAR(rows(row, 1), before[row][1] + 0.05 * x - 0.03 * y, 0.08 * angle * largest);
    EXPECT_NEAR(rows(row, 2), before[row][2], 1e-9 * largest);
  }
}

TEST(ContactInSpaceFriction, SpinningPlateMakesATorque) {
  const std::string motion = function("z", "-0.01*min(t,1)") + function("rotation z", "0.2*max(t-1,0)");
  ContactModel model(Geometry::space, block("hex27"), plate(motion, "0, 0, 0"), contact() + coulomb(0.2, 0), {},
                     "penalty");
  model.step(1);
  double work = 0, before = 0;
  for (int i = 0; i < 10; ++i) {
    const auto values = model.step(0.1);
    work = values.at("contact/c/work").value;
    if (i == 8) before = work;
    EXPECT_NEAR(values.at("contact/c/friction x").value, 0, 1e-6);
  }
  // torque on a square of side a under the pressure p where all slides: mu p a^3 (sqrt 2 + asinh 1) / 6
  const double torque = 0.2 * eps * 0.01 * std::pow(1.2, 3) * (std::sqrt(2) + std::asinh(1)) / 6;
  EXPECT_NEAR((work - before) / 0.02 / torque, 1, 0.01);
}

TEST(ContactInSpaceFriction, TurnedBodyKeepsTheStressThatSticksToIt) {
  // body and soil turn together: the traction turns with them
  const double angle = 0.7;
  const std::string motion = function("z", "-0.01*min(t,1)") + function("x", "1e-3*max(min(t-1,1),0)") +
                             function("rotation z", std::to_string(angle) + "*max(t-2,0)");
  ContactModel model(Geometry::space, block("hex8"), plate(motion, "0, 0, 0"), contact() + coulomb(0.9, 0), {},
                     "penalty");
  model.step(1);
  const auto straight = model.step(1);
  model.begin(1);
  for (int node = 0; node < model.mesh.num_nodes(); ++node) {
    // the whole rotates about the body's centre, which has moved by 1 mm
    const Point x = model.mesh.place(node);
    State& trial = model.store.trial();
    trial.coordinates(node, 0) = 1e-3 + std::cos(angle) * (x[0] - 1e-3) - std::sin(angle) * x[1];
    trial.coordinates(node, 1) = std::sin(angle) * (x[0] - 1e-3) + std::cos(angle) * x[1];
  }
  model.residual();
  model.store.accept();
  Report turned;
  model.contact->histories(model.view, turned);
  const double along = straight.at("contact/c/friction x").value;
  ASSERT_LT(along, -1000);
  EXPECT_NEAR(turned.at("contact/c/friction x").value, std::cos(angle) * along, 1e-9 * -along);
  EXPECT_NEAR(turned.at("contact/c/friction y").value, std::sin(angle) * along, 1e-9 * -along);
}

/// Largest drag of a ball of 1 m radius over the normal force, while its centre moves by 0.5 m at 0.995 m above the
/// surface.
double drag(const std::string& turning) {
  const std::string sphere = text_parameter("type", "revolved") + array_parameter("position", "0, 0, -1") +
                             "<ParameterList name=\"contour\">\n" + text_parameter("type", "sphere") +
                             number_parameter("diameter", 2) + "</ParameterList>\n";
  ContactModel model(Geometry::space, block("hex27"),
                     in_space(sphere, function("x", "0.05*t") + turning, "-0.3, 0, 0.995"), contact() + coulomb(5, 0),
                     {}, "penalty");
  double largest = 0;
  for (int i = 0; i < 10; ++i) {
    const auto values = model.step(1);
    const double normal = values.at("contact/c/reaction z").value;
    EXPECT_GT(normal, 10);
    largest = std::max(largest, std::abs(values.at("contact/c/friction x").value / normal));
  }
  return largest;
}

TEST(ContactInSpaceFriction, RollingBallDoesNotSlip) {
  // what is left comes from the displacement down the ball's slope, a third of the touching radius (0.1 m) cubed
  const double rolling = drag(function("rotation y", "0.05/0.995*t")), dragged = drag("");
  EXPECT_LT(rolling, 0.15);
  EXPECT_GT(dragged, 20 * rolling);
}

TEST(ContactInSpaceFriction, WrongEntriesAreNamed) {
  const auto made = [](const std::string& bodies, const std::string& parameters) {
    ContactModel(Geometry::space, block("tet10"), bodies, parameters, {}, "penalty");
  };
  EXPECT_NE(input_error([&] {
              made(plate("", "0, 0, 0"), contact_parameters("nodes", eps));
            }).find("allowed in space: surface quadrature"),
            std::string::npos);
  const std::string degree = "<Parameter name=\"quadrature degree\" type=\"int\" value=\"9\"/>\n";
  EXPECT_NE(input_error([&] {
              made(plate("", "0, 0, 0"), contact() + degree);
            }).find("largest 'quadrature degree' is 8, given 9"),
            std::string::npos);
  EXPECT_NE(input_error([&] { made(plate("", "0, 0, -0.4"), contact()); }).find("overlaps the surface by 0.4 m at ("),
            std::string::npos);
  EXPECT_NE(input_error([&] { made(ball("", "0, 0, -3"), contact()); }).find("lies below the surface"),
            std::string::npos);
  std::string contour = ball("", "0, 0, 0");
  for (std::size_t at = 0; (at = contour.find("\"surface\"", at)) != std::string::npos;)
    contour.replace(at, 9, "\"contour\"");
  EXPECT_NE(input_error([&] { made(contour, contact()); }).find("a body in space has a 'surface'"), std::string::npos);
}

}  // namespace
}  // namespace mudline
