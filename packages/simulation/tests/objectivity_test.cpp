// The effective stress of a block in rigid rotation rotates with it, for any size of steps.
#include <gtest/gtest.h>

#include <cmath>

#include "block_fixture.hpp"
#include "materials/pointwise.hpp"

namespace mudline {
namespace {

using namespace mudline::testing;

constexpr double pi = 3.14159265358979323846;
constexpr double xx = -8e4, yy = -1e5, zz = -7e4, xy = 1.5e4;  // tension positive

/// Entries of the initial state: the stress, and `more`.
std::string stressed(const std::string& more = "") {
  return list("initial state", text("type", "uniform") + number("effective stress xx", -xx) +
                                   number("effective stress yy", -yy) + number("effective stress zz", -zz) +
                                   number("shear stress xy", -xy) + number("pore pressure", 2e4) + more);
}

/// Conditions that turn the block by a quarter about the origin within 90 s.
std::string turning() {
  return move_all_sides("x*cos(pi*t/180) - y*sin(pi*t/180) - x", "x*sin(pi*t/180) + y*cos(pi*t/180) - y");
}

void expect_turned(Block& block, const State& state, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double exact[6] = {c * c * xx - 2 * c * s * xy + s * s * yy, s * s * xx + 2 * c * s * xy + c * c * yy, zz, 0, 0,
                           c * s * (xx - yy) + (c * c - s * s) * xy};
  const PointView stress = block.stress(state), void_ratio = block.void_ratio(state);
  const double mean = (xx + yy + zz) / 3;
  const double j2 = (std::pow(xx - yy, 2) + std::pow(yy - zz, 2) + std::pow(zz - xx, 2)) / 6 + xy * xy;
  for (std::size_t i = 0; i < stress.extent(0); ++i) {
    for (int k = 0; k < 6; ++k) ASSERT_NEAR(stress(i, k), exact[k], 1e-10 * 1e5) << "component " << k;
    const double a = stress(i, 0), b = stress(i, 1), d = stress(i, 2), e = stress(i, 5);
    ASSERT_NEAR((a + b + d) / 3, mean, 1e-10 * 1e5);
    ASSERT_NEAR((std::pow(a - b, 2) + std::pow(b - d, 2) + std::pow(d - a, 2)) / 6 + e * e, j2, 1e-10 * j2);
    ASSERT_NEAR(void_ratio(i, 0), 0.8, 1e-12);
  }
}

/// The rotated block fulfils the equations, and its trial state is the rotated one. (Newton's method is not used: with
/// the interior left behind, the first guess of so large a step would be folded.)
void turn(Block& block, int steps) {
  Model& model = block.model();
  const auto& initial = model.mesh().coordinates();
  for (int n = 1; n <= steps; ++n) {
    Vector x = model.system().begin(block.request(90.0 / steps), StepTolerances()), f(model.system().map());
    const double angle = 0.5 * pi * n / steps;
    {
      auto data = x.getLocalViewHost(Tpetra::Access::ReadWrite);
      for (int node = 0; node < model.mesh().num_nodes(); ++node) {
        const int dof = model.space().node_dof(0)(node);
        const double X = initial(node, 0), Y = initial(node, 1);
        data(dof, 0) = X * std::cos(angle) - Y * std::sin(angle) - X;
        data(dof + 1, 0) = X * std::sin(angle) + Y * std::cos(angle) - Y;
      }
    }
    // from the Jacobian the system estimates how far the rounding of x affects the residual
    ASSERT_TRUE(model.system().jacobian(x));
    ASSERT_TRUE(model.system().residual(x, f));
    for (const double ratio : model.system().residual_ratios(f)) EXPECT_LT(ratio, 1);
    model.store().accept();
    expect_turned(block, model.store().committed(), angle);
  }
}

void turn(const std::string& cell, const std::string& skeleton, int steps) {
  SCOPED_TRACE(cell + " in " + std::to_string(steps) + " steps");
  Block block(cell, "plane strain", skeleton, turning(), stressed());
  turn(block, steps);
}

constexpr int many = 12;  // number of tensors

/// A law that is elastic in volume only, with tensors that rotate with the material: 1, 2, ... times the same one.
struct ManyTensors {
  static constexpr double tensor[6] = {3, 1, 2, 0, 0, 0.5};
  void parameters(Parameters&) {}
  static std::vector<StateVariable> state() {
    std::vector<StateVariable> variables;
    for (int k = 0; k < many; ++k) {
      variables.push_back({"number " + std::to_string(k), 1, "-"});
      variables.push_back({"tensor " + std::to_string(k), 6, "-"});
    }
    return variables;
  }
  std::string initialise(const InitialPoint&, double* to) const {
    for (int k = 0; k < many; ++k) {
      *to++ = k;
      for (double t : tensor) *to++ = (k + 1) * t;
    }
    return "";
  }
  ElasticModuli moduli(const double*, double, const double*) const { return {1e7, 1e7}; }
  KOKKOS_FUNCTION bool operator()(const SkeletonPoint& in, const double* old, double* now,
                                  SkeletonResponse& out) const {
    for (int i = 0; i < 7 * many; ++i) now[i] = old[i];
    for (int i = 0; i < 6; ++i) {
      out.stress[i] = in.stress[i] + (i < 3 ? 1e7 * (in.strain[0] + in.strain[1] + in.strain[2]) : 0.0);
      if (in.want_tangent)
        for (int j = 0; j < 6; ++j) out.tangent[6 * i + j] = i < 3 && j < 3 ? 1e7 : 0.0;
    }
    return true;
  }
};
constexpr double ManyTensors::tensor[6];

TEST(Objectivity, EveryTensorOfTheStateTurnsWithTheBlock) {
  Block block("tri6", "plane strain", list("skeleton", text("type", "many tensors")), turning(), stressed(),
              number("bulk modulus", 5e7), [](Registries& registries) {
                registries.skeletons.add<PointwiseSkeleton<ManyTensors>>("many tensors", "of a test");
              });
  turn(block, 2);
  // after the quarter turn x and y have changed places
  const double* t = ManyTensors::tensor;
  const double turned[6] = {t[1], t[0], t[2], 0, 0, -t[5]};
  const State& state = block.model().store().committed();
  const PointView law = state.arrays[block.model().soil()->blocks.front().law];
  for (std::size_t i = 0; i < law.extent(0); ++i)
    for (int k = 0; k < many; ++k) {
      ASSERT_EQ(law(i, 7 * k), k);
      for (int c = 0; c < 6; ++c) ASSERT_NEAR(law(i, 7 * k + 1 + c), (k + 1) * turned[c], 1e-12) << "tensor " << k;
    }
}

TEST(Objectivity, StressTurnsWithTheBlock) {
  for (const char* cell : {"tri6", "quad9"})
    for (const int steps : {1, 2, 7}) turn(cell, elastic_skeleton(), steps);
}

TEST(Objectivity, ClayKeepsItsState) {
  for (const int steps : {1, 2, 7}) turn("quad9", cam_clay_skeleton(), steps);
}

TEST(Objectivity, NewtonFindsTheRotation) {
  // inside the yield surface; on it a rotation without strain would be at the kink between loading and unloading
  const std::string inside = stressed(number("overconsolidation ratio", 1.5));
  for (const auto& [skeleton, start] : {std::pair{elastic_skeleton(), stressed()}, {cam_clay_skeleton(), inside}}) {
    Block block("tri6", "plane strain", skeleton, turning(), start);
    for (int n = 1; n <= 3; ++n) {
      const StepReport report = block.step(1.0, {1e-6, 1e-10, 1e-13});
      ASSERT_TRUE(report.converged) << skeleton << ", step " << n << ": " << report.reason;
      block.model().store().accept();
    }
    expect_turned(block, block.model().store().committed(), 3 * pi / 180);
  }
}

}  // namespace
}  // namespace mudline
