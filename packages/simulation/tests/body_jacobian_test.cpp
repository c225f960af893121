// The Jacobian of a model with a free body against the differenced residual: contact with friction while points touch,
// leave, stick and slide; weight, water and given forces; inertia; at the integrator's levels.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "integrator/overlap.hpp"
#include "model_fixture.hpp"

namespace mudline {
namespace {

using namespace mudline::testing;

struct Case {
  std::string geometry, stage;
  double friction;
};

std::string deck(const Case& c) {
  const bool plane = c.geometry == "plane strain", dynamic = c.stage == "dynamic";
  const std::string motion =
      text("type", "free") + par("freedom", "Array(string)", plane ? "{x, y, rotation}" : "{y}") +
      (plane ? text("force x", "-300*x*x+50*y") + text("moment", "20*sin(t)") : "") + text("force y", "-2e3*y*(1+y)") +
      list("water", number("density", 1e3) + number("drag coefficient", 0.7) + number("added mass coefficient", 0.5) +
                        (plane ? "" : number("mudline", 1.3)));
  const std::string body =
      par("position", "Array(double)", plane ? "{1.0, 0.97}" : "{0.0, 0.97}") + number("mass", 600) +
      (plane ? number("moment of inertia", 20) + par("centre of mass", "Array(double)", "{0.1, 0.35}") : "") +
      list("contour", text("type", "cylinder") + text("extent", plane ? "full" : "half") + number("diameter", 0.8)) +
      list("motion", motion);
  const std::string material = number("void ratio", 0.8) +
                               list("skeleton", text("type", "linear elastic") + number("Young's modulus", 1e6) +
                                                    number("Poisson's ratio", 0.3)) +
                               list("fluid", text("type", "water") + number("bulk modulus", 5e7)) +
                               list("permeability", text("type", "constant") + number("hydraulic conductivity", 1e-4));
  return list(
      "deck",
      list("mesh", text("type", "box") + text("geometry", c.geometry) + text("cell", "quad9") +
                       par("cells", "Array(double)", "{6, 2}") + par("upper", "Array(double)", "{2.0, 1.0}")) +
          list("materials", list("soil", material)) + list("physics", list("ground", text("type", "biot"))) +
          list("bodies", list("b", body)) +
          list("boundary conditions", list("base", text("type", "fixed") + text("set", "bottom"))) +
          list("contacts",
               list("c", text("type", "penalty") + text("body", "b") + text("surface", "top") + number("penalty", 1e6) +
                             list("friction", text("type", "coulomb") + number("coefficient", c.friction) +
                                                  number("adhesion", 10)))) +
          list("stages", list("s", text("type", c.stage) + number("duration", 1.0) +
                                       list("integrator", text("type", dynamic ? "generalised alpha" : "theta")) +
                                       list("time step", number("initial", 0.01)))));
}

void check(const Case& c) {
  SCOPED_TRACE(c.geometry + ", " + c.stage);
  ModelFixture fixture(deck(c));
  Model& model = *fixture.model;
  StepSystem& system = model.system();
  const DofMap& dofs = *model.space().dofs();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Stage& stage = *model.stages().front();
  model.activate(stage, true);
  ASSERT_TRUE(system.refresh_history());
  StepRequest request;
  request.dt = 0.01;
  request.scheme = stage.scheme(0);
  request.prescribe = [&](double t0, double t1, const State& committed, Constraints& to) {
    model.prescribe(stage, t0, t1, committed, to);
  };
  const BodyUnknowns& unknowns = model.bodies().at("b")->unknowns();
  // a first step leaves shear stresses and velocities behind
  Vector x = system.begin(request, StepTolerances()), f(system.map());
  const auto perturb = [&](double down) {
    auto data = x.getLocalViewHost(Tpetra::Access::ReadWrite);
    const double size[] = {0.003, 1e3, 0.005};
    for (int i = 0; i < dofs.num_owned_dofs(); ++i)
      if (!system.constraints().mask(i)) data(i, 0) += uniform(random) * size[dofs.field_of(i)];
    data(unknowns.dof[unknowns.count == 1 ? 0 : 1], 0) += down;
  };
  perturb(-0.01);
  ASSERT_TRUE(system.residual(x, f));
  model.store().accept();
  x = system.begin(request, StepTolerances());
  perturb(0.015);  // some points leave, and others come to touch through the waves of the surface
  ASSERT_TRUE(system.residual(x, f));
  system.jacobian(x);
  const double scale[] = {0.01, 1e4, 0.01};
  for (int moved = 0; moved < dofs.num_fields(); ++moved) {
    const double h = moved == 1 ? 1e-3 : 1e-5;  // little of the body's force comes from pressures: against rounding
    Vector v(system.map()), plus(x, Teuchos::Copy), minus(x, Teuchos::Copy), above(system.map()), below(system.map()),
        jv(system.map());
    {
      auto data = v.getLocalViewHost(Tpetra::Access::OverwriteAll);
      for (int i = 0; i < dofs.num_owned_dofs(); ++i)
        data(i, 0) = system.constraints().mask(i) || dofs.field_of(i) != moved ? 0.0 : uniform(random) * scale[moved];
    }
    system.apply_jacobian(v, jv);
    plus.update(h, v, 1.0);
    minus.update(-h, v, 1.0);
    ASSERT_TRUE(system.residual(plus, above));
    ASSERT_TRUE(system.residual(minus, below));
    const std::vector<double> residual = owned_field_norms(dofs, below);
    above.update(-0.5 / h, below, 0.5 / h);
    const auto exact = above.getLocalViewHost(Tpetra::Access::ReadOnly),
               mine = jv.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (int field = 0; field < dofs.num_fields(); ++field) {
      double difference = 0, size = 0;
      for (int i = dofs.owned_begin(field); i < dofs.owned_end(field); ++i) {
        difference = std::max(difference, std::abs(exact(i, 0) - mine(i, 0)));
        size = std::max(size, std::abs(exact(i, 0)));
      }
      // where nothing depends on what moves, the difference is rounding
      EXPECT_LE(difference, 1e-6 * size + 1e-14 * residual[field] / h)
          << model.space().field(field).name << " by " << model.space().field(moved).name;
    }
  }
  const State &old = model.store().committed(), &now = model.store().trial();
  const PointView& before = old.arrays[model.store().find("contact/c/points")];
  const PointView& after = now.arrays[model.store().find("contact/c/points")];
  int stay = 0, leave = 0;
  for (std::size_t i = 0; i < before.extent(0); ++i) {
    stay += before(i, 2) > 0 && after(i, 2) > 0;
    leave += before(i, 2) > 0 && after(i, 2) == 0;
  }
  EXPECT_GT(stay, 0);
  EXPECT_GT(leave, 0);
}

TEST(Jacobian, EqualsDifferencedResidualWithAFreeBody) {
  for (const char* geometry : {"plane strain", "axisymmetric"})
    for (const char* stage : {"dynamic", "quasi-static"})
      for (const double friction : {0.01, 5.0}) check({geometry, stage, friction});
}

}  // namespace
}  // namespace mudline
