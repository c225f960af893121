// Boundary conditions on a box with known results: prescribed values, resultants of loads, and the sets that conditions
// support.
#include <gtest/gtest.h>

#include <cmath>

#include "core/tests/input_error.hpp"
#include "framework/closed_sides.hpp"
#include "physics/conditions/well.hpp"
#include "soil_model.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

constexpr double pi = 3.14159265358979323846;

std::string condition(const std::string& name, const std::string& type, const std::string& set,
                      const std::string& more = "") {
  return section_xml(name, text_parameter("type", type) + text_parameter("set", set) + more);
}

/// Sum of the residual of a condition's load.
double load(SoilModel& model, const std::string& name, int component) {
  return model.sum(model.residual(*model.named.at(name)->term()), component);
}

TEST(Conditions, FixedHoldsItsComponentsOnItsSet) {
  SoilModel model(condition("x", "fixed", "left", text_parameter("components", "x")) +
                  condition("both", "fixed", "top"));
  const Constraints x = model.prescribed("x"), both = model.prescribed("both");
  for (int node = 0; node < model.mesh->num_nodes(); ++node) {
    const bool left = model.x(node, 0) == 1, top = model.x(node, 1) == 3;
    EXPECT_EQ(x.mask(model.u(node, 0)), left);
    EXPECT_EQ(x.mask(model.u(node, 1)), 0);
    for (int i = 0; i < 2; ++i) EXPECT_EQ(both.mask(model.u(node, i)), top);
    if (model.p(node) >= 0) {
      EXPECT_EQ(both.mask(model.p(node)), 0);
    }
  }
}

TEST(Conditions, DisplacementIsAFunctionOfTimeAndInitialPosition) {
  SoilModel model(condition("move", "displacement", "top", text_parameter("y", "-0.1*t*x")));
  const Constraints to = model.prescribed("move", 1, 2);
  for (int node : model.mesh->nodes_of_set("top")) {
    EXPECT_EQ(to.mask(model.u(node, 0)), 0);
    EXPECT_NEAR(to.value(model.u(node, 1)), -0.2 * model.x(node, 0), 1e-15);
  }
}

TEST(Conditions, VelocityIsIntegratedOverTheStepFromTheCommittedState) {
  SoilModel model(
      condition("push", "velocity", "top",
                number_parameter("y", -2) + number_parameter("ramp time", 0.5) + number_parameter("start time", 1)));
  const int dof = model.u(model.mesh->nodes_of_set("top").front(), 1);
  model.store->committed().value(dof) = 0.25;
  EXPECT_NEAR(model.prescribed("push", 0, 1).value(dof), 0.25, 1e-15);  // before the ramp
  EXPECT_NEAR(model.prescribed("push", 1, 1.5).value(dof), 0.25 - 2 * 0.25, 1e-14);
  EXPECT_NEAR(model.prescribed("push", 3, 4).value(dof), 0.25 - 2, 1e-14);
}

TEST(Conditions, WaterPressuresArePrescribedAtVertices) {
  SoilModel model(condition("given", "pore pressure", "left", text_parameter("value", "1000*y")) +
                  condition("water", "hydrostatic pressure", "left",
                            number_parameter("water level", 2) + number_parameter("unit weight", 1e4)));
  for (int node = 0; node < model.mesh->num_nodes(); ++node)
    model.store->committed().coordinates(node, 1) -= 0.5;  // after a settlement: heights are the present ones
  const Constraints given = model.prescribed("given"), water = model.prescribed("water");
  int vertices = 0;
  for (int node : model.mesh->nodes_of_set("left")) {
    if (model.p(node) < 0) continue;
    ++vertices;
    EXPECT_NEAR(given.value(model.p(node)), 1000 * model.x(node, 1), 1e-12);
    EXPECT_NEAR(water.value(model.p(node)), 1e4 * std::max(0.0, 2.5 - model.x(node, 1)), 1e-11);
    EXPECT_EQ(water.mask(model.p(node)), 1);
  }
  EXPECT_EQ(vertices, 4);
}

