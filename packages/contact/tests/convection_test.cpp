// A history that points carry when they are moved along their side.
#include <gtest/gtest.h>

#include "contact/convection.hpp"

namespace mudline {
namespace {

using Coordinates = Kokkos::View<double**, Kokkos::LayoutRight>;

TEST(Convection, LinearHistoryOfASideStaysWhereItIs) {
  // a slanted side of three nodes; each moves along it by another way
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
  SideShifts({0, 0, 0, CellShape::line2, 2, {0, 1}, 0, 1}, from, to).convect(rows, 0, 0);
  EXPECT_EQ(rows(0, 0), 1);
  EXPECT_EQ(rows(1, 0), 4);
}

}  // namespace
}  // namespace mudline
