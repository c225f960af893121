// Initial gaps, and contact that starts pressed by the soil's stress.
#include <gtest/gtest.h>

#include "contact_model.hpp"
#include "core/tests/input_error.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

constexpr double eps = 1e6;

std::string start(const std::string& kind, double distance = 0) {
  return text_parameter("initial gap", kind) +
         (distance > 0 ? number_parameter("closing distance", distance) : std::string());
}
std::string plate_contact(const std::string& more, const std::string& method = "surface quadrature") {
  return contact_parameters(method, eps) + more;
}

struct Case {
  Geometry geometry;
  Cells cells;
  const char* method;
};
class EveryStart : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(InitialGap, EveryStart,
                         testing::Values(Case{Geometry::plane_strain, Cells::quad9, "surface quadrature"},
                                         Case{Geometry::plane_strain, Cells::tri6, "nodes"},
                                         Case{Geometry::axisymmetric, Cells::tri6, "surface quadrature"},
                                         Case{Geometry::axisymmetric, Cells::quad4, "nodes"}));

TEST_P(EveryStart, ClosedGapsCountFromTheStart) {
  const Case c = GetParam();
  for (const double gap : {0.01, -0.01}) {
    ContactModel model(c.geometry, strip(c.cells, 4, 1, 0, 2, 1, 0), plate_xml(gap, 0.004),
                       plate_contact(start("closed", 0.02), c.method));
    model.first_act();
    Report values = model.step(1);  // 4 mm towards the soil
    const double area = values.at("contact/c/contact area").value;
    EXPECT_NEAR(area, c.geometry == Geometry::axisymmetric ? std::acos(-1.0) * 4 : 2, 1e-12);
    EXPECT_NEAR(values.at("contact/c/reaction y").value, eps * 0.004 * area, 1e-12 * eps);
    EXPECT_NEAR(values.at("contact/c/maximum penetration").value, 0.004, 1e-15);
    // a later stage does not adjust gaps again
    model.first_act();
    values = model.step(1);
    EXPECT_NEAR(values.at("contact/c/maximum penetration").value, 0.008, 1e-15);
  }
}

TEST_P(EveryStart, FartherPointsKeepTheirGaps) {
  const Case c = GetParam();
  ContactModel model(c.geometry, strip(c.cells, 4, 1, 0, 2, 1, 0), plate_xml(-0.01),
                     plate_contact(start("closed", 0.009), c.method));
  model.first_act();
  EXPECT_NEAR(model.step(1).at("contact/c/maximum penetration").value, 0.01, 1e-15);
}

TEST_P(EveryStart, PressesWithTheTractionOfTheSoil) {
  const Case c = GetParam();
  // sigma_yy = -(3 + x) kPa, and shear that the contact does not take
  const auto stress = [](const Point& x) { return std::array<double, 6>{-900, -1000 * (3 + x[0]), -700, 0, 0, 250}; };
  for (const char* more : {"", "smoothed", "augmented"}) {
    std::string parameters = plate_contact(start("in-situ stress", 0.02), c.method);
    if (std::string(more) == "augmented") parameters += text_parameter("enforcement", "augmented Lagrangian");
    if (std::string(more) == "smoothed")
      parameters += section_xml("normal law", text_parameter("type", "smoothed") + number_parameter("depth", 3.5e-3));
    ContactModel model(c.geometry, strip(c.cells, 4, 1, 0, 2, 1, 0), plate_xml(0.01), parameters, {},
                       "frictionless penalty", Support::vertices, false, {}, stress);
    model.first_act();
    const PointView& before = model.points(model.store.committed());
    const int force = model.mesh.dimension() + 2;  // its y component
    std::vector<double> pressures, forces;
    for (std::size_t row = 0; row < before.extent(0); ++row) {
      pressures.push_back(before(row, 1));
      forces.push_back(before(row, force));
    }
    model.step(1);  // nothing moves: the contact finds the values of the first state
    const PointView& after = model.points(model.store.committed());
    const auto [least, most] = std::minmax_element(pressures.begin(), pressures.end());
    EXPECT_GT(*least, 2999) << more;
    EXPECT_GT(*most, 4500) << more;
    EXPECT_LT(*most, 5001) << more;
    for (std::size_t row = 0; row < after.extent(0); ++row) {
      EXPECT_EQ(after(row, 2), 1) << more;
      EXPECT_NEAR(after(row, 1), pressures[row], 1e-8) << more;
      EXPECT_NEAR(after(row, force), forces[row], 1e-8) << more;
      EXPECT_NEAR(after(row, 1) * after(row, 5), -after(row, 4), 1e-8) << more;
    }
  }
}

TEST(InitialGap, ForcesAreThoseOfTheStressOnTheSurface) {
  const auto stress = [](const Point& x) { return std::array<double, 6>{-900, -1000 * (3 + x[0]), -700, 0, 0, 0}; };
  ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 4, 1, 0), plate_xml(0.01),
                     plate_contact(start("in-situ stress")), {}, "frictionless penalty", Support::vertices, false, {},
                     stress);
  model.first_act();
  const Report values = model.step(1);
  EXPECT_NEAR(values.at("contact/c/reaction y").value, 1000 * (3 * 4 + 8), 1e-7);
  EXPECT_NEAR(values.at("contact/c/maximum penetration").value, 1e-3 * (3 + 4), 1e-3);
}