TEST(Conditions, AnyComponentOfAnyField) {
  SoilModel model(condition("any", "value", "top",
                            text_parameter("field", "displacement") +
                                "<Parameter name=\"component\" type=\"int\" value=\"1\"/>\n" +
                                number_parameter("value", 0.5)));
  const Constraints to = model.prescribed("any");
  const int node = model.mesh->nodes_of_set("top").front();
  EXPECT_EQ(to.mask(model.u(node, 0)), 0);
  EXPECT_EQ(to.value(model.u(node, 1)), 0.5);
}

TEST(Conditions, WrongSetsAndFieldsAreNamed) {
  const auto has = [](const std::string& conditions, const std::string& part) {
    const std::string message = input_error([&] { SoilModel model(conditions); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  has(condition("c", "fixed", "tpo"), "boundary conditions/c/set: unknown mesh set 'tpo' (did you mean 'top'?)");
  has(condition("c", "pressure", "tpo", number_parameter("value", 1)), "unknown side set 'tpo' (did you mean 'top'?)");
  has(condition("c", "displacement", "top"), "at least one of 'x' and 'y' must be given");
  has(condition("c", "value", "top", text_parameter("field", "pore presure") + number_parameter("value", 1)),
      "this model has no field 'pore presure' (did you mean 'pore pressure'?)");
  has(condition("c", "value", "top",
                text_parameter("field", "pore pressure") + number_parameter("value", 1) +
                    "<Parameter name=\"component\" type=\"int\" value=\"1\"/>\n"),
      "field 'pore pressure' has 1 component(s), counted from 0");
}

TEST(Conditions, ClosedSidesReleaseTheirNodesUnlessAnotherSideIsOpen) {
  SoilModel model(condition("top", "pore pressure", "top") + condition("left", "pore pressure", "left") +
                  condition("shut", "fixed", "top"));
  const auto held = [&](const std::string& name, const ClosedSides& closed) {
    dynamic_cast<HoldsOnOpenSides&>(*model.named.at(name)).set_closed(closed);
    const Constraints to = model.prescribed(name);
    int count = 0;
    for (int node = 0; node < model.mesh->num_nodes(); ++node) {
      if (model.p(node) >= 0) count += to.mask(model.p(node));
      count += to.mask(model.u(node, 0));
    }
    return count;
  };
  ClosedSides closed;
  EXPECT_EQ(held("top", closed), 3);
  closed.possible = true;
  EXPECT_EQ(held("top", closed), 3);
  const Side first = model.mesh->side_sets().at("top").front();
  closed.sides.insert({first.block, first.element, first.side});
  EXPECT_EQ(held("top", closed), 2);  // without the outer node of the closed side
  for (const Side& side : model.mesh->side_sets().at("top")) closed.sides.insert({side.block, side.element, side.side});
  EXPECT_EQ(held("top", closed), 0);
  EXPECT_EQ(held("left", closed), 4);  // including the corner
  EXPECT_EQ(held("shut", closed), 5);  // closed sides do not affect displacements
  EXPECT_EQ(held("top", ClosedSides{}), 3);
}

TEST(Conditions, APressureOnASurfaceThatBodiesMaySealIsThatOfTheWaterOutside) {
  SoilModel model(condition("top", "pore pressure", "top", number_parameter("value", 7)) +
                  condition("left", "pore pressure", "left"));
  ClosedSides closed;
  closed.possible = true;
  closed.may_be_sealed.insert("top");
  dynamic_cast<HoldsOnOpenSides&>(*model.named.at("top")).set_closed(closed);
  const Constraints by_motion = model.prescribed("top");  // of soil that sees its motion
  for (int node = 0; node < model.mesh->num_nodes(); ++node)
    EXPECT_FALSE(model.p(node) >= 0 && by_motion.open(model.p(node)));
  dynamic_cast<HoldsOnOpenSides&>(*model.named.at("top")).set_closed(ClosedSides{});
  model.soil->blocks[0].sees_water = true;
  const Side first = model.mesh->side_sets().at("top").front();
  closed.sides.insert({first.block, first.element, first.side});
  for (const char* name : {"top", "left"}) dynamic_cast<HoldsOnOpenSides&>(*model.named.at(name)).set_closed(closed);
  const Constraints top = model.prescribed("top"), left = model.prescribed("left");
  int open = 0;
  for (int node = 0; node < model.mesh->num_nodes(); ++node) {
    const int dof = model.p(node);
    if (dof < 0) continue;
    EXPECT_FALSE(top.mask(dof));
    EXPECT_FALSE(left.open(dof));  // its sides are no part of that surface
    open += top.open(dof);
    EXPECT_TRUE(!top.open(dof) || top.value(dof) == 7);
  }
  EXPECT_EQ(open, 2);  // without the outer vertex of the closed side
  closed.may_leak.insert("top");
  dynamic_cast<HoldsOnOpenSides&>(*model.named.at("top")).set_closed(closed);
  const Constraints leaks = model.prescribed("top");
  for (int node = 0; node < model.mesh->num_nodes(); ++node)
    EXPECT_FALSE(model.p(node) >= 0 && leaks.open(model.p(node)));
  for (const auto& condition : model.named)
    dynamic_cast<HoldsOnOpenSides&>(*condition.second).set_closed(ClosedSides{});
  const Constraints still = model.prescribed("top");
  for (const int node : model.mesh->nodes_of_set("top"))
    EXPECT_TRUE(model.p(node) < 0 || (still.mask(model.p(node)) && !still.open(model.p(node))));
}

TEST(Conditions, ReactionsAreSummedOverTheSet) {
  SoilModel model(condition("base", "fixed", "bottom") + condition("drain", "pore pressure", "bottom"));
  NodalView reaction("reaction", model.space->dofs()->num_overlap_dofs());
  for (int node = 0; node < model.mesh->num_nodes(); ++node) {
    reaction(model.u(node, 0)) = 1;
    reaction(model.u(node, 1)) = 10;
    if (model.p(node) >= 0) reaction(model.p(node)) = 100;
  }
  Report shares;
  for (const char* name : {"base", "drain"}) model.named.at(name)->reactions(reaction, shares);
  std::map<std::string, double> named;
  for (const auto& [name, share] : shares) named[name + " [" + share.unit + "]"] = share.value;
  EXPECT_EQ(named, (std::map<std::string, double>{
                       {"reaction/base x [N]", 5}, {"reaction/base y [N]", 50}, {"reaction/drain [m3/s]", 300}}));
}

TEST(Conditions, TractionActsOnThePresentArea) {
  const std::string pull =
      condition("pull", "traction", "top", number_parameter("x", 30) + text_parameter("y", "-20*t"));
  for (const bool round : {false, true}) {
    SoilModel model(pull, "", SoilModel::box(round ? "axisymmetric" : "plane strain"));
    double area = round ? pi * (9 - 1) : 2;
    EXPECT_NEAR(load(model, "pull", 0), -30 * area, 1e-10);
    EXPECT_NEAR(load(model, "pull", 1), 20 * area, 1e-10);
    for (int node = 0; node < model.mesh->num_nodes(); ++node) model.store->trial().coordinates(node, 0) *= 1.5;
    EXPECT_NEAR(load(model, "pull", 1), 20 * area * (round ? 2.25 : 1.5), 1e-10);
  }
}

TEST(Conditions, PressurePushesAgainstThePresentSurface) {
  SoilModel model(
      condition("on top", "pressure", "top", number_parameter("value", 50)) +
      condition("here", "pressure", "left", text_parameter("value", "100*y") + text_parameter("position", "present")));
  EXPECT_NEAR(load(model, "on top", 0), 0, 1e-12);
  EXPECT_NEAR(load(model, "on top", 1), 50 * 2, 1e-11);  // the residual is minus the force, which points down
  // after a rotation by 90 degrees the top faces to the left
  for (int node = 0; node < model.mesh->num_nodes(); ++node) {
    model.store->trial().coordinates(node, 0) = -model.x(node, 1);
    model.store->trial().coordinates(node, 1) = model.x(node, 0);
  }
  EXPECT_NEAR(load(model, "on top", 0), -50 * 2, 1e-11);
  EXPECT_NEAR(load(model, "on top", 1), 0, 1e-11);
  EXPECT_NEAR(load(model, "here", 1), -100 * 1 * 3, 1e-10);  // the left side lies at y = 1 now
}

TEST(Conditions, FluxIsPerInitialArea) {
  for (const bool round : {false, true}) {
    SoilModel model(condition("pump", "flux", "right", number_parameter("value", 0.25)), "",
                    SoilModel::box(round ? "axisymmetric" : "plane strain"));
    for (int node = 0; node < model.mesh->num_nodes(); ++node) model.store->trial().coordinates(node, 1) *= 2;
    EXPECT_NEAR(load(model, "pump", 2), 0.25 * 3 * (round ? 2 * pi * 3 : 1), 1e-12);  // outflow is positive
    EXPECT_EQ(load(model, "pump", 0), 0);
  }
}

TEST(Well, SharesOfALineAreLengths) {
  std::vector<double> shares;
  EXPECT_EQ(shares_of_line({0, 0, 3, 0, 0, 0, 0, 0, 1}, shares), "");  // at heights of 3, 0 and 1 m
  EXPECT_NEAR(shares[0], 2.0 / 6, 1e-15);
  EXPECT_NEAR(shares[1], 1.0 / 6, 1e-15);
  EXPECT_NEAR(shares[2], 3.0 / 6, 1e-15);
  EXPECT_EQ(shares_of_line({1, 2, 3}, shares), "");
  EXPECT_EQ(shares, std::vector<double>{1.0});
  EXPECT_EQ(shares_of_line({0, 0, 0, 1, 0, 0, 2, 1e-3, 0}, shares), "its nodes do not lie on a straight line");
  EXPECT_EQ(shares_of_line({}, shares), "it has no nodes with a pore pressure");
}

TEST(AbsorbingBoundary, DashpotsHaveTheImpedancesOfUndrainedSoil) {
  SoilModel model(condition("open", "absorbing", "right") +
                  condition("weak", "absorbing", "right",
                            number_parameter("normal factor", 0.5) + number_parameter("tangential factor", 0.25)));
  model.set_motion(model.rate, [](double, double) { return Vec<double, 2>{2.0, 3.0}; });
  const double density = 0.6 * 2600 + 0.4 * 1000;
  const double p = std::sqrt(density * (12e6 + 2e9 / 0.4)), s = std::sqrt(density * 4e6);
  EXPECT_NEAR(load(model, "open", 0), p * 2 * 3, 1e-9 * p);
  EXPECT_NEAR(load(model, "open", 1), s * 3 * 3, 1e-9 * s);
  EXPECT_NEAR(load(model, "weak", 0), 0.5 * p * 2 * 3, 1e-9 * p);
  EXPECT_NEAR(load(model, "weak", 1), 0.25 * s * 3 * 3, 1e-9 * s);
  model.view.inertia = false;
  EXPECT_EQ(load(model, "open", 0), 0);
}

TEST(AbsorbingBoundary, OneHoldsWhatTheOtherHasNotTakenOver) {
  SoilModel model(condition("base", "absorbing", "bottom") + condition("side", "absorbing", "right"));
  const int n = model.space->dofs()->num_overlap_dofs();
  NodalView unbalanced("unbalanced", n);
  Kokkos::deep_copy(unbalanced, 7.0);
  for (const char* name : {"base", "side"}) model.named.at(name)->activate(model.store->committed(), unbalanced);
  model.view.inertia = false;
  EXPECT_NEAR(load(model, "base", 0), -7 * 5, 1e-12);
  EXPECT_NEAR(load(model, "side", 0), -7 * 6, 1e-12);  // 7 nodes without the corner, which belongs to the base
  for (int node = 0; node < model.mesh->num_nodes(); ++node) {
    const bool held = model.x(node, 1) == 0 || model.x(node, 0) == 3;
    for (int i = 0; i < 2; ++i) EXPECT_EQ(unbalanced(model.u(node, i)), held ? 0 : 7);
  }
}

}  // namespace
}  // namespace mudline
