#ifdef MUDLINE_HAVE_GMSH
#include "discretisation/triangulation.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

namespace mudline {
namespace {

using Places = std::vector<std::array<double, 2>>;

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
  // as many more as the areas of their triangles are smaller, where the long sides let them
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
  const Places square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const auto slow = [](double, double) {
    std::this_thread::sleep_for(std::chrono::seconds(5));
    return 0.3;
  };
  try {
    triangulate(square, {{{{0, 1, 2, 3}}}}, slow, 0.3);
    FAIL();
  } catch (const NoTriangulation& failure) {
    EXPECT_NE(std::string(failure.what()).find("had not finished after"), std::string::npos) << failure.what();
  }
}

}  // namespace
}  // namespace mudline
#endif
