// The Jacobian of every term against the differenced residual, on a distorted mesh in a deformed, moving state.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "model_fixture.hpp"

namespace mudline {
namespace {

using namespace mudline::testing;

struct Case {
  std::string cell, geometry, skeleton, integrator;
  double tolerance;
  bool heat = false;
  bool dries = false;          // soil with a retention, and a seepage face instead of an absorbing side
  double pore_pressure = 2e4;  // [Pa] at the start
  bool space() const { return geometry == "three-dimensional"; }
  bool linear() const { return cell == "tri3" || cell == "quad4" || cell == "tet4" || cell == "hex8"; }
};

/// Components of a point or vector; y is left out in the plane, whose second axis is the vertical one.
std::string numbers(const Case& c, const std::string& name, const char* type, const std::string& x,
                    const std::string& y, const std::string& z) {
  return par(name, type, "{" + x + ", " + (c.space() ? y + ", " : "") + z + "}");
}

std::string elastic() {
  return list("skeleton",
              text("type", "linear elastic") + number("Young's modulus", 1e7) + number("Poisson's ratio", 0.3));
}
std::string cam_clay() {
  return list("skeleton", text("type", "modified cam clay") + number("critical stress ratio", 1.2) +
                              number("compression slope", 0.15) + number("swelling slope", 0.03) +
                              number("Poisson's ratio", 0.3));
}

std::string deck(const Case& c) {
  const std::string material =
      number("void ratio", 0.8) +
      (c.dries ? list("retention", number("reference suction", 1e4) + number("residual saturation", 0.1))
               : number("Biot coefficient", 0.9) + number("grain bulk modulus", 3e7)) +
      c.skeleton + list("fluid", text("type", "water") + number("bulk modulus", 5e7)) +
      list("permeability", text("type", "kozeny-carman") + number("hydraulic conductivity", 1e-4)) +
      (c.heat ? list("heat",
                     number("conductivity", 1.5) + number("grain heat capacity", 800) + number("grain expansion", 3e-3))
              : "");
  const std::string physics =
      (c.heat ? text("type", "thermo-hydro-mechanical") + number("water expansion", 5e-3)
              : text("type", "biot") + par("fluid acceleration", "bool", c.dries ? "false" : "true") +
                    text("pressure", c.linear() ? "equal order" : "Taylor-Hood")) +
      numbers(c, "gravity", "Array(double)", "1.0", "0.5", "-9.81") + number("mass damping", 2.0) +
      number("stiffness damping", 1e-3) +
      list("initial state", text("type", "uniform") + number("effective stress xx", 8e4) +
                                number("effective stress yy", 1e5) + number("effective stress zz", 8e4) +
                                (c.space() ? number("shear stress yz", 5e3) : "") +
                                number("pore pressure", c.pore_pressure));
  const std::string conditions =
      list("base", text("type", "fixed") + text("set", "bottom")) +
      list("drain", text("type", "pore pressure") + text("set", "top") + number("value", 0.05 * c.pore_pressure)) +
      list("shear", text("type", "traction") + text("set", "top") + number("x", 3e4) + number("y", -2e4) +
                        (c.space() ? number("z", 1e4) : "")) +
      list("push", text("type", "pressure") + text("set", "right") + number("value", 5e4)) +
      list("mud", text("type", "pressure") + text("set", "left") + text("value", "4e4*(1.2-y)*(1+x)") +
                      text("position", "present")) +
      list("leave", text("type", c.dries ? "seepage face" : "absorbing") + text("set", "right")) +
      list("leak", text("type", "flux") + text("set", "left") + number("value", 1e-3));
  return list(
      "deck",
      list("mesh", text("type", "box") + text("geometry", c.geometry) + text("cell", c.cell) +
                       numbers(c, "cells", "Array(double)", "3", "2", "2") +
                       numbers(c, "lower", "Array(double)", "0.5", "0.2", "0.0") +
                       numbers(c, "upper", "Array(double)", "2.0", "1.0", "1.0") + number("distortion", 0.2)) +
          list("materials", list("soil", material)) + list("physics", list("ground", physics)) +
          list("boundary conditions", conditions) +
          list("stages", list("shake", text("type", c.integrator == "theta" ? "quasi-static" : "dynamic") +
                                           number("duration", 1.0) + list("integrator", text("type", c.integrator)) +
                                           list("time step", number("initial", 0.01)))));
}

constexpr double changes[3] = {0.01, 1e4, 10};  // of displacement [m], pore pressure [Pa], temperature [K]

/// Relative difference between J v and (F(x + h v) - F(x - h v)) / 2h, worst over the fields.
double jacobian_error(Model& model, const Vector& x, std::mt19937& random) {
  StepSystem& system = model.system();
  const DofMap& dofs = *model.space().dofs();
  std::uniform_real_distribution<double> uniform(-1, 1);
  Vector v(system.map()), plus(x, Teuchos::Copy), minus(x, Teuchos::Copy);
  {
    auto data = v.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (int i = 0; i < dofs.num_owned_dofs(); ++i)
      data(i, 0) = system.constraints().mask(i) ? 0.0 : uniform(random) * changes[dofs.field_of(i)];
  }
  Vector f(system.map()), above(system.map()), below(system.map()), jv(system.map());
  EXPECT_TRUE(system.residual(x, f));
  system.jacobian(x);
  system.apply_jacobian(v, jv);
  const double h = 1e-5;
  plus.update(h, v, 1.0);
  minus.update(-h, v, 1.0);
  EXPECT_TRUE(system.residual(plus, above));
  // the data that the residual kept for the matrix at x equal those that the matrix computes itself after a residual at
  // another place
  Vector anew(system.map());
  system.jacobian(x);
  system.apply_jacobian(v, anew);
  anew.update(-1, jv, 1);
  EXPECT_EQ(anew.normInf(), 0);
  EXPECT_TRUE(system.residual(minus, below));
  above.update(-0.5 / h, below, 0.5 / h);
  double worst = 0;
  const auto exact = above.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto mine = jv.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (int field = 0; field < dofs.num_fields(); ++field) {
    double difference = 0, size = 0;
    for (int i = dofs.owned_begin(field); i < dofs.owned_end(field); ++i) {
      if (system.constraints().mask(i)) continue;
      difference = std::max(difference, std::abs(exact(i, 0) - mine(i, 0)));
      size = std::max(size, std::abs(exact(i, 0)));
    }
    if (size > 0) worst = std::max(worst, difference / size);
  }
  return worst;
}

void check(const Case& c) {
  SCOPED_TRACE(c.cell + ", " + c.geometry + ", " + c.integrator);
  ModelFixture fixture(deck(c));
  Model& model = *fixture.model;
  StepSystem& system = model.system();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  State& state = model.store().committed();
  for (std::size_t i = 0; i < state.value.extent(0); ++i) {
    const int field = model.space().dofs()->field_of(static_cast<int>(i));
    state.rate(i) = uniform(random) * (field == 0 ? 0.1 : changes[field]);
    state.acceleration(i) = field == 0 ? uniform(random) * 5 : 0.0;
    if (field == 2) state.value(i) += changes[2] * uniform(random);
  }
  const Stage& stage = *model.stages().front();
  model.activate(stage, true);
  StepRequest request;
  request.dt = 0.01;
  request.scheme = stage.scheme(0);
  request.prescribe = [&](double t0, double t1, const State& committed, Constraints& to) {
    model.prescribe(stage, t0, t1, committed, to);
  };
  std::vector<Term*> all = system.terms().active();
  std::vector<std::vector<Term*>> groups{all};
  for (Term* term : all) groups.push_back({term});
  for (const auto& group : groups) {
    system.activate(group);
    Vector x = system.begin(request, StepTolerances());
    {
      auto data = x.getLocalViewHost(Tpetra::Access::ReadWrite);
      for (int i = 0; i < model.space().dofs()->num_owned_dofs(); ++i)
        if (!system.constraints().mask(i))
          data(i, 0) += 0.4 * uniform(random) * changes[model.space().dofs()->field_of(i)];
    }
    EXPECT_LT(jacobian_error(model, x, random), c.tolerance) << (group.size() == 1 ? group[0]->name() : "all terms");
  }
}

TEST(Jacobian, EqualsDifferencedResidualOfElasticSoil) {
  for (const char* cell : {"tri6", "quad9"})
    for (const char* geometry : {"plane strain", "axisymmetric"})
      for (const char* integrator : {"generalised alpha", "newmark", "theta"})
        check({cell, geometry, elastic(), integrator, 1e-6});
}

TEST(Jacobian, EqualsDifferencedResidualInSpace) {
  for (const char* cell : {"tet10", "hex27"})
    for (const char* integrator : {"generalised alpha", "theta"})
      check({cell, "three-dimensional", elastic(), integrator, 1e-6});
}

TEST(Jacobian, EqualsDifferencedResidualOfEqualOrderCells) {
  check({"tri3", "plane strain", elastic(), "generalised alpha", 1e-6});
  check({"quad4", "axisymmetric", elastic(), "generalised alpha", 1e-6});
  for (const char* cell : {"tet4", "hex8"}) check({cell, "three-dimensional", elastic(), "generalised alpha", 1e-6});
}

TEST(Jacobian, EqualsDifferencedResidualOfWarmSoil) {
  for (const char* geometry : {"plane strain", "axisymmetric"})
    for (const char* integrator : {"generalised alpha", "theta"})
      check({"tri6", geometry, elastic(), integrator, 1e-6, true});
}

TEST(Jacobian, EqualsDifferencedResidualOfSoilUnderSuction) {
  for (const double pore_pressure : {-2e4, 2e4})
    for (const char* integrator : {"generalised alpha", "theta"}) {
      check({"tri6", "axisymmetric", elastic(), integrator, 1e-6, false, true, pore_pressure});
      check({"hex27", "three-dimensional", elastic(), integrator, 1e-6, false, true, pore_pressure});
    }
}

TEST(Jacobian, EqualsDifferencedResidualOfYieldingClay) {
  for (const char* geometry : {"plane strain", "axisymmetric"})
    check({"tri6", geometry, cam_clay(), "generalised alpha", 1e-3});
  check({"tet10", "three-dimensional", cam_clay(), "generalised alpha", 1e-3});
}

}  // namespace
}  // namespace mudline
