#include <gtest/gtest.h>

#include <array>

#include "contact_model.hpp"
#include "core/tests/input_error.hpp"

namespace mudline {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double eps = 1e6;

std::string cylinder_xml(double diameter, double y) {
  return body_xml("b", text_parameter("type", "sphere") + number_parameter("diameter", diameter),
                  text_parameter("type", "prescribed velocity"), "0, " + std::to_string(y));
}

std::string pile_xml(double diameter, double y, double speed) {
  return body_xml("b", text_parameter("type", "flat pile") + number_parameter("diameter", diameter),
                  text_parameter("type", "prescribed velocity") + number_parameter("velocity y", -speed),
                  "0, " + std::to_string(y));
}

struct Case {
  Geometry geometry;
  Cells cells;
  const char* method;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << (c.geometry == Geometry::axisymmetric ? "axisymmetric" : "plane strain") << ", "
             << (c.cells == Cells::quad9  ? "quad9"
                 : c.cells == Cells::tri6 ? "tri6"
                                          : "quad4")
             << ", " << c.method;
}

class EveryContact : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Contact, EveryContact,
                         testing::Values(Case{Geometry::plane_strain, Cells::quad9, "surface quadrature"},
                                         Case{Geometry::plane_strain, Cells::tri6, "nodes"},
                                         Case{Geometry::plane_strain, Cells::quad4, "surface quadrature"},
                                         Case{Geometry::plane_strain, Cells::quad4, "nodes"},
                                         Case{Geometry::axisymmetric, Cells::quad9, "nodes"},
                                         Case{Geometry::axisymmetric, Cells::tri6, "surface quadrature"},
                                         Case{Geometry::axisymmetric, Cells::quad4, "nodes"}));

TEST_P(EveryContact, FlatPlatePressesUniformly) {
  const Case c = GetParam();
  const double penetration = 0.01, width = 2;
  ContactModel model(c.geometry, strip(c.cells, 5, 2, 0, width, 1, 0), plate_xml(-penetration),
                     contact_parameters(c.method, eps));
  const auto values = model.step(1);
  const double area = c.geometry == Geometry::axisymmetric ? pi * width * width : width;
  EXPECT_NEAR(values.at("contact/c/reaction y").value, eps * penetration * area, 1e-12 * eps * area);
  EXPECT_NEAR(values.at("contact/c/reaction x").value, 0, 1e-9);
  EXPECT_NEAR(values.at("contact/c/contact area").value, area, 1e-12 * area);
  EXPECT_NEAR(values.at("contact/c/maximum penetration").value, penetration, 1e-15);
  const auto pressure = model.contact->nodal_pressure(model.store.committed());
  for (int node = 0; node < model.mesh.num_nodes(); ++node)
    EXPECT_NEAR(pressure[node], model.mesh.coordinates()(node, 1) == 0 ? eps * penetration : 0, 1e-6);
}

TEST_P(EveryContact, UniformPressureGivesConsistentNodalForces) {
  const Case c = GetParam();
  if (c.geometry == Geometry::axisymmetric) return;
  const int sides = 4;
  ContactModel model(c.geometry, strip(c.cells, sides, 1, 0, 4, 1, 0), plate_xml(-0.01),
                     contact_parameters(c.method, eps));
  model.begin(1);
  const NodalView f = model.residual();
  const double load = eps * 0.01;
  for (int node = 0; node < model.mesh.num_nodes(); ++node) {
    const double x = model.mesh.coordinates()(node, 0);
    if (model.mesh.coordinates()(node, 1) != 0) continue;
    const bool end = x == 0 || x == 4, vertex = model.mesh.is_vertex()[node];
    const double share = c.cells == Cells::quad4 ? (end ? 0.5 : 1.0) : !vertex ? 4.0 / 6 : end ? 1.0 / 6 : 2.0 / 6;
    // pressed down: the residual is minus the force on the soil
    EXPECT_NEAR(f(model.dof(node, 1)), load * share, 1e-9) << x;
    EXPECT_NEAR(f(model.dof(node, 0)), 0, 1e-9);
  }
}

int active_points(ContactModel& model) {
  int count = 0;
  const PointView& rows = model.points(model.store.trial());
  for (std::size_t i = 0; i < rows.extent(0); ++i) count += rows(i, 2) > 0;
  return count;
}

