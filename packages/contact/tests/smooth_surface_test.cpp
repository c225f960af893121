// A surface drawn over its nodes: pieces, corners, closest points.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/nodes/smooth_surface.hpp"

namespace mudline {
namespace {

using Coordinates = Kokkos::View<double**, Kokkos::LayoutRight>;
constexpr double pi = 3.14159265358979323846;

/// Nodes of an arc of radius 1 about the origin, from the angle `from` in steps of `angle`, counter-clockwise: the body
/// is inside.
struct Arc {
  Arc(int count, double from, double angle, bool closed, bool uneven = false) : x("x", count, 2) {
    for (int i = 0; i < count; ++i) {
      const double a = from + angle * (i + (uneven && i % 2 == 1 ? 0.3 : 0.0));
      x(i, 0) = std::cos(a);
      x(i, 1) = std::sin(a);
    }
    for (int i = 0; i + 1 < count; ++i) sides.push_back({2, {i, i + 1, -1}});
    if (closed) sides.push_back({2, {count - 1, 0, -1}});
  }
  Coordinates x;
  std::vector<MasterSurface::MasterSide> sides;
};

/// Largest radial error and largest jump of the unit tangent between pieces of a drawing of an arc.
std::pair<double, double> errors(const Arc& arc, Drawing drawing) {
  const SmoothSurface surface(arc.sides, drawing, 1.0, 0.1, arc.x);
  double radial = 0, jump = 0;
  for (int k = 0; k < surface.pieces(); ++k) {
    const SurfacePiece& piece = surface.piece(k);
    const PieceCoordinates nodes = surface.coordinates(k, arc.x);
    for (int i = 0; i <= 10; ++i) {
      const PlanePoint y = piece_point(piece, nodes, i / 10.0);
      radial = std::max(radial, std::abs(std::hypot(y[0], y[1]) - 1));
    }
    if (piece.after < 0) continue;
    const SurfacePiece& next = surface.piece(piece.after);
    const PlanePoint a = piece_direction(piece, nodes, 1),
                     b = piece_direction(next, surface.coordinates(piece.after, arc.x), 0);
    jump = std::max(jump, std::abs(a[0] * b[1] - a[1] * b[0]));
    const PlanePoint end = piece_point(piece, nodes, 1),
                     start = piece_point(next, surface.coordinates(piece.after, arc.x), 0);
    EXPECT_NEAR(end[0], start[0], 1e-14);
    EXPECT_NEAR(end[1], start[1], 1e-14);
  }
  return {radial, jump};
}

TEST(SmoothSurface, SmoothDrawingsHaveNoKinks) {
  const double h = pi / 12;
  for (bool closed : {false, true}) {
    const Arc arc(closed ? 24 : 13, 0, h, closed);
    const auto linear = errors(arc, Drawing::linear), hermite = errors(arc, Drawing::hermite),
               bezier = errors(arc, Drawing::bezier);
    EXPECT_NEAR(linear.first, 1 - std::cos(h / 2), 1e-12);
    EXPECT_NEAR(linear.second, std::sin(h), 1e-12);
    // tangents of chords are shorter than those of the arc by cos(h / 2)
    const double s2 = std::sin(h / 2) * std::sin(h / 2);
    const double round = 1 - std::cos(h / 2) * (1 + 0.5 * s2);
    EXPECT_NEAR(hermite.first, round, closed ? 1e-12 : 3e-4) << "at open ends the tangent is the parabola's";
    EXPECT_LT(hermite.second, 1e-13);
    EXPECT_NEAR(bezier.first, 1 - std::cos(h / 2), 1e-12) << "the middles between nodes";
    EXPECT_LT(bezier.second, 1e-13);
  }
  EXPECT_LT(errors(Arc(24, 0, h, true, true), Drawing::hermite).second, 1e-13) << "uneven spacing";
}

TEST(SmoothSurface, CornersStay) {
  // a square of three nodes per edge: smoothed along its edges, not over its corners
  Arc square(8, 0, pi / 4, true);
  const double places[8][2] = {{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}};
  for (int i = 0; i < 8; ++i)
    for (int k = 0; k < 2; ++k) square.x(i, k) = places[i][k];
  for (Drawing drawing : {Drawing::linear, Drawing::hermite, Drawing::bezier}) {
    const SmoothSurface surface(square.sides, drawing, pi / 4, 0.1, square.x);
    const auto gap = [&](double x, double y, const Point& outward) {
      TargetPlace place;
      const Point at{x, y, 0};
      if (!surface.find(surface.near({at, at}, 1), at, outward, 0.5, square.x, place)) return std::pair{1e300, false};
      EXPECT_NEAR(surface.closest(place, at, square.x).gap, place.gap, 1e-13);
      return std::pair{place.gap, place.corner};
    };
    EXPECT_NEAR(gap(0.3, 1.1, {0, -1}).first, 0.1, 1e-13);
    EXPECT_NEAR(gap(0.97, 0.9, {-1, 0}).first, -0.03, 1e-13);
    const auto [corner, is_corner] = gap(1.03, 1.04, {-1, -1});
    EXPECT_NEAR(corner, 0.05, 1e-13);
    EXPECT_TRUE(is_corner);
    EXPECT_EQ(gap(0.3, 1.1, {0, 1}).first, 1e300) << "back to back";
  }
}

TEST(SmoothSurface, OpenEndsOverhangAndThenEnd) {
  Arc line(3, 0, 1, false);
  for (int i = 0; i < 3; ++i) {
    line.x(i, 0) = -i;
    line.x(i, 1) = 0;
  }
  const SmoothSurface surface(line.sides, Drawing::hermite, 1, 0.1, line.x);
  TargetPlace place;
  EXPECT_TRUE(surface.find({0, 1}, {0.05, 0.1}, {0, -1}, 0.5, line.x, place));
  EXPECT_FALSE(surface.find({0, 1}, {0.15, 0.1}, {0, -1}, 0.5, line.x, place));
  EXPECT_FALSE(surface.find({0, 1}, {-1, 0.6}, {0, -1}, 0.5, line.x, place)) << "farther than it looks";
}

TEST(SmoothSurface, SidesAreTheElementsParabolas) {
  Arc arc(3, 0, 0.4, false);
  const std::vector<MasterSurface::MasterSide> side{{3, {0, 2, 1}}};
  const SmoothSurface surface(side, Drawing::sides, 1, 0.1, arc.x);
  ASSERT_EQ(surface.pieces(), 1);
  for (double eta : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    const PlanePoint y = piece_point(surface.piece(0), surface.coordinates(0, arc.x), eta);
    double N[3], dN[3];
    evaluate_line(3, 2 * eta - 1, N, dN);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(y[i], N[0] * arc.x(0, i) + N[1] * arc.x(2, i) + N[2] * arc.x(1, i), 1e-14);
  }
}

TEST(SmoothSurface, QuadraticSidesGiveTheirMiddleNodes) {
  const std::vector<MasterSurface::MasterSide> sides{{3, {5, 7, 6}}, {3, {3, 5, 4}}};
  const auto chains = node_chains(sides);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].nodes, (std::vector<int>{3, 4, 5, 6, 7}));
  EXPECT_FALSE(chains[0].closed);
}

}  // namespace
}  // namespace mudline
