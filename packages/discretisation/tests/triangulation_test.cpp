#ifdef MUDLINE_HAVE_GMSH
#include "discretisation/triangulation.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <thread>

#include "core/child_process.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

using Places = std::vector<Vec<double, 2>>;

double area(const Triangulation& mesh, int region) {
  double sum = 0;
  for (const auto& t : mesh.triangles[region]) {
    const auto &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
    const double part = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
    EXPECT_GT(part, 0);
    sum += part;
  }
  return sum;
}

TEST(Triangulation, KeepsTheGivenSidesAndAskedSizes) {
  // a square of 2 m with a square hole of 1 m, and a second region in the hole
  const Places corners{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {0.5, 0.5}, {1.5, 0.5}, {1.5, 1.5}, {0.5, 1.5}};
  const std::vector<OutlinedRegion> regions{{{{0, 1, 2, 3}, {4, 7, 6, 5}}}, {{{4, 5, 6, 7}}}};
  const auto size = [](double x, double) { return x < 1 ? 0.2 : 0.1; };
  const Triangulation mesh = triangulate(corners, regions, size, 60);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_NEAR(area(mesh, 0), 3, 1e-12);
  EXPECT_NEAR(area(mesh, 1), 1, 1e-12);
  for (std::size_t v = 0; v < corners.size(); ++v) EXPECT_EQ(mesh.points[v], corners[v]);
  int left = 0, right = 0;
  for (std::size_t v = corners.size(); v < mesh.points.size(); ++v) {
    const auto& x = mesh.points[v];
    EXPECT_GT(std::min({x[0], x[1], 2 - x[0], 2 - x[1]}), 0);  // none on the outer sides
    (x[0] < 1 ? left : right) += 1;
  }
  // the number grows as the triangles' area shrinks, as far as the long sides permit
  EXPECT_GT(right, 2 * left);
  const Triangulation again = triangulate(corners, regions, size, 60);
  EXPECT_EQ(again.points, mesh.points);
  EXPECT_EQ(again.triangles, mesh.triangles);
}

TEST(Triangulation, SaysWhatCannotBeMeshed) {
  const Places bow{{0, 0}, {1, 1}, {1, 0}, {0, 1}};
  EXPECT_THROW(triangulate(
                   bow, {{{{0, 1, 2, 3}}}}, [](double, double) { return 0.3; }, 20),
               NoTriangulation);
  Places circle;
  std::vector<int> around;
  for (std::size_t k = 0; k <= most_sides; ++k) {
    const double angle = 6.283185307179586 * static_cast<double>(k) / (most_sides + 1);
    circle.push_back({std::cos(angle), std::sin(angle)});
    around.push_back(static_cast<int>(k));
  }
  try {
    triangulate(
        circle, {{{around}}}, [](double, double) { return 0.3; }, 20);
    FAIL();
  } catch (const NoTriangulation& failure) {
    EXPECT_EQ(std::string(failure.what()),
              "its boundary would have 20001 sides, more than 20000: are all sizes in m, or with the right unit?");
  }
  const Places square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto slow = [](double, double) {
    std::this_thread::sleep_for(std::chrono::seconds(5));
    return 0.3;
  };
  try {
    triangulate(square, {{{{0, 1, 2, 3}}}}, slow, 0.3);
    FAIL();
  } catch (const ChildLost& failure) {  // this says nothing about the region
    EXPECT_TRUE(failure.timed_out);
    EXPECT_NE(std::string(failure.what()).find("had not finished after"), std::string::npos) << failure.what();
  }
}

/// Triangles, two for each of n by n squares, on each face of a box with corners `low` and `high`, counter-clockwise as
/// seen from outside. Adds their vertices.
std::vector<std::array<int, 3>> box_faces(double low, double high, int n, std::vector<Point>& vertices) {
  std::map<std::array<int, 3>, int> numbers;
  const auto vertex = [&](int axis, int side, int i, int j) {
    std::array<int, 3> at{};
    at[axis] = side * n;
    at[(axis + 1) % 3] = i;
    at[(axis + 2) % 3] = j;
    const auto [number, added] = numbers.emplace(at, static_cast<int>(vertices.size()));
    if (added)
      vertices.push_back(
          {low + (high - low) * at[0] / n, low + (high - low) * at[1] / n, low + (high - low) * at[2] / n});
    return number->second;
  };
  std::vector<std::array<int, 3>> result;
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const int a = vertex(axis, side, i, j), c = vertex(axis, side, i + 1, j + 1);
          int b = vertex(axis, side, i + 1, j), d = vertex(axis, side, i, j + 1);
          if (side == 0) std::swap(b, d);
          result.push_back({a, b, c});
          result.push_back({a, c, d});
        }
  return result;
}

double volume(const Tetrahedra& mesh, int region) {
  double sum = 0;
  for (const auto& t : mesh.tetrahedra[region]) {
    const Point &a = mesh.points[t[0]], b = mesh.points[t[1]] - a, c = mesh.points[t[2]] - a, d = mesh.points[t[3]] - a;
    const double part = dot(b, cross(c, d)) / 6;
    EXPECT_GT(part, 0);
    sum += part;
  }
  return sum;
}

TEST(Tetrahedra, KeepTheGivenFacesAndAskedSizes) {
  // a cube of 2 m with a cube of 1 m in its middle: a hole, and a second region in it
  std::vector<Point> vertices;
  std::vector<EnclosedRegion> regions(2);
  regions[0].faces = box_faces(0, 2, 8, vertices);
  regions[1].faces = box_faces(0.5, 1.5, 4, vertices);
  for (const auto& face : regions[1].faces) regions[0].faces.push_back({face[0], face[2], face[1]});
  const auto size = [](const Point& x) { return x[0] < 1 ? 0.5 : 0.15; };
  const Tetrahedra mesh = tetrahedra_in(vertices, regions, size, 60);
  ASSERT_EQ(mesh.tetrahedra.size(), 2u);
  EXPECT_NEAR(volume(mesh, 0), 7, 1e-12);
  EXPECT_NEAR(volume(mesh, 1), 1, 1e-12);
  int left = 0, right = 0;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Point& x = mesh.points[v];
    if (v < vertices.size()) {
      EXPECT_EQ(x, vertices[v]);
      continue;
    }
    for (double coordinate : x) {
      EXPECT_GT(coordinate, 1e-9);  // none on the outer faces
      EXPECT_LT(coordinate, 2 - 1e-9);
    }
    (x[0] < 1 ? left : right) += 1;
  }
  EXPECT_GT(right, left);  // the faces are the same on both sides
  const Tetrahedra again = tetrahedra_in(vertices, regions, size, 60);
  EXPECT_EQ(again.points, mesh.points);
  EXPECT_EQ(again.tetrahedra, mesh.tetrahedra);
}

TEST(Tetrahedra, SayWhatCannotBeFilled) {
  std::vector<Point> vertices;
  EnclosedRegion region{box_faces(0, 1, 1, vertices)};
  vertices.back() = {-0.5, 0.4, 0.3};  // a corner through the face across
  EXPECT_THROW(tetrahedra_in(
                   vertices, {region}, [](const Point&) { return 0.3; }, 20),
               NoTriangulation);
}

}  // namespace
}  // namespace mudline
#endif
