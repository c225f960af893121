// Rows of arrays on the sides of a set, and where they go when the sides are moved past the soil.
#include "framework/surface_points.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "discretisation/tests/mesh_fixture.hpp"

namespace mudline {
namespace {

using At = SurfacePoints::At;

const std::vector<StateVariable> variables{{"linear", 1, "m"},
                                           {"total", 1, "J", Transfer::total},
                                           {"flag", 1, "-", Transfer::nearest},
                                           {"low", 1, "-", Transfer::value, 0.0},
                                           {"constant", 1, "-"}};

struct Top {
  std::unique_ptr<Mesh> mesh;
  CoordinateView x_old, x;
  explicit Top(const std::string& entries) : mesh(mesh_test::make(entries)) {
    x_old = CoordinateView("old", mesh->num_nodes(), mesh->dimension());
    x = CoordinateView("new", mesh->num_nodes(), mesh->dimension());
    Kokkos::deep_copy(x_old, mesh->coordinates());
    Kokkos::deep_copy(x, mesh->coordinates());
  }
};

double field(const Point& p) { return 7 - 2 * p[0] + 3 * p[1] + p[2]; }

TEST(SurfacePoints, LinearHistoryOfMovedSidesStaysWhereItIs) {
  for (const std::string& entries :
       {mesh_test::box("quad9", 3, 2), mesh_test::box("tri6", 3, 2), mesh_test::box("quad4", 3, 2),
        mesh_test::box3("hex27", 2, 2, 1), mesh_test::box3("tet10", 2, 2, 1), mesh_test::box3("hex8", 2, 2, 1),
        mesh_test::box3("tet4", 2, 2, 1), mesh_test::box3("wedge15", 2, 1, 2)})
    for (const auto& [at, degree] : {std::pair{At::gauss, 2}, {At::gauss, 5}, {At::nodes, 3}, {At::corners, 3}}) {
      Top top(entries);
      const int last = top.mesh->dimension() - 1;
      for (int node = 0; node < top.mesh->num_nodes(); ++node) {
        top.x(node, 0) += 0.05 * top.x_old(node, 0) * (1 - 0.4 * top.x_old(node, 0)) + 0.01;
        if (last == 2) top.x(node, 1) -= 0.03 * top.x_old(node, 0);
      }
      const SurfacePoints points(*top.mesh, "top", at, degree);
      const std::vector<Point> before = points.places(top.x_old), after = points.places(top.x);
      PointView rows("rows", points.count(), 5);
      for (int row = 0; row < points.count(); ++row) {
        rows(row, 0) = field(before[row]);
        rows(row, 1) = rows(row, 2) = row;
        rows(row, 3) = before[row][0] - 0.2;
        rows(row, 4) = 5;
      }
      points.follow(variables, top.x_old, top.x, rows);
      for (int row = 0; row < points.count(); ++row) {
        EXPECT_NEAR(rows(row, 0), field(after[row]), 1e-12) << entries;
        EXPECT_EQ(rows(row, 1), row);
        EXPECT_EQ(rows(row, 2), std::round(rows(row, 2)));
        EXPECT_NEAR(rows(row, 3), std::max(0.0, after[row][0] - 0.2), 1e-12);
        EXPECT_NEAR(rows(row, 4), 5, 1e-14);
      }
    }
}

TEST(SurfacePoints, ANearestRowIsLookedForOnItsSide) {
  Top top(mesh_test::box("quad4", 1, 1));
  for (int node = 0; node < top.mesh->num_nodes(); ++node) top.x(node, 0) += 1.5;
  const SurfacePoints points(*top.mesh, "top", At::corners, 2);
  const std::vector<Point> at = points.places(top.x_old);
  PointView rows("rows", 2, 5);
  for (int row = 0; row < 2; ++row) rows(row, 2) = at[row][0] > 1 ? 5 : 3;
  points.follow(variables, top.x_old, top.x, rows);
  for (int row = 0; row < 2; ++row) EXPECT_EQ(rows(row, 2), 5);
}

TEST(SurfacePoints, AreasAddUpToTheSurface) {
  for (const At at : {At::gauss, At::nodes, At::corners, At::centre}) {
    Top plane(mesh_test::box("quad9", 3, 2)), space(mesh_test::box3("hex27", 2, 2, 1));
    const auto sum = [&](const Top& top) {
      const std::vector<double> areas = SurfacePoints(*top.mesh, "top", at, 3).areas(top.x);
      return std::accumulate(areas.begin(), areas.end(), 0.0);
    };
    EXPECT_NEAR(sum(plane), 2, 1e-12);
    EXPECT_NEAR(sum(space), 2, 1e-12);
  }
}

TEST(SurfacePoints, WhatMovesAcrossTheSideChangesNothing) {
  Top top(mesh_test::box("quad4", 1, 1));
  for (int node = 0; node < top.mesh->num_nodes(); ++node) top.x(node, 1) += 0.2;
  const SurfacePoints points(*top.mesh, "top", At::nodes, 2);
  PointView rows("rows", 2, 5);
  for (int row = 0; row < 2; ++row) rows(row, 0) = 1 + 3 * row;
  points.follow(variables, top.x_old, top.x, rows);
  for (int row = 0; row < 2; ++row) EXPECT_EQ(rows(row, 0), 1 + 3 * row);
}

TEST(SurfacePoints, OneGaussPointOfAFaceHasNoSlope) {
  Top top(mesh_test::box3("tet4", 1, 1, 1));
  for (int node = 0; node < top.mesh->num_nodes(); ++node) {
    top.x(node, 0) += 0.1;
    top.x(node, 1) -= 0.1;
  }
  const SurfacePoints points(*top.mesh, "top", At::gauss, 1);
  ASSERT_EQ(points.count(), 2);
  PointView rows("rows", 2, 5);
  for (int row = 0; row < 2; ++row) rows(row, 0) = 3 * row;
  points.follow(variables, top.x_old, top.x, rows);
  for (int row = 0; row < 2; ++row) EXPECT_EQ(rows(row, 0), 3 * row);
}

TEST(SurfacePoints, OneRowOfASideHasNoSlope) {
  Top top(mesh_test::box("quad9", 3, 2));
  for (int node = 0; node < top.mesh->num_nodes(); ++node) top.x(node, 0) += 0.02;
  const SurfacePoints points(*top.mesh, "top", At::centre, 2);
  ASSERT_EQ(points.count(), 3);
  PointView rows("rows", 3, 5);
  for (int row = 0; row < 3; ++row) rows(row, 0) = 10 * row;
  points.follow(variables, top.x_old, top.x, rows);
  for (int row = 0; row < 3; ++row) EXPECT_EQ(rows(row, 0), 10 * row);
}

TEST(SurfacePoints, MeansAtNodesAreThoseOfTheNearestRows) {
  Top top(mesh_test::box("quad9", 2, 1));
  const SurfacePoints points(*top.mesh, "top", At::nodes, 3);
  const std::vector<Point> at = points.places(top.x);
  PointView rows("rows", points.count(), 1);
  for (int row = 0; row < points.count(); ++row) rows(row, 0) = field(at[row]);
  std::vector<double> sums(top.mesh->num_nodes(), 0.0), counts(sums);
  points.add_at_nodes(rows, 0, sums, counts);
  for (int node : top.mesh->nodes_of_set("top"))
    EXPECT_NEAR(sums[node] / counts[node], field(top.mesh->place(node)), 1e-12);
}

}  // namespace
}  // namespace mudline