TEST_P(EveryContact, JacobianIsTheDifferencedResidual) {
  const Case c = GetParam();
  const std::string cone = text_parameter("type", "cone") + number_parameter("diameter", 1.0) +
                           number_parameter("apex angle [deg]", 120) + number_parameter("tip radius", 0.3) +
                           number_parameter("shoulder radius", 0.2);
  // first number: position of the tip; second: number of points that must touch (all, some, none)
  for (const auto& [tip, touching] : {std::pair<double, int>{0.3, 0}, {-0.12, 1}, {-0.45, 2}}) {
    const auto body = body_xml(
        "b", cone, text_parameter("type", "prescribed velocity") + number_parameter("velocity y", tip), "0, 0");
    ContactModel model(c.geometry, strip(c.cells, 4, 2, 0, touching == 2 ? 0.4 : 1.0, 1, 0.5), body,
                       contact_parameters(c.method, eps));
    model.begin(1);
    deform(model, 0.02);
    EXPECT_LT(jacobian_error(model), 1e-6) << tip;
    const int active = active_points(model), all = static_cast<int>(model.points(model.store.trial()).extent(0));
    EXPECT_EQ(active == 0, touching == 0) << tip;
    EXPECT_EQ(active == all, touching == 2) << tip;
    EXPECT_EQ(model.failures, 0);
  }
}

std::string smoothed(double depth) {
  return "<ParameterList name=\"normal law\">\n" + text_parameter("type", "smoothed") +
         number_parameter("depth", depth) + "</ParameterList>\n";
}

TEST_P(EveryContact, SmoothedLawStartsWithoutAKink) {
  const Case c = GetParam();
  // (penetration, pressure over the linear one's): within the depth of 0.02, at its end, and beyond
  for (const auto& [penetration, share] : {std::pair<double, double>{0.01, 0.25}, {0.02, 0.5}, {0.05, 0.8}}) {
    ContactModel model(c.geometry, strip(c.cells, 4, 1, 0, 4, 1, 0), plate_xml(-penetration),
                       contact_parameters(c.method, eps) + smoothed(0.02));
    model.begin(1);
    model.residual();
    EXPECT_NEAR(model.points(model.store.trial())(0, 1), share * eps * penetration, 1e-9 * eps * penetration);
  }
  ContactModel model(c.geometry, strip(c.cells, 3, 1, 0, 2, 1, 0.05), cylinder_xml(3, -0.05),
                     contact_parameters(c.method, eps) + smoothed(0.03));
  model.begin(1);
  deform(model, 0.005);
  EXPECT_LT(jacobian_error(model), 1e-6);
}

TEST_P(EveryContact, ForceIsTheIntegralOverTheTouchedArea) {
  const Case c = GetParam();
  const double radius = 1, depth = 0.02;
  ContactModel model(c.geometry, strip(c.cells, 200, 1, 0, 0.6, 0.1, 0),
                     body_xml("b", text_parameter("type", "sphere") + number_parameter("diameter", 2 * radius),
                              text_parameter("type", "prescribed velocity") + number_parameter("velocity y", -depth)),
                     contact_parameters(c.method, eps));
  const auto values = model.step(1);
  double force = 0;
  const int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double x = 0.6 * (i + 0.5) / n, height = radius - depth, distance = std::hypot(x, height);
    if (distance >= radius) break;
    force += eps * (radius - distance) * (height / distance) * (0.6 / n) *
             (c.geometry == Geometry::axisymmetric ? 2 * pi * x : 1);
  }
  EXPECT_NEAR(values.at("contact/c/reaction y").value / force, 1, 2e-3);
}

TEST(PenaltyContact, ResidualIsPureAndWritesTheWholeTrial) {
  ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 1, 1, 0), plate_xml(-0.01, 0.02),
                     contact_parameters("surface quadrature", eps));
  model.step(0.5);
  model.begin(0.5);
  const NodalView first = model.residual();
  std::vector<double> rows, committed;
  const PointView& trial = model.points(model.store.trial());
  const PointView& old = model.points(model.store.committed());
  for (std::size_t i = 0; i < trial.extent(0); ++i)
    for (std::size_t j = 0; j < trial.extent(1); ++j) {
      rows.push_back(trial(i, j));
      committed.push_back(old(i, j));
    }
  auto& x = model.store.trial().coordinates;
  for (int node = 0; node < model.mesh.num_nodes(); ++node) x(node, 1) -= 1;
  model.residual();
  for (int node = 0; node < model.mesh.num_nodes(); ++node) x(node, 1) = model.mesh.coordinates()(node, 1);
  Kokkos::deep_copy(trial, -7.0);
  const NodalView again = model.residual();
  for (std::size_t i = 0; i < first.extent(0); ++i) EXPECT_EQ(first(i), again(i));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(trial(i / trial.extent(1), i % trial.extent(1)), rows[i]);
    EXPECT_EQ(old(i / trial.extent(1), i % trial.extent(1)), committed[i]);
  }
}

