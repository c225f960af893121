// Turning vectors and tensors of an axisymmetric section into space.
#include "ale/axial_section.hpp"

#include <gtest/gtest.h>

#include "tensor/mat.hpp"

namespace mudline {
namespace {

constexpr Point place{-1.2, 0.9, -3.0};  // radius 1.5

TEST(AxialSection, PlaceIsRadiusAndHeight) {
  const Point at = AxialSection::place(place);
  EXPECT_DOUBLE_EQ(at[0], 1.5);
  EXPECT_DOUBLE_EQ(at[1], -3.0);
  EXPECT_EQ(at[2], 0.0);
}

TEST(AxialSection, VectorPointsAwayFromTheAxisAndUp) {
  const Point v = AxialSection(place).vector({2, 5, 0});
  EXPECT_DOUBLE_EQ(v[0], -1.6);
  EXPECT_DOUBLE_EQ(v[1], 1.2);
  EXPECT_DOUBLE_EQ(v[2], 5.0);
}

// The traction of a turned stress is the turned traction, and the hoop stress acts across the section.
TEST(AxialSection, TensorActsAsInTheSection) {
  const AxialSection section(place);
  const double radial = -3, axial = -7, hoop = -2, shear = 1.5;
  const double in_section[6] = {radial, axial, hoop, 0, 0, shear};
  double s[6];
  section.tensor(in_section, s);
  const Mat<double, 3> stress{{{s[0], s[5], s[4]}, {s[5], s[1], s[3]}, {s[4], s[3], s[2]}}};
  const Point n = section.vector({0.6, 0.8, 0}), around{-0.6, -0.8, 0};
  const Point traction = stress * n,
              expected = section.vector({0.6 * radial + 0.8 * shear, 0.6 * shear + 0.8 * axial, 0}),
              across = stress * around;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(traction[i], expected[i], 1e-14);
    EXPECT_NEAR(across[i], hoop * around[i], 1e-14);
  }
}

// On the axis any direction is as good as another.
TEST(AxialSection, AxisIsFinite) { EXPECT_EQ(AxialSection({0, 0, 4}).vector({1, 2, 0})[2], 2.0); }

}  // namespace
}  // namespace mudline
