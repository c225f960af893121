// Extrapolation of the stress from an element's points to positions on its surface.
#include "physics/soil_stress.hpp"

#include <gtest/gtest.h>

#include "soil_model.hpp"

namespace mudline {
namespace {

TEST(SoilStress, IsExactWhereItIsLinearAndHasTheWaterInIt) {
  const std::string materials = SoilModel::sand(number_parameter("Biot coefficient", 0.8), "", "sand");
  for (const char* geometry : {"plane strain", "axisymmetric"}) {
    SoilModel model("", "", SoilModel::box(geometry), materials);
    State& state = model.store->committed();
    const auto effective = [](int c, double x, double y) { return -100.0 * (c + 1) + 3 * (c - 2) * x + 7 * c * y; };
    const auto pressure = [](double x, double y) { return 50 + 11 * x - 13 * y; };
    for (const SoilBlock& b : model.soil->blocks)
      for (int e = 0; e < b.elements; ++e)
        for (int q = 0; q < b.points; ++q) {
          const Point at = b.place(e, q, state.coordinates);
          for (int c = 0; c < 6; ++c) state.arrays[b.stress](e * b.points + q, c) = effective(c, at[0], at[1]);
        }
    model.set_pressure(state.value, pressure);
    // corners of the first cell, [1, 2] x [0, 1]
    for (const Point& at : {Point{1, 0, 0}, Point{2, 0, 0}, Point{1.5, 1, 0}}) {
      const auto found = total_stress(*model.soil, state, 0, 0, at);
      for (int c = 0; c < 6; ++c) {
        const double expected = effective(c, at[0], at[1]) - (c < 3 ? 0.8 * pressure(at[0], at[1]) : 0.0);
        EXPECT_NEAR(found[c], expected, 1e-9) << c;
      }
    }
  }
}

TEST(SoilStress, UndrainedStrengthIsExactWhereItIsLinear) {
  const std::string clay = section_xml(
      "clay", number_parameter("porosity", 0.4) + number_parameter("grain density", 2600) +
                  section_xml("skeleton",
                              text_parameter("type", "tresca") + number_parameter("undrained strength", 9e3) +
                                  number_parameter("undrained strength gradient", 2e3) +
                                  number_parameter("reference elevation", 3) + number_parameter("rigidity index", 100) +
                                  number_parameter("Poisson's ratio", 0.49)) +
                  section_xml("fluid", text_parameter("type", "water")) +
                  section_xml("permeability",
                              text_parameter("type", "constant") + number_parameter("hydraulic conductivity", 1e-9)));
  SoilModel model("", "", SoilModel::box("plane strain"), clay);
  const State& state = model.store->committed();
  for (const Point& at : {Point{1, 0, 0}, Point{2, 1, 0}, Point{1.5, 0.3, 0}})
    EXPECT_NEAR(undrained_strength(*model.soil, state, 0, 0, at), 9e3 + 2e3 * (3 - at[1]), 1e-6);
  SoilModel without("", "", SoilModel::box("plane strain"));
  EXPECT_TRUE(std::isnan(undrained_strength(*without.soil, without.store->committed(), 0, 0, {1, 0, 0})));
}

TEST(SoilStress, OfOnePointIsThatPoints) {
  SoilModel model("", "<Parameter name=\"quadrature degree\" type=\"int\" value=\"1\"/>\n",
                  SoilModel::box("plane strain"));
  State& state = model.store->committed();
  const SoilBlock& b = model.soil->blocks.front();
  for (int q = 0; q < b.points; ++q)
    for (int c = 0; c < 6; ++c) state.arrays[b.stress](q, c) = -10.0 * (c + 1);
  const auto found = total_stress(*model.soil, state, 0, 0, {1, 0, 0});
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(found[c], -10.0 * (c + 1), 1e-12);
}

}  // namespace
}  // namespace mudline