void copy(const State& from, State& to) {
  to.time = from.time;
  Kokkos::deep_copy(to.coordinates, from.coordinates);
  for (std::size_t i = 0; i < from.arrays.size(); ++i) Kokkos::deep_copy(to.arrays[i], from.arrays[i]);
}

TEST(PenaltyContact, HistoryContinuesBitForBitFromTheCommittedState) {
  // the stiffness that the automatic penalty sees has changed at the restart: the frozen one counts
  double modulus = 3e5;
  const auto make = [&] {
    return std::make_unique<ContactModel>(
        Geometry::axisymmetric, strip(Cells::tri6, 4, 1, 0, 1, 1, 0.3),
        body_xml("b",
                 text_parameter("type", "cone") + number_parameter("diameter", 1) +
                     number_parameter("tip radius", 0.2) + number_parameter("shoulder radius", 0.1),
                 text_parameter("type", "prescribed velocity") + text_parameter("velocity y", "-0.1*(1+sin(3*t))") +
                     number_parameter("ramp time", 0.35)),
        contact_parameters("surface quadrature", 0), [&](int, int) { return modulus; });
  };
  const auto straight = make(), restarted = make(), first = make();
  Report a, b;
  for (int i = 0; i < 6; ++i) a = straight->step(0.1);
  for (int i = 0; i < 3; ++i) first->step(0.1);
  modulus = 9e5;
  copy(first->store.committed(), restarted->store.committed());
  for (int i = 0; i < 3; ++i) b = restarted->step(0.1);
  EXPECT_EQ(a.size(), b.size());
  for (const auto& [name, quantity] : a) EXPECT_EQ(quantity.value, b.at(name).value) << name;
  EXPECT_GT(a.at("contact/c/reaction y").value, 0);
  EXPECT_GT(a.at("contact/c/work").value, 0);
}

TEST(PenaltyContact, WorkIsThatOfTheLinearSpring) {
  ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 2, 1, 0), plate_xml(0, 0.01),
                     contact_parameters("surface quadrature", eps));
  Report values;
  for (int i = 0; i < 5; ++i) values = model.step(1);
  EXPECT_NEAR(values.at("contact/c/work").value, 0.5 * eps * 2 * 0.05 * 0.05, 1e-9 * eps);
  // the body rests when it is not active, and does no work
  model.bodies_["b"]->set_active(false);
  const auto rest = model.step(1);
  EXPECT_EQ(rest.at("contact/c/work").value, values.at("contact/c/work").value);
  EXPECT_EQ(rest.at("contact/c/reaction y").value, values.at("contact/c/reaction y").value);
  EXPECT_EQ(model.bodies_["b"]->velocity(model.store.committed())[1], 0);
}

TEST(PenaltyContact, AutomaticPenaltyScalesWithStiffnessOverHeight) {
  for (const Cells cells : {Cells::quad9, Cells::tri6}) {
    ContactModel model(Geometry::plane_strain, strip(cells, 4, 2, 0, 1, 0.5, 0), plate_xml(-0.01),
                       contact_parameters("surface quadrature", 0) + number_parameter("penalty factor", 5),
                       [](int, int) { return 2e6; });
    const auto values = model.step(1);
    EXPECT_NEAR(values.at("contact/c/reaction y").value, 5 * 2e6 / 0.25 * 0.01, 1e-4);
  }
}