TEST(InitialGap, SoilThatPullsStartsWithoutPressure) {
  const auto tension = [](const Point&) { return std::array<double, 6>{0, 500, 0, 0, 0, 0}; };
  ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 4, 1, 0), plate_xml(-0.01),
                     plate_contact(start("in-situ stress")), {}, "frictionless penalty", Support::vertices, false, {},
                     tension);
  model.first_act();
  EXPECT_EQ(model.step(1).at("contact/c/reaction y").value, 0);
}

TEST(InitialGap, AFilmTakesThePorePressureAndTheContactTheRest) {
  const auto stress = [](const Point&) { return std::array<double, 6>{-900, -1000, -700, 0, 0, 0}; };
  ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 4, 1, 0), plate_xml(0.01),
                     plate_contact(start("in-situ stress") + text_parameter("drainage", "film")), {},
                     "frictionless penalty", Support::vertices, false, {}, stress);
  for (int node = 0; node < model.mesh.num_nodes(); ++node)
    if (const int dof = model.space.node_dof(1)(node); dof >= 0) model.store.committed().value(dof) = 400;
  model.first_act();
  const Report values = model.step(1);
  EXPECT_NEAR(values.at("contact/c/reaction y").value, 4000, 1e-8);
  EXPECT_NEAR(values.at("contact/c/film force y").value, 1600, 1e-8);
  EXPECT_NEAR(values.at("contact/c/maximum penetration").value, 600 / eps, 1e-15);
}

TEST(InitialGap, JacobianIsTheDifferencedResidual) {
  const auto stress = [](const Point&) { return std::array<double, 6>{-1000, -1000, -1000, 0, 0, 0}; };
  const std::string cylinder = body_xml(
      "b", text_parameter("type", "sphere") + text_parameter("extent", "full") + number_parameter("diameter", 3.0),
      text_parameter("type", "prescribed velocity") + number_parameter("velocity x", 2e-4), "0, -0.02");
  for (const char* law : {"", "augmented Lagrangian"}) {
    std::string parameters =
        plate_contact(start("in-situ stress", 0.06)) +
        section_xml("friction", text_parameter("type", "coulomb") + number_parameter("coefficient", 0.2) +
                                    text_parameter("on", "total"));
    if (*law) parameters += text_parameter("enforcement", law);
    ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 4, 2, -0.3, 0.6, 1, 0.1), cylinder, parameters, {},
                       "penalty", Support::vertices, false, {}, stress);
    model.first_act();
    model.begin(1);
    deform(model, 1e-4);
    EXPECT_LT(jacobian_error(model), 1e-6) << law;
    EXPECT_GT(model.points(model.store.trial())(0, 1), 0) << law;
  }
}

TEST(InitialGap, SidesThatLookPastTheBodyStayAsTheyAre) {
  // a wall beside the surface, at its left end: nearer than the closing distance, but not in front of it
  const std::string wall = body_xml("b",
                                    text_parameter("type", "polyline") + text_parameter("extent", "full") +
                                        array_parameter("x", "0, 0, -1, -1") + array_parameter("y", "-2, 2, 2, -2"),
                                    text_parameter("type", "prescribed velocity"), "-0.01, 0");
  ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 1, 1, 0), wall,
                     plate_contact(start("closed", 0.1)));
  model.first_act();
  const PointView& offset = model.store.committed().arrays[model.store.find("contact/c/initial gap")];
  for (std::size_t row = 0; row < offset.extent(0); ++row) EXPECT_EQ(offset(row, 0), 0);
}

TEST(InitialGap, IsConvectedWithTheSides) {
  // a plate that leans: the gap, and so the offset, is linear along the surface
  const std::string leaning = body_xml("b",
                                       text_parameter("type", "polyline") + text_parameter("extent", "full") +
                                           array_parameter("x", "-5, 5") + array_parameter("y", "-0.05, 0.05"),
                                       text_parameter("type", "prescribed velocity"), "0, 0.02");
  ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 1, 1, 0), leaning,
                     plate_contact(start("closed", 0.05)));
  model.first_act();
  State& committed = model.store.committed();
  const PointView& offset = committed.arrays[model.store.find("contact/c/initial gap")];
  std::vector<double> before;
  for (std::size_t row = 0; row < offset.extent(0); ++row) before.push_back(offset(row, 0));
  CoordinateView old("old", committed.coordinates.extent(0), committed.coordinates.extent(1));
  Kokkos::deep_copy(old, committed.coordinates);
  for (int node = 0; node < model.mesh.num_nodes(); ++node) committed.coordinates(node, 0) += 0.03;
  model.follow(old);
  const double slope = 0.01 / std::sqrt(1 + 1e-4);
  for (std::size_t row = 0; row < offset.extent(0); ++row)
    EXPECT_NEAR(offset(row, 0) - before[row], slope * 0.03, 1e-12);
}

TEST(InitialGap, ADistanceWithoutAnAdjustmentIsRefused) {
  EXPECT_NE(input_error([] {
              ContactModel(Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 4, 1, 0), plate_xml(0),
                           plate_contact(number_parameter("closing distance", 0.1)));
            }).find("initial gap"),
            std::string::npos);
}

}  // namespace
}  // namespace mudline
