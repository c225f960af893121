#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "contact/laws/impact_share.hpp"
#include "contact/nodes/node_contact.hpp"
#include "slope_friction.hpp"

namespace mudline {
namespace {

using Coordinates = Kokkos::View<double**, Kokkos::LayoutRight>;

struct Case {
  const char* name;
  Drawing drawing;
  double x, y, friction, multiplier;
  bool late;    // the node touches within the step
  bool corner;  // the closest point is a corner
  double viscous = 0;
};

TEST(NodeParameters, TheOverhangOfAnOpenEnd) {
  Teuchos::ParameterList list;
  Coordinates x("x", 3, 2);
  for (int i = 0; i < 3; ++i) x(i, 0) = 2 - i;  // from (2, 0) to (0, 0), its body below
  for (const double overhang : {0.0, 0.3}) {
    list.set("overhang", overhang);
    NodeParameters deck;
    Parameters p(Section(list, nullptr, nullptr, ""));
    deck.parameters(p);
    const SmoothSurface surface({{2, {0, 1, -1}}, {2, {1, 2, -1}}}, Drawing::linear, 1.5, deck.overhang, x);
    for (const double beyond : {-0.1, 0.2, 0.4}) {
      TargetPlace place;
      EXPECT_EQ(surface.find({0, 1}, {2 + beyond, 0.05}, {0, -1}, 1, x, place), beyond < overhang) << beyond;
    }
  }
}

/// A master of six nodes with its body below, nodes to the left, and one slave node; the master's spacing is uneven.
class EveryState : public testing::TestWithParam<Case> {
 protected:
  EveryState() : friction_(GetParam().friction), x_("x", 7, 2), old_("old", 7, 2) {
    const double places[6][2] = {{2.5, 0.02}, {1.9, 0.12}, {1.0, 0.2}, {0.1, 0.14}, {-0.6, -0.03}, {-1.4, 0.05}};
    for (int i = 0; i < 6; ++i)
      for (int k = 0; k < 2; ++k) {
        x_(i, k) = places[i][k];
        old_(i, k) = places[i][k] - (k == 0 ? 0.003 : 0.001 * i);
      }
    const Case c = GetParam();
    x_(6, 0) = c.x;
    x_(6, 1) = c.y;
    old_(6, 0) = c.x - 0.006;
    old_(6, 1) = c.y + 0.002;
    for (int i = 0; i < 5; ++i) sides_.push_back({2, {i, i + 1, -1}});
    surface_ = std::make_unique<SmoothSurface>(sides_, c.drawing, 1.5, 0.1, old_);
    law_.penalty = 1e6;
    old_state_.shift = c.multiplier / law_.penalty;
    old_state_.shear.shear[0] = 0.2 * c.multiplier;
    old_state_.normal_force = 2e4;
    old_state_.gap = 0.01;
    if (c.friction > 0) law_.friction = &friction_;
    law_.conserves = c.late;
    law_.viscous = c.viscous;
    if (c.late || c.viscous > 0) law_.start_weight = 0.4;
  }
  /// Acting force at the present coordinates, by node of the surface (six, then the slave), with the derivatives by
  /// them.
  ContactPoint evaluate(double (&f)[14], double (&k)[14][14]) {
    TargetPlace place;
    std::vector<int> all(surface_->pieces());
    std::iota(all.begin(), all.end(), 0);
    const Point at{x_(6, 0), x_(6, 1), 0};
    EXPECT_TRUE(surface_->find(all, at, {0, -1, 0}, 1, x_, place));
    corner_ = place.corner;
    EXPECT_NEAR(place.gap, surface_->closest(place, at, x_).gap, 1e-12);
    const SideFilm dry;
    const double shape = 1;
    PointInStep point{law_, dry, all, 1, old_, x_, place_of(old_, 6), at, {0, -1, 0}, old_state_};
    point.area = area_;
    point.nodes = 1;
    point.shape = &shape;
    SideAction out, plain;
    out.tangent = true;
    for (SideAction* action : {&out, &plain}) action->open(2, surface_->num_dofs(place.piece), 0);
    const ContactPoint result = surface_->act(point, place, out);
    surface_->act(point, place, plain);
    for (double& v : f) v = 0;
    for (auto& row : k)
      for (double& v : row) v = 0;
    const auto number = [&](int dof) {
      return dof < 2 ? 12 + dof : 2 * surface_->piece(place.piece).node[dof / 2 - 1] + dof % 2;
    };
    for (int a = 0; a < out.dofs(); ++a) {
      EXPECT_EQ(out.f[a], plain.f[a]);
      EXPECT_EQ(out.later[a], plain.later[a]);
      f[number(a)] += out.f[a] + out.later[a] / (1 - law_.start_weight);
      for (int b = 0; b < out.dofs(); ++b) k[number(a)][number(b)] += out.k[a * out.dofs() + b];
    }
    return result;
  }
  Slope friction_;
  Coordinates x_, old_;
  std::vector<MasterSurface::MasterSide> sides_;
  std::unique_ptr<SmoothSurface> surface_;
  ContactPointLaw law_;
  PointHistory old_state_;
  static constexpr double area_ = 0.7;
  bool corner_ = false;
};

INSTANTIATE_TEST_SUITE_P(Contact, EveryState,
                         testing::Values(Case{"linear", Drawing::linear, 0.5, 0.12, 0, 0, false, false},
                                         Case{"linear_stick", Drawing::linear, 0.5, 0.12, 5, 0, false, false},
                                         Case{"linear_slip", Drawing::linear, 1.5, 0.1, 0.01, 0, false, false},
                                         Case{"convex_corner", Drawing::linear, 1.0, 0.21, 0, 3e4, false, true},
                                         Case{"convex_corner_slip", Drawing::linear, 0.9995, 0.21, 0.01, 3e4, false,
                                              true},
                                         Case{"reentrant_corner", Drawing::linear, -0.597, -0.07, 5, 0, false, true},
                                         Case{"hermite", Drawing::hermite, 0.5, 0.14, 0, 0, false, false},
                                         Case{"hermite_stick", Drawing::hermite, 0.5, 0.14, 5, 2e4, false, false},
                                         Case{"hermite_slip", Drawing::hermite, 1.4, 0.1, 0.01, 0, false, false},
                                         Case{"hermite_end", Drawing::hermite, 2.3, 0.02, 0.01, 0, false, false},
                                         Case{"hermite_late", Drawing::hermite, 0.3, 0.14, 0, 0, true, false},
                                         Case{"bezier", Drawing::bezier, 1.05, 0.12, 0, 0, false, false},
                                         Case{"bezier_stick", Drawing::bezier, 0.2, 0.1, 5, 2e4, false, false},
                                         Case{"bezier_slip", Drawing::bezier, -0.5, -0.04, 0.01, 0, false, false},
                                         Case{"bezier_late", Drawing::bezier, 2.3, 0.02, 0.01, 0, true, false},
                                         Case{"damped", Drawing::hermite, 0.5, 0.14, 5, 2e4, false, false, 0.5},
                                         Case{"damped_corner", Drawing::linear, 1.0, 0.21, 0, 3e4, false, true, 0.5},
                                         Case{"damped_late", Drawing::bezier, 2.3, 0.02, 0.01, 0, true, false, 2}),
                         [](const auto& info) { return std::string(info.param.name); });

TEST_P(EveryState, TangentIsTheDifferencedForce) {
  double f[14], k[14][14], plus[14], minus[14], unused[14][14];
  const ContactPoint at = evaluate(f, k);
  ASSERT_TRUE(at.active);
  ASSERT_EQ(corner_, GetParam().corner);
  ASSERT_EQ(at.shear.slides, GetParam().friction > 0 && GetParam().friction < 1);
  double size = 0, error = 0;
  for (int b = 0; b < 14; ++b) {
    constexpr double h = 1e-6;
    x_(b / 2, b % 2) += h;
    evaluate(plus, unused);
    x_(b / 2, b % 2) -= 2 * h;
    evaluate(minus, unused);
    x_(b / 2, b % 2) += h;
    for (int a = 0; a < 14; ++a) {
      size = std::max(size, std::abs(k[a][b]));
      error = std::max(error, std::abs((plus[a] - minus[a]) / (2 * h) - k[a][b]));
    }
  }
  EXPECT_LT(error, 1e-6 * size);
}

TEST_P(EveryState, ForcesAndMomentsCancel) {
  double f[14], k[14][14], sum[2] = {0, 0}, moment = 0, size = 0;
  const ContactPoint at = evaluate(f, k);
  for (int a = 0; a < 7; ++a) {
    for (int i = 0; i < 2; ++i) sum[i] += f[2 * a + i];
    moment += x_(a, 0) * f[2 * a + 1] - x_(a, 1) * f[2 * a];
    size += std::abs(f[2 * a]) + std::abs(f[2 * a + 1]);
  }
  EXPECT_LT(std::hypot(sum[0], sum[1]), 1e-14 * size);
  // friction acts across the gap
  const double share = law_.conserves ? end_share(0.01, at.gap, 0.0) / (1 - law_.start_weight) : 1.0;
  EXPECT_NEAR(moment, share * area_ * at.gap * at.shear.shear[0], 1e-13 * size + 1e-9 * std::abs(moment));
}

TEST_P(EveryState, RigidMotionOfAllIsNotSeen) {
  double f[14], k[14][14], turned[14];
  const ContactPoint at = evaluate(f, k);
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (Coordinates* x : {&x_, &old_})
    for (int a = 0; a < 7; ++a) {
      const double r[2] = {(*x)(a, 0), (*x)(a, 1)};
      (*x)(a, 0) = c * r[0] - s * r[1] + 3;
      (*x)(a, 1) = s * r[0] + c * r[1] - 2;
    }
  surface_->update(old_);
  const ContactPoint there = evaluate(turned, k);
  EXPECT_NEAR(there.gap, at.gap, 1e-12);
  EXPECT_NEAR(there.shear.shear[0], at.shear.shear[0], 1e-6 * (1 + std::abs(at.shear.shear[0])));
  for (int a = 0; a < 7; ++a) {
    EXPECT_NEAR(turned[2 * a], c * f[2 * a] - s * f[2 * a + 1], 1e-5);
    EXPECT_NEAR(turned[2 * a + 1], s * f[2 * a] + c * f[2 * a + 1], 1e-5);
  }
}

TEST(NodeSegment, OpenNodeHasNeitherForceNorStiffness) {
  const std::vector<MasterSurface::MasterSide> sides{{2, {0, 1}, CellShape::line2}};
  Coordinates x("x", 2, 2);
  x(0, 0) = 1;
  const SmoothSurface surface(sides, Drawing::linear, 1, 0.1, x);
  ContactPointLaw law;
  law.penalty = 1e6;
  TargetPlace place;
  const Point at{0.4, 0.01, 0};
  ASSERT_TRUE(surface.find({0}, at, {0, -1, 0}, 0.1, x, place));
  const SideFilm dry;
  const double shape = 1;
  const std::vector<int> all{0};
  PointInStep point{law, dry, all, 0.1, x, x, at, at, {0, -1, 0}};
  point.area = point.nodes = 1;
  point.shape = &shape;
  SideAction action;
  action.tangent = true;
  action.open(2, surface.num_dofs(0), 0);
  const ContactPoint result = surface.act(point, place, action);
  EXPECT_FALSE(result.active);
  EXPECT_NEAR(result.gap, 0.01, 1e-15);
  for (int a = 0; a < action.dofs(); ++a) {
    EXPECT_EQ(action.f[a], 0);
    for (int b = 0; b < action.dofs(); ++b) EXPECT_EQ(action.k[a * action.dofs() + b], 0);
  }
}

}  // namespace
}  // namespace mudline