TEST(PenaltyContact, DistantSidesAreSkippedAndSaySo) {
  ContactModel model(Geometry::plane_strain, strip(Cells::quad4, 10, 1, 0, 10, 1, 0), cylinder_xml(1, -0.1),
                     contact_parameters("surface quadrature", eps) + number_parameter("capture distance", 0.25));
  model.step(1);
  const PointView& rows = model.points(model.store.committed());
  int touching = 0, skipped = 0;
  for (std::size_t i = 0; i < rows.extent(0); ++i) {
    touching += rows(i, 0) < 0;
    skipped += rows(i, 0) == 0.25;
    EXPECT_EQ(rows(i, 2), rows(i, 0) < 0 ? 1 : 0);
  }
  EXPECT_GT(touching, 0);
  EXPECT_EQ(skipped, 9 * 3);
}

TEST(PenaltyContact, StepLimitFollowsTheFastestMotionAhead) {
  ContactModel model(Geometry::plane_strain, strip(Cells::quad4, 10, 1, 0, 1, 1, 0),
                     body_xml("b", text_parameter("type", "flat pile") + number_parameter("diameter", 1),
                              text_parameter("type", "prescribed velocity") + number_parameter("velocity y", -2)),
                     contact_parameters("nodes", eps) + number_parameter("advance limit", 0.5));
  EXPECT_NEAR(model.contact->step_limit(model.store.committed(), 1.0), 0.5 * 0.1 / 2, 1e-12);
  model.bodies_["b"]->set_active(false);
  EXPECT_GE(model.contact->step_limit(model.store.committed(), 1.0), 1e300);
}

TEST(PenaltyContact, CoveredVerticesAreSealedOneStepLater) {
  const std::vector<double> none, under{0, 0.25};  // the pile's edge is at 0.5: the vertex there has a free side, too
  for (const bool sealing : {true, false}) {
    ContactModel model(
        Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 1, 1, 0), pile_xml(1, 0, 0.01),
        contact_parameters("surface quadrature", eps) + text_parameter("drainage", sealing ? "sealed" : "drained"));
    model.begin(1);  // the pile rests on the surface: closed from the first step on
    EXPECT_EQ(released(model, "surface"), sealing ? under : none);
    model.residual();
    model.store.accept();
    model.begin(1);
    EXPECT_EQ(released(model, "surface"), sealing ? under : none);
    // the soil sinks away from the pile: open again one step later
    for (int node = 0; node < model.mesh.num_nodes(); ++node) model.store.trial().coordinates(node, 1) -= 0.1;
    model.residual();
    EXPECT_EQ(released(model, "surface"), sealing ? under : none);
    model.store.accept();
    model.begin(1);
    EXPECT_EQ(released(model, "surface"), none);
  }
}

TEST(PenaltyContact, ABodyAboveTheSurfaceDoesNotSealTheFirstStep) {
  ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 4, 1, 0, 1, 1, 0), pile_xml(1, 0.026, 0.01),
                     contact_parameters("surface quadrature", eps));  // sealing gap: 0.1 sides of 0.25
  model.begin(1);
  EXPECT_TRUE(released(model, "surface").empty());
}

TEST(PenaltyContact, OtherSidesKeepTheirDrainage) {
  GlobalMesh global = strip(Cells::quad9, 4, 1, 0, 1, 1, 0);
  global.side_sets["end"] = {{0, 3, 1}};
  global.side_sets["half"] = {{0, 0, 2}, {0, 1, 2}};
  ContactModel model(
      Geometry::plane_strain, global, plate_xml(0),
      text_parameter("body", "b") + text_parameter("surface", "half") + number_parameter("penalty", eps));
  model.begin(1);
  EXPECT_EQ(released(model, "half"), (std::vector<double>{0, 0.25, 0.5}));
  EXPECT_EQ(released(model, "surface"), (std::vector<double>{0, 0.25}));  // at 0.5 it is open to the right
  EXPECT_TRUE(released(model, "end").empty());
}

TEST(PenaltyContact, DegenerateSidesAreCounted) {
  ContactModel model(Geometry::plane_strain, strip(Cells::quad4, 2, 1, 0, 1, 1, 0), plate_xml(-0.01),
                     contact_parameters("surface quadrature", eps));
  model.begin(1);
  for (int node = 0; node < model.mesh.num_nodes(); ++node) model.store.trial().coordinates(node, 0) = std::nan("");
  model.residual();
  EXPECT_EQ(model.failures, 2);
}

