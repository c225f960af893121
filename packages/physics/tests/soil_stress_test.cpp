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
