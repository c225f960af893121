// Mass balance of the pore fluid on states whose answer is known: storage, flow, their signs and their geometry.
#include "physics/biot/fluid_mass.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "soil_model.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

constexpr double mobility = 1e-8, storage = 0.4 / 2e9, pi = 3.14159265358979323846;

TEST(FluidMass, VolumeChangeAndCompressionAreStored) {
  for (const bool round : {false, true}) {
    SoilModel model("", "", SoilModel::box(round ? "axisymmetric" : "plane strain"));
    const double volume = round ? pi * (9 - 1) * 3 : 2 * 3;
    // grows uniformly: what flows in is alpha div v, positive
    model.set_motion(model.rate, [](double x, double y) { return Vec<double, 2>{1e-3 * x, 2e-3 * y}; });
    EXPECT_NEAR(model.sum(model.residual(model.term("fluid mass")), 2), (round ? 4e-3 : 3e-3) * volume, 1e-12);
    Kokkos::deep_copy(model.rate, 0.0);
    model.set_pressure(model.rate, [](double, double) { return 5e3; });
    EXPECT_NEAR(model.sum(model.residual(model.term("fluid mass")), 2), storage * 5e3 * volume, 1e-17);
  }
}

TEST(FluidMass, FlowsFromHighToLowPressure) {
  SoilModel model;
  model.set_pressure(model.value, [](double x, double) { return 1e4 * (3 - x); });
  const NodalView f = model.residual(model.term("fluid mass"));
  const double discharge = mobility * 1e4 * 3;             // to the right, through 3 m2
  EXPECT_NEAR(model.sum(f, 2, "left"), discharge, 1e-15);  // what must come in there
  EXPECT_NEAR(model.sum(f, 2, "right"), -discharge, 1e-15);
  EXPECT_NEAR(model.sum(f, 2), 0, 1e-16);
  EXPECT_EQ(model.sum(f, 0), 0);  // acts on no displacement
}

TEST(FluidMass, AxisymmetricFlowIsThatOfACircle) {
  SoilModel model("", "", SoilModel::box("axisymmetric"));
  model.set_pressure(model.value, [](double, double y) { return 1e4 * (3 - y); });
  const NodalView f = model.residual(model.term("fluid mass"));
  EXPECT_NEAR(model.sum(f, 2, "bottom"), mobility * 1e4 * pi * 8, 1e-13);
}

TEST(FluidMass, WaterAtRestDoesNotFlow) {
  SoilModel model("", array_parameter("gravity", "0, -10"));
  model.set_pressure(model.value, [](double, double y) { return 1e4 * (7 - y); });
  const NodalView f = model.residual(model.term("fluid mass"));
  for (int node = 0; node < model.mesh->num_nodes(); ++node) {
    if (model.p(node) >= 0) {
      EXPECT_NEAR(f(model.p(node)), 0, 1e-16);
    }
  }
}

TEST(FluidMass, StorageAndFlowActEachByItself) {
  // water flows to the right and is stored there, released on the left; convergence is measured against both
  SoilModel model;
  const auto acting = [&] {
    const NodalView none = model.residual(model.term("fluid mass"));
    const NodalView sum("sum", none.extent(0)), acts("acting", none.extent(0)), whole("whole", none.extent(0));
    model.term("fluid mass").residual(model.view, ResidualView(sum, acts, whole));
    double size = 0;
    for (std::size_t i = 0; i < acts.extent(0); ++i) {
      EXPECT_EQ(sum(i), none(i));
      EXPECT_GE(acts(i) * (1 + 1e-12), whole(i));
      size += acts(i);
    }
    EXPECT_EQ(acts(model.u(0, 0)), 0) << "no force";
    return size;
  };
  EXPECT_EQ(acting(), 0);
  model.set_pressure(model.value, [](double x, double) { return 1e4 * (3 - x); });
  const double flow = acting();
  EXPECT_GT(flow, mobility * 1e4);
  model.set_pressure(model.rate, [](double, double) { return 5e3; });
  EXPECT_NEAR(acting(), flow + storage * 5e3 * 2 * 3, 1e-12 * flow);
}

TEST(FluidMass, FluidAccelerationActsAsGravityDoes) {
  for (const bool on : {false, true}) {
    SoilModel model("", std::string("<Parameter name=\"fluid acceleration\" type=\"bool\" value=\"") +
                            (on ? "true" : "false") + "\"/>\n");
    model.set_motion(model.acceleration, [](double, double) { return Vec<double, 2>{2.0, 0.0}; });
    const NodalView f = model.residual(model.term("fluid mass"));
    EXPECT_NEAR(model.sum(f, 2, "right"), on ? mobility * 1000 * 2 * 3 : 0.0, 1e-16);
  }
}

TEST(FluidMass, PermeabilityAndStorageFollowTheVoidRatio) {
  const std::string soil = section_xml(
      "sand",
      number_parameter("porosity", 0.4) +
          section_xml("skeleton", text_parameter("type", "linear elastic") + number_parameter("Young's modulus", 1e7) +
                                      number_parameter("Poisson's ratio", 0.25)) +
          section_xml("fluid", text_parameter("type", "water") + number_parameter("bulk modulus", 2e9) +
                                   number_parameter("unit weight", 1e4)) +
          section_xml("permeability",
                      text_parameter("type", "kozeny-carman") + number_parameter("hydraulic conductivity", 1e-4)));
  SoilModel model("", "", SoilModel::box("plane strain"), soil);
  // stretched by a tenth along x within the step: grains keep their volume
  model.set_motion(model.store->trial().value, [](double x, double) { return Vec<double, 2>{0.1 * x, 0.0}; });
  for (int node = 0; node < model.mesh->num_nodes(); ++node)
    model.store->trial().coordinates(node, 0) = 1.1 * model.x(node, 0);
  const double e0 = 0.4 / 0.6, e = 1.1 * (1 + e0) - 1;
  const double ratio = (e * e * e / (1 + e)) / (e0 * e0 * e0 / (1 + e0));
  model.set_pressure(model.value, [](double, double y) { return 1e4 * y; });
  EXPECT_NEAR(model.sum(model.residual(model.term("fluid mass")), 2, "top"), ratio * mobility * 1e4 * 2.2, 1e-14);
  Kokkos::deep_copy(model.value, 0.0);
  model.set_pressure(model.rate, [](double, double) { return 5e3; });
  EXPECT_NEAR(model.sum(model.residual(model.term("fluid mass")), 2), e / (1 + e) / 2e9 * 5e3 * 6.6, 1e-16);
}

TEST(FluidMass, IsSilentWithoutFlowAndCountsFoldedElements) {
  SoilModel model;
  model.set_pressure(model.value, [](double x, double) { return 1e4 * x; });
  model.view.flow = false;
  const NodalView f = model.residual(model.term("fluid mass"));
  for (std::size_t i = 0; i < f.extent(0); ++i) EXPECT_EQ(f(i), 0);
  model.view.flow = true;
  for (int node = 0; node < model.mesh->num_nodes(); ++node)
    model.store->trial().coordinates(node, 0) = -model.x(node, 0);
  model.residual(model.term("fluid mass"));
  EXPECT_EQ(model.failures, 6);
}

}  // namespace
}  // namespace mudline