TEST(PenaltyContact, WrongEntriesAreNamed) {
  const auto error = [](const std::string& body, const std::string& contact) {
    return input_error(
        [&] { ContactModel(Geometry::plane_strain, strip(Cells::quad4, 4, 1, 0, 1, 1, 0), body, contact); });
  };
  const auto has = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  has(error(plate_xml(-0.3), contact_parameters("nodes", eps)),
      "contacts/c/body: body 'b' overlaps the surface by 0.3 m at (");
  has(error(plate_xml(-0.3), contact_parameters("nodes", eps)),
      ", 0) at the start, more than half of its shortest side, 0.25 m; move its 'position'");
  has(error(plate_xml(0),
            text_parameter("body", "b") + text_parameter("surface", "surfaces") + number_parameter("penalty", eps)),
      "contacts/c/surface: unknown side set 'surfaces' (did you mean 'surface'?)");
  has(error(plate_xml(0), contact_parameters("gauss", eps)), "method");
  has(error(plate_xml(0), contact_parameters("nodes", eps) + number_parameter("penaly factor", 3)), "penaly factor");
  has(error(plate_xml(0), contact_parameters("nodes", eps, "bb")), "contacts/c/body: unknown body 'bb'");
}

std::string augmented(double tolerance) {
  return text_parameter("enforcement", "augmented Lagrangian") + number_parameter("gap tolerance", tolerance);
}

TEST_P(EveryContact, MultipliersOfAFixedGapGrowByThePenaltyTimesIt) {
  const Case c = GetParam();
  ContactModel model(c.geometry, strip(c.cells, 3, 1, 0, 2, 1, 0.02), plate_xml(-0.01),
                     contact_parameters(c.method, eps) + augmented(1e-4));
  model.begin(1);
  deform(model, 0);
  for (int count = 0; count < 4; ++count) {
    model.residual();
    const PointView& rows = model.points(model.store.trial());
    for (std::size_t row = 0; row < rows.extent(0); ++row) {
      const double gap = rows(row, 0);  // differs from point to point, but is in the space of the sides' shapes
      EXPECT_NEAR(rows(row, 1), -(count + 1) * eps * gap, 1e-3 * (count + 1) * eps * 0.01);
    }
    EXPECT_TRUE(model.contact->augment(model.view, count).again);
  }
}

TEST_P(EveryContact, AugmentedJacobianIsTheDifferencedResidual) {
  const Case c = GetParam();
  ContactModel model(c.geometry, strip(c.cells, 3, 1, 0, 2, 1, 0.05), cylinder_xml(3, -0.05),
                     contact_parameters(c.method, eps) + augmented(1e-9));
  model.begin(1);
  deform(model, 0.005);
  model.residual();
  ASSERT_TRUE(model.contact->augment(model.view, 0).again);
  EXPECT_LT(jacobian_error(model), 1e-6);
}

TEST(Contact, MultipliersOfAnAbandonedStepAreForgotten) {
  ContactModel model(Geometry::plane_strain, strip(Cells::quad9, 3, 1, 0, 2, 1, 0.05), cylinder_xml(3, -0.05),
                     contact_parameters("surface quadrature", eps) + augmented(1e-9));
  model.begin(1);
  const NodalView first = model.residual();
  for (int count = 0; count < 3; ++count) {
    ASSERT_TRUE(model.contact->augment(model.view, count).again);
    model.residual();
  }
  model.begin(1);
  const NodalView again = model.residual();
  for (std::size_t i = 0; i < first.extent(0); ++i) EXPECT_EQ(again(i), first(i));
}

TEST(Contact, EnforcementRejectsWhatItDoesNotUse) {
  const auto make = [](const std::string& more) {
    return [more] {
      ContactModel(Geometry::plane_strain, strip(Cells::quad9, 3, 1, 0, 2, 1, 0), plate_xml(0),
                   contact_parameters("nodes", eps) + more);
    };
  };
  EXPECT_NE(
      input_error(make(number_parameter("gap tolerance", 1e-6))).find("only with 'enforcement' = augmented Lagrangian"),
      std::string::npos);
  EXPECT_NE(input_error(make(augmented(1e-6) + text_parameter("impact", "conserving")))
                .find("conserving is for 'enforcement' = penalty"),
            std::string::npos);
  for (const std::string& more : {augmented(1e-6), text_parameter("impact", "conserving")})
    EXPECT_NE(input_error(make(more + smoothed(0.01))).find("in proportion to the penetration; allowed here: linear"),
              std::string::npos);
}

}  // namespace
}  // namespace mudline
