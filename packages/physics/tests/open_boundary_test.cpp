// A boundary that is open to water: what passes it, the pressure that a vertex keeps, and its derivatives.
#include "physics/biot/open_boundary.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "soil_model.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

constexpr double mobility = 1e-8, slope = 500, outside = 3 * slope;  // [m2/(Pa s)], [Pa/m], [Pa] at the top, y = 3 m

struct OpenTop {
  explicit OpenTop(const std::string& geometry = "plane strain") : model("", "", SoilModel::box(geometry)) {
    const int dofs = model.space->dofs()->num_overlap_dofs();
    open = Kokkos::View<char*>("open", dofs);
    around = NodalView("outside", dofs);
    for (const int node : model.mesh->nodes_of_set("top")) {
      if (model.p(node) < 0) continue;
      open(model.p(node)) = 1;
      around(model.p(node)) = outside;
    }
    model.view.open = open;
    model.view.outside = around;
    model.set_pressure(model.value, [](double, double y) { return slope * y; });
    for (const char* name : {"fluid mass", "open boundary"}) terms.push_back(&model.term(name));
  }
  void evaluate() {
    const int dofs = model.space->dofs()->num_overlap_dofs();
    sum = NodalView("sum", dofs);
    acting = NodalView("acting", dofs);
    whole = NodalView("whole", dofs);
    passing = NodalView("passing", dofs);
    for (Term* term : terms) {
      term->begin(model.view);
      EXPECT_EQ(term->residual(model.view, ResidualView(sum, acting, whole, passing)), 0);
    }
  }

  SoilModel model;
  Kokkos::View<char*> open;
  NodalView around, sum, acting, whole, passing;
  std::vector<Term*> terms;
};

TEST(OpenBoundary, WaterPassesItAndLeavesItsPressure) {
  OpenTop top;
  top.evaluate();
  EXPECT_NEAR(top.model.sum(top.sum, 2, "top"), 0, 1e-20);
  EXPECT_NEAR(top.model.sum(top.passing, 2, "top"), mobility * slope * 2, 1e-15);  // along a top of 2 m
  EXPECT_NEAR(top.model.sum(top.passing, 2), mobility * slope * 2, 1e-15);
  EXPECT_NEAR(top.model.sum(top.sum, 2, "bottom"), -mobility * slope * 2, 1e-15);
}

TEST(OpenBoundary, WhatAVertexKeepsFlowsOutByTheConductionOfItsElements) {
  OpenTop top;
  top.evaluate();
  const NodalView before = top.sum;
  constexpr double more = 200;  // [Pa]
  for (const int node : top.model.mesh->nodes_of_set("top"))
    if (top.model.p(node) >= 0) top.model.value(top.model.p(node)) += more;
  top.evaluate();
  for (int node = 0; node < top.model.mesh->num_nodes(); ++node) {
    const int dof = top.model.p(node);
    if (dof < 0) continue;
    const bool corner = std::abs(top.model.x(node, 0) - 2) > 0.5;  // of a square bilinear cell: int grad(N)^2 = 2/3
    const double flow = top.open(dof) ? mobility * more * (corner ? 1 : 2) * 2.0 / 3 : 0.0;
    EXPECT_NEAR(top.sum(dof) - before(dof), flow, 1e-15) << node;
  }
  // the water comes from what is stored at the vertices: none of it passes from the inside
  EXPECT_NEAR(top.model.sum(top.passing, 2, "top") + 8.0 / 3 * mobility * more, mobility * slope * 2, 1e-15);
}

TEST(OpenBoundary, SoilThatCannotDrainKeepsItsVolumeThere) {
  // div v = 1e-3/s: the water that the top's vertices store is asked for at their own rows
  OpenTop top;
  top.model.set_motion(top.model.rate, [](double x, double) { return Vec<double, 2>{1e-3 * x, 0}; });
  top.evaluate();
  EXPECT_NEAR(top.model.sum(top.sum, 2, "top"), 1e-3 * 2 * 0.5, 1e-12);  // half of the upper cells, 2 m x 1 m
}

TEST(OpenBoundary, DerivativesAreThoseOfItsBalance) {
  for (const char* geometry : {"plane strain", "axisymmetric"}) {
    OpenTop top(geometry);
    SoilModel& model = top.model;
    model.set_pressure(model.value, [](double x, double y) { return 1e4 * std::exp(x - y); });
    model.set_pressure(model.rate, [](double x, double y) { return 1e3 * x * y; });
    model.view.sensitivity.assign(2, {1, 0, 0, 0});
    Assembler assembler(model.space->dofs());
    model.soil->sparsity(assembler);
    assembler.finalise();
    const int dofs = model.space->dofs()->num_overlap_dofs();
    top.evaluate();
    assembler.begin(Kokkos::View<char*>("constrained", dofs));
    for (Term* term : top.terms) term->jacobian(model.view, assembler, 1.0);
    assembler.end();
    Vector change(model.space->dofs()->owned()), found(model.space->dofs()->owned());
    constexpr double h = 10;  // [Pa] the balance is linear in the pressures
    {
      auto data = change.getLocalViewHost(Tpetra::Access::OverwriteAll);
      for (int node = 0; node < model.mesh->num_nodes(); ++node)
        if (model.p(node) >= 0) data(model.p(node), 0) = h * std::sin(5.0 * node);
      const NodalView before = top.sum;
      for (int i = 0; i < dofs; ++i) model.value(i) += data(i, 0);
      top.evaluate();
      for (int i = 0; i < dofs; ++i) top.sum(i) -= before(i);
    }
    assembler.matrix()->apply(change, found);
    const auto product = found.getLocalViewHost(Tpetra::Access::ReadOnly);
    double size = 0;
    for (int node = 0; node < model.mesh->num_nodes(); ++node)
      if (const int dof = model.p(node); dof >= 0) {
        EXPECT_NEAR(product(dof, 0), top.sum(dof), 1e-16) << geometry << node;
        size = std::max(size, std::abs(product(dof, 0)));
      }
    EXPECT_GT(size, 1e-8);
  }
}

}  // namespace
}  // namespace mudline
