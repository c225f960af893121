#include <gtest/gtest.h>

#include "ale/interior_motion.hpp"
#include "ale/mesh_paths.hpp"
#include "ale/path_curve.hpp"
#include "ale/quality.hpp"
#include "ale/vertex_colours.hpp"
#include "ale_mesh.hpp"

namespace mudline {
namespace {

using testing::box;

TEST(PathCurve, StaysOnALineAndNearACircle) {
  const PathCurve line({{0, 0, 0}, {1, 2, 3}, {1.5, 3, 4.5}, {4, 8, 12}});
  for (double s : {0.3, 2.0, 2.9, 7.0}) {
    const auto x = line.at(s);
    EXPECT_NEAR(x[1], 2 * x[0], 1e-14);
    EXPECT_NEAR(x[2], 3 * x[0], 1e-14);
  }
  double error[2];
  for (int level = 0; level < 2; ++level) {
    Positions points;
    const int n = 8 << level;
    for (int i = 0; i <= n; ++i) points.push_back({std::cos(1.5 * i / n), std::sin(1.5 * i / n), 0});
    const PathCurve circle(points);
    error[level] = 0;
    for (int i = 0; i <= 500; ++i) {
      const auto x = circle.at(circle.length() * i / 500);
      error[level] = std::max(error[level], std::abs(std::hypot(x[0], x[1]) - 1));
    }
  }
  EXPECT_LT(error[0], 1e-3);
  EXPECT_GT(std::log2(error[0] / error[1]), 2.7);
}

TEST(CurveMeasure, PlaceInvertsAt) {
  Positions points;
  for (int i = 0; i <= 40; ++i) points.push_back({0.125 * i, 1e-3 * std::sin(i), 0});
  const PathCurve curve(points);
  const CurveMeasure measure(curve, [](const Point& x) { return 0.1 + 0.4 * x[0]; });
  for (double s : {0.0, 0.4, 1.7, 3.3, curve.length()}) EXPECT_NEAR(measure.place(measure.at(s)), s, 1e-13);
  // sides of the wanted size: int ds / size over [0, 5], nearly straight
  EXPECT_NEAR(measure.total(), std::log(2.1 / 0.1) / 0.4, 0.01);
}

TEST(MeshPaths, ABodyUnderTheBoundaryMakesNoCorner) {
  const auto mesh = box(CellShape::tri6, 4);
  const GhostedMesh whole(*mesh);
  Positions x = whole.gather(mesh->coordinates());
  double top = -1e300;
  for (const auto& place : x) top = std::max(top, place[1]);
  std::vector<bool> on_body(x.size(), false);
  int middle = -1;
  for (std::size_t node = 0; node < x.size(); ++node) {
    if (std::abs(x[node][1] - top) > 1e-12) continue;
    on_body[node] = true;
    if (whole.is_vertex(static_cast<int>(node)) &&
        (middle < 0 || std::abs(x[node][0] - 0.5) < std::abs(x[middle][0] - 0.5)))
      middle = static_cast<int>(node);
  }
  x[middle][1] -= 0.2;  // turns by 77 degrees there
  EXPECT_GT(find_paths(whole, x, {}, 0.5).size(), 4u);
  EXPECT_EQ(find_paths(whole, x, {}, 0.5, [&](int node) { return on_body[node]; }).size(),
            4u);  // the ends of the top stay corners: the walls are not on the body
}

TEST(MeshPaths, ABoxHasFourSidesAndClosedByCorners) {
  const auto mesh = box(CellShape::tri6, 4);
  const GhostedMesh whole(*mesh);
  const Positions x = whole.gather(mesh->coordinates());
  const auto paths = find_paths(whole, x, {}, 0.5);
  ASSERT_EQ(paths.size(), 4u);
  int named = 0;
  for (const MeshPath& path : paths) {
    EXPECT_EQ(path.num_vertices(), 5);
    EXPECT_EQ(path.nodes.size(), 9u);
    named += static_cast<int>(path.sets.size());
    for (std::size_t i = 1; i + 1 < path.nodes.size(); i += 2)  // middle nodes between their ends
      for (int d = 0; d < 2; ++d)
        EXPECT_NEAR(x[path.nodes[i]][d], 0.5 * (x[path.nodes[i - 1]][d] + x[path.nodes[i + 1]][d]), 1e-15);
  }
  EXPECT_EQ(named, 2);
}

TEST(Quality, IsOneForTheIdealShapes) {
  const auto squares = box(CellShape::quad9, 3, 0.0);
  const GhostedMesh whole(*squares);
  EXPECT_NEAR(lowest_quality(whole, whole.gather(squares->coordinates())), 1.0, 1e-14);
  const auto halves = box(CellShape::tri6, 3, 0.0);
  const GhostedMesh triangles(*halves);
  // at the sharp corners of a halved square: sin 45 deg / sin 60 deg
  EXPECT_NEAR(lowest_quality(triangles, triangles.gather(halves->coordinates())), std::sqrt(0.5) / std::sqrt(0.75),
              1e-14);
}

/// The box with its top pushed in by a quarter: interior left behind.
struct PushedBox {
  explicit PushedBox(CellShape shape)
      : mesh(box(shape, 8)),
        whole(*mesh),
        source(whole.gather(mesh->coordinates())),
        paths(find_paths(whole, source, {}, 0.5)),
        corners(whole) {
    corners.add_tangents(source, source);
    movable.assign(whole.num_nodes(), 0);
    for (int node = 0; node < whole.num_nodes(); ++node) movable[node] = whole.is_vertex(node);
    for (const MeshPath& path : paths)
      for (int node : path.nodes) movable[node] = 0;
    colours = vertex_colours(whole, movable);
    pushed = source;
    for (const MeshPath& path : paths)
      for (int node : path.nodes)  // no more than the first row of elements survives
        pushed[node][1] *= 1 - 0.09 * std::pow(std::sin(std::acos(-1.0) * source[node][0]), 2) * source[node][1];
    corners.add_tangents(pushed, pushed);
  }
  double worst(const Positions& x) const {
    double lowest = 1e300;
    for (const Simplex& t : corners.simplices) lowest = std::min(lowest, determinant(t, x));
    return lowest;
  }
  std::unique_ptr<Mesh> mesh;
  GhostedMesh whole;
  Positions source, pushed;
  std::vector<MeshPath> paths;
  CornerSimplices corners;
  InteriorMesh interior() const { return {whole, corners, source, source, movable, colours}; }
  std::vector<char> movable;
  std::vector<std::vector<int>> colours;
};

TEST(InteriorMotion, UnfoldedAndBetterAfterThePush) {
  for (CellShape shape : {CellShape::tri6, CellShape::quad9}) {
    const PushedBox box(shape);
    ASSERT_GT(box.worst(box.pushed), 0);
    for (int type = 0; type < 2; ++type) {
      std::unique_ptr<InteriorMotion> motion;
      if (type == 0) motion = std::make_unique<OptimisationMotion>();
      if (type == 1) motion = std::make_unique<ElasticMotion>();
      Positions x = box.pushed;
      motion->move(box.interior(), x);
      EXPECT_GT(box.worst(x), 2 * box.worst(box.pushed)) << type;
      for (int node = 0; node < box.whole.num_nodes(); ++node)
        if (!box.movable[node]) {
          EXPECT_EQ(x[node], box.pushed[node]);
        }
    }
  }
}

TEST(InteriorMotion, AMeshAtRestStays) {
  const PushedBox box(CellShape::tri6);
  Positions x = box.source;
  OptimisationMotion().move(box.interior(), x);
  for (int node = 0; node < box.whole.num_nodes(); ++node) EXPECT_EQ(x[node], box.source[node]);
  ElasticMotion().move(box.interior(), x);
  for (int node = 0; node < box.whole.num_nodes(); ++node) EXPECT_EQ(x[node], box.source[node]);
}

}  // namespace
}  // namespace mudline
