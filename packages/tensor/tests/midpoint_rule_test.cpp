#include "tensor/midpoint_rule.hpp"
#include "tensor/mat.hpp"

#include <gtest/gtest.h>

namespace mudline {
namespace {

template <int D>
Mat<double, D> unit_plus(const Mat<double, D>& x, double factor = 1) {
  Mat<double, D> r{};
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) r[i][j] = (i == j ? 1.0 : 0.0) + factor * x[i][j];
  return r;
}

template <int D>
Mat<double, D> inverse(const Mat<double, D>& x) {
  Mat<double, D> r;
  invert(x, determinant(x), r);
  return r;
}

/// The midpoint rule for the deformation gradient F of a step; H = 2 (F - 1) (F + 1)^-1.
template <int D>
MidpointRule<D> rule_of(const Mat<double, D>& F, double hoop = 0) {
  const Mat<double, D> half = inverse(unit_plus(F));
  Mat<double, D> less = F;
  for (int i = 0; i < D; ++i) less[i][i] -= 1;
  Mat<double, D> H = less * half;
  for (auto& row : H.at)
    for (double& h : row) h *= 2;
  MidpointRule<D> rule;
  rule.evaluate(H, hoop, true);
  return rule;
}

/// Rotation about an axis by an angle.
Mat<double, 3> rotation(const double (&axis)[3], double angle) {
  const double size = std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]), c = std::cos(angle);
  Mat<double, 3> R{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      R[i][j] = (i == j ? c : 0.0) + (1 - c) * axis[i] * axis[j] / (size * size);
      if (i != j) R[i][j] += ((j - i + 3) % 3 == 1 ? -1 : 1) * std::sin(angle) * axis[3 - i - j] / size;
    }
  return R;
}

const Mat<double, 3> stretch{{{1.05, 0.02, -0.03}, {0.04, 0.97, 0.01}, {-0.02, 0.05, 1.02}}};

TEST(MidpointRule, RotationGivesNoStrain) {
  const Mat<double, 3> R = rotation({0.3, -0.8, 0.5}, 1.1);
  const MidpointRule<3> rule = rule_of(R);
  double e[6];
  rule.increment(e);
  for (double component : e) EXPECT_NEAR(component, 0, 1e-15);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(rule.rotation[i][j], R[i][j], 1e-15);
  const Mat<double, 3> half = rotation({0.3, -0.8, 0.5}, 0.55);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(rule.half[i][j], half[i][j], 1e-15);
}

TEST(MidpointRule, VolumeIsThatOfTheMotion) {
  const MidpointRule<3> rule = rule_of(stretch);
  EXPECT_NEAR(rule.log_volume, std::log(determinant(stretch)), 1e-15);
  double e[6];
  rule.increment(e);
  EXPECT_NEAR(e[0] + e[1] + e[2], rule.log_volume, 1e-15);
}

TEST(MidpointRule, StrainIsOfSecondOrderUnderStretchAndRotation) {
  // error of one step against the exact logarithmic strain of a stretch along x with simultaneous rotation; it falls
  // with the cube of the size
  const auto error = [](double size) {
    Mat<double, 3> F = rotation({0, 0, 1}, size);
    for (int i = 0; i < 3; ++i) F[i][0] *= std::exp(size);
    double e[6];
    rule_of(F).increment(e);
    const double c = std::cos(size), s = std::sin(size);
    return std::abs(e[0] - size * c * c) + std::abs(e[1] - size * s * s) + std::abs(e[5] - 2 * size * c * s);
  };
  EXPECT_GT(error(0.1), 1e-5);
  EXPECT_GT(error(0.1) / error(0.05), 7.0);
}

TEST(MidpointRule, PlaneIsSpaceThatStandsStillAcross) {
  const Mat<double, 2> H = {{{0.1, 0.3}, {-0.2, 0.05}}};
  const double hoop = 0.07;
  const Mat<double, 3> whole = {{{0.1, 0.3, 0}, {-0.2, 0.05, 0}, {0, 0, hoop}}};
  MidpointRule<2> plane;
  MidpointRule<3> space;
  plane.evaluate(H, hoop, true);
  space.evaluate(whole, 0.0, true);
  EXPECT_NEAR(plane.log_volume, space.log_volume, 1e-16);
  double a[6], b[6];
  plane.increment(a);
  space.increment(b);
  const double s[6] = {1, 2, 3, 4, 5, 6};
  double turned[6], turned_in_space[6];
  plane.rotate(s, turned);
  space.rotate(s, turned_in_space);
  for (int c = 0; c < 6; ++c) {
    EXPECT_NEAR(a[c], b[c], 1e-15);
    EXPECT_NEAR(turned[c], turned_in_space[c], 1e-14);
  }
  double e[4][MidpointRule<2>::width], turn[1][MidpointRule<2>::width];
  double e_in_space[6][MidpointRule<3>::width], turn_in_space[3][MidpointRule<3>::width];
  plane.variations(e, turn);
  space.variations(e_in_space, turn_in_space);
  for (int way = 0; way < MidpointRule<2>::ways; ++way) {
    const int in_space = way < 4 ? 3 * (way / 2) + way % 2 : 8;
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(e[k][way], e_in_space[MidpointRule<2>::place(k)][in_space], 1e-15) << way;
    for (int c : {3, 4}) EXPECT_NEAR(e_in_space[c][in_space], 0, 1e-15);
    EXPECT_NEAR(turn[0][way], turn_in_space[2][in_space], 1e-15);
  }
}

/// d strain = variation + W strain - strain W, and dR = W R, by central differences.
TEST(MidpointRule, VariationsAgreeWithDifferences) {
  const Mat<double, 3> F = rotation({0.2, 0.9, -0.4}, 0.6) * stretch;
  const MidpointRule<3> rule = rule_of(F);
  const double h = 1e-6;
  double of_strain[6][MidpointRule<3>::width], turns[3][MidpointRule<3>::width];
  rule.variations(of_strain, turns);
  for (int j = 0; j < 3; ++j)
    for (int m = 0; m < 3; ++m) {
      Mat<double, 3> G{};
      G[j][m] = 1;
      const MidpointRule<3> after = rule_of(unit_plus(G, h) * F), before = rule_of(unit_plus(G, -h) * F);
      double e[6], turn[3], ahead[6], behind[6], turned[6];
      for (int c = 0; c < 6; ++c) e[c] = of_strain[c][3 * j + m];
      for (int k = 0; k < 3; ++k) turn[k] = turns[k][3 * j + m];
      after.increment(ahead);
      before.increment(behind);
      double tensor[6];
      rule.increment(tensor);
      for (int c = 3; c < 6; ++c) tensor[c] *= 0.5;
      MidpointRule<3>::stress_rotation_rate(turn, tensor, turned);
      for (int c = 0; c < 6; ++c)
        EXPECT_NEAR(e[c] + (c < 3 ? 1 : 2) * turned[c], (ahead[c] - behind[c]) / (2 * h), 1e-9) << j << m << c;
      const Mat<double, 3> W = {{{0, -turn[2], turn[1]}, {turn[2], 0, -turn[0]}, {-turn[1], turn[0], 0}}};
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
          double dR = 0;
          for (int l = 0; l < 3; ++l) dR += W[i][l] * rule.rotation[l][k];
          EXPECT_NEAR(dR, (after.rotation[i][k] - before.rotation[i][k]) / (2 * h), 1e-9);
        }
    }
}

}  // namespace
}  // namespace mudline
