// Patch tests: fields that the elements represent exactly must be found exactly on distorted meshes, in both
// geometries.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "block_fixture.hpp"

namespace mudline {
namespace {

using namespace mudline::testing;

struct Patch {
  std::string cell, geometry;
  bool axisymmetric() const { return geometry == "axisymmetric"; }
};

std::vector<Patch> patches() {
  std::vector<Patch> all;
  for (const char* cell : {"tri6", "quad9"})
    for (const char* geometry : {"plane strain", "axisymmetric"}) all.push_back({cell, geometry});
  return all;
}

StepTolerances tight() { return {1e-11, 1e-9, 1e-12}; }

/// Largest difference of a field from exact(X, component), over the field's largest value.
double error(Model& model, const State& state, const std::string& field,
             const std::function<double(double, double, int)>& exact) {
  const Space& space = model.space();
  const int f = space.find(field);
  double difference = 0, size = 0;
  for (int node = 0; node < space.mesh().num_nodes(); ++node) {
    const int dof = space.node_dof(f)(node);
    if (dof < 0) continue;
    for (int i = 0; i < space.field(f).components; ++i) {
      const double value = exact(space.mesh().coordinates()(node, 0), space.mesh().coordinates()(node, 1), i);
      difference = std::max(difference, std::abs(state.value(dof + i) - value));
      size = std::max(size, std::abs(value));
    }
  }
  return difference / size;
}

/// Sides move with a homogeneous deformation of several per cent in one sealed step: the interior follows, pressure and
/// stress are uniform.
TEST(Patch, HomogeneousDeformationOfSealedSoil) {
  for (const Patch& patch : patches()) {
    SCOPED_TRACE(patch.cell + ", " + patch.geometry);
    const std::string x = patch.axisymmetric() ? "0.03*r" : "0.02*x + 0.05*y";
    const std::string y = patch.axisymmetric() ? "-0.04*z" : "0.01*x - 0.03*y";
    Block block(patch.cell, patch.geometry, elastic_skeleton(), move_all_sides(x, y));
    ASSERT_TRUE(block.step(1.0, tight()).converged);
    const State& state = block.model().store().trial();
    EXPECT_LT(error(block.model(), state, "displacement",
                    [&](double X, double Y, int i) {
                      if (patch.axisymmetric()) return i == 0 ? 0.03 * X : -0.04 * Y;
                      return i == 0 ? 0.02 * X + 0.05 * Y : 0.01 * X - 0.03 * Y;
                    }),
              1e-9);
    const double pressure = state.value(block.model().space().node_dof(1)(0));
    EXPECT_GT(std::abs(pressure), 1e4);
    EXPECT_LT(error(block.model(), state, "pore pressure", [&](double, double, int) { return pressure; }), 1e-9);
    EXPECT_LT(block.stress_spread(state), 1e-9);
  }
}

/// A linear pressure on the sides drives a uniform flow through soil that the seepage force and gravity hold in balance
/// while the sides shear it (axisymmetric: stretch it) at constant volume.
TEST(Patch, LinearPressureAndUniformFlow) {
  for (const Patch& patch : patches()) {
    SCOPED_TRACE(patch.cell + ", " + patch.geometry);
    const double wide = 1e-6, high = -wide * (2 + wide) / std::pow(1 + wide, 2);  // (1 + wide)^2 (1 + high) = 1
    const double density = 1000 * 4 / 9.0 + 2650 * 5 / 9.0, gx = patch.axisymmetric() ? 0.0 : 3.0, gy = -9.0;
    const auto pressure = [&](double X, double Y) {  // grad p = rho g on the deformed block
      const double x = patch.axisymmetric() ? X : X + 1e-3 * Y, y = patch.axisymmetric() ? (1 + high) * Y : Y;
      return density * (gx * x + gy * y) + 4e4;
    };
    const auto moved = [&](double X, double Y, int i) {
      if (patch.axisymmetric()) return i == 0 ? wide * X : high * Y;
      return i == 0 ? 1e-3 * Y : 0.0;
    };
    const std::string at_x = patch.axisymmetric() ? "0" : "(x + 1e-3*y)",
                      at_y = patch.axisymmetric() ? precise(1 + high) + "*z" : "y";
    const std::string p =
        precise(density) + "*(" + precise(gx) + "*" + at_x + " + " + precise(gy) + "*" + at_y + ") + 4e4";
    const std::string moving = patch.axisymmetric() ? move_all_sides(precise(wide) + "*r", precise(high) + "*z")
                                                    : move_all_sides("1e-3*y", "0");
    Block block(patch.cell, patch.geometry, elastic_skeleton(), moving + pressure_on_all_sides(p),
                par("gravity", "Array(double)", "{" + precise(gx) + ", " + precise(gy) + "}"),
                par("incompressible", "bool", "true"));
    ASSERT_TRUE(block.step(1.0, tight()).converged);
    const State& state = block.model().store().trial();
    EXPECT_LT(error(block.model(), state, "displacement", moved), 1e-9);
    const auto exact_pressure = [&](double X, double Y, int) { return pressure(X, Y); };
    EXPECT_LT(error(block.model(), state, "pore pressure", exact_pressure), 1e-9);
  }
}

}  // namespace
}  // namespace mudline
