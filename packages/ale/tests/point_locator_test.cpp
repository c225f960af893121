#include "ale/point_locator.hpp"

#include <gtest/gtest.h>

#include "ale_mesh.hpp"

namespace mudline {
namespace {

using testing::box;

Point position(const GhostedMesh& mesh, const Positions& x, const MeshPlace& at) {
  const auto& element = mesh.elements()[at.element];
  double N[27], dN[81];
  evaluate_shape(element.shape, at.xi, N, dN);
  Point result{};
  for (int a = 0; a < num_nodes(element.shape); ++a)
    for (int i = 0; i < 3; ++i) result[i] += N[a] * x[element.nodes[a]][i];
  return result;
}

/// A box whose horizontal lines are bent to waves of this size and wave number.
class EveryCell : public ::testing::TestWithParam<CellShape> {
 protected:
  void bend(double size, double wave) {
    for (auto& p : x) p[1] += size * std::sin(wave * p[0]) * p[1];
  }
  std::unique_ptr<Mesh> mesh = box(GetParam(), 4);
  GhostedMesh whole{*mesh};
  Positions x = whole.gather(mesh->coordinates());
  PointLocator locator{whole, x};
};
INSTANTIATE_TEST_SUITE_P(PointLocator, EveryCell, ::testing::Values(CellShape::quad9, CellShape::tri6));

TEST_P(EveryCell, FindsThePointsOfACurvedMesh) {
  bend(0.1, 3);
  for (int k = 0; k < 50; ++k) {
    const Point at{0.01 + 0.98 * (k % 7) / 6.0, 0.01 + 0.95 * (k % 11) / 10.0};
    const auto there = position(whole, x, locator.find(at, k % static_cast<int>(whole.elements().size())));
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(there[i], at[i], 1e-12);
  }
}

TEST_P(EveryCell, NearestOnStraightBoundaryIsThatOfTheBox) {
  for (const Point at : {Point{0.37, 1.8}, {-0.4, 0.61}, {1.7, 1.2}, {0.52, -1e-3}, {1 + 1e-6, 0.25}, {-3, -4}}) {
    const auto there = position(whole, x, locator.nearest_on_boundary(at));
    for (int i = 0; i < 2; ++i)
      EXPECT_NEAR(there[i], std::min(std::max(at[i], 0.0), 1.0), 1e-13 * (1 + std::abs(at[i])))
          << at[0] << " " << at[1];
  }
}

TEST_P(EveryCell, NearestOnCurvedBoundaryBeatsEveryOtherPointOfIt) {
  bend(0.3, 3.1);
  for (const Point at : {Point{0.37, 1.8}, {0.1, 1.3}, {1.2, 1.4}, {0.5, 1.31}, {-0.2, 0.3}}) {
    const auto there = position(whole, x, locator.nearest_on_boundary(at));
    const double found = std::hypot(there[0] - at[0], there[1] - at[1]);
    double least = 1e300;
    for (int e = 0; e < static_cast<int>(whole.elements().size()); ++e)
      for (int s = 0; s < num_sides(GetParam()); ++s) {
        if (whole.elements()[e].neighbours[s] >= 0) continue;
        const auto nodes = side_nodes(GetParam(), s);
        for (int k = 0; k <= 1000; ++k) {
          const double t = -1 + 0.002 * k, N[3] = {0.5 * t * (t - 1), 0.5 * t * (t + 1), 1 - t * t};
          double off[2] = {at[0], at[1]};
          for (int a = 0; a < 3; ++a)
            for (int i = 0; i < 2; ++i) off[i] -= N[a] * x[whole.elements()[e].nodes[nodes[a]]][i];
          least = std::min(least, std::hypot(off[0], off[1]));
        }
      }
    EXPECT_LE(found, least + 1e-12);
    EXPECT_GE(found, least - 1e-6);
  }
}

}  // namespace
}  // namespace mudline
