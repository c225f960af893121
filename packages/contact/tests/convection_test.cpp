// Convection of the history of points that are moved along their side.
#include <gtest/gtest.h>

#include "contact/convection.hpp"

namespace mudline {
namespace {

using Coordinates = Kokkos::View<double**, Kokkos::LayoutRight>;

TEST(Convection, LinearHistoryOfASideStaysWhereItIs) {
  // a slanted side of three nodes; each moves along it by a different distance
  Coordinates from("from", 3, 2), to("to", 3, 2);
  const double s[3] = {0, 5, 2.5}, shift[3] = {0.4, -0.3, 0.1};
  for (int a = 0; a < 3; ++a)
    for (int i = 0; i < 2; ++i) {
      const double along[2] = {0.6, 0.8};
      from(a, i) = 1 + s[a] * along[i];
      to(a, i) = 1 + (s[a] + shift[a]) * along[i];
    }
  const auto field = [](double s) { return 7 - 2 * s; };
  PointView rows("rows", 5, 2);
  for (int row = 0; row < 5; ++row) rows(row, 0) = rows(row, 1) = 100;
  for (int a = 0; a < 3; ++a) rows(1 + a, 1) = field(s[a]);
  SurfaceSide side{0, 0, 0, CellShape::line3, 3, {0, 1, 2}, 0, 1};
  SideShifts(side, from, to).convect(rows, 1, 1);
  for (int a = 0; a < 3; ++a) EXPECT_NEAR(rows(1 + a, 1), field(s[a] + shift[a]), 1e-12);
  for (int row = 0; row < 5; ++row) EXPECT_EQ(rows(row, 0), 100);
  EXPECT_EQ(rows(0, 1), 100);
  EXPECT_EQ(rows(4, 1), 100);
}

TEST(Convection, WhatMovesAcrossTheSideChangesNothing) {
  Coordinates from("from", 2, 2), to("to", 2, 2);
  from(1, 0) = to(1, 0) = 3;
  to(0, 1) = to(1, 1) = 0.2;
  PointView rows("rows", 2, 1);
  rows(0, 0) = 1;
  rows(1, 0) = 4;
  SideShifts(SurfaceSide{0, 0, 0, CellShape::line2, 2, {0, 1}, 0, 1}, from, to).convect(rows, 0, 0);
  EXPECT_EQ(rows(0, 0), 1);
  EXPECT_EQ(rows(1, 0), 4);
}

TEST(Convection, LinearHistoryOfAFaceInSpaceStaysWhereItIs) {
  // a slanted face, whose nodes move along it by different distances
  for (const CellShape shape : {CellShape::tri3, CellShape::tri6, CellShape::quad4, CellShape::quad9}) {
    const auto place = [](double s, double t) { return Point{1 + 2 * s, 2 + s + 3 * t, 0.5 * s - t}; };
    const auto field = [](const Point& x) { return 7 - 2 * x[0] + 3 * x[1] + x[2]; };
    SideCoordinates before{}, after{};
    for (int a = 0; a < num_nodes(shape); ++a) {
      const auto xi = reference_node(shape, a);
      before[a] = place(xi[0], xi[1]);
      after[a] = place(xi[0] + 0.1 * xi[1] + 0.07, xi[1] - 0.05 * xi[0] * xi[1]);
    }
    for (const int degree : {2, 5}) {
      const ContactRule rule(ContactPoints::quadrature, shape, degree);
      std::vector<Point> from, to;
      PointView rows("rows", rule.points + 1, 2);
      for (int c = 0; c < rule.points; ++c) {
        from.push_back(rule.place(c, before));
        to.push_back(rule.place(c, after));
        rows(1 + c, 0) = 5;
        rows(1 + c, 1) = field(from[c]);
      }
      rows(0, 1) = 100;
      const SideShifts shifts(from, to, shape, before);
      shifts.convect(rows, 1, 0);
      shifts.convect(rows, 1, 1);
      for (int c = 0; c < rule.points; ++c) {
        EXPECT_NEAR(rows(1 + c, 0), 5, 1e-14);
        EXPECT_NEAR(rows(1 + c, 1), field(to[c]), 1e-12);
      }
      EXPECT_EQ(rows(0, 1), 100);
    }
  }
}

TEST(Convection, OnePointOfAFaceHasNoSlope) {
  const ContactRule rule(ContactPoints::quadrature, CellShape::tri3, 1);
  ASSERT_EQ(rule.points, 1);
  const SideCoordinates nodes{Point{0, 0, 0}, Point{1, 0, 0}, Point{0, 1, 0}};
  PointView rows("rows", 1, 1);
  rows(0, 0) = 3;
  SideShifts({Point{0.3, 0.3, 0}}, {Point{0.4, 0.2, 0}}, CellShape::tri3, nodes).convect(rows, 0, 0);
  EXPECT_EQ(rows(0, 0), 3);
}

}  // namespace
}  // namespace mudline
