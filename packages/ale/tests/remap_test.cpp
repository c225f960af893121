#include <gtest/gtest.h>

#include "ale/nodal_remap.hpp"
#include "ale/remap.hpp"
#include "ale_mesh.hpp"

namespace mudline {
namespace {

using testing::box;
using testing::points_of;

/// Inner nodes moved by a smooth field that vanishes on the boundary; `size` in box widths.
Positions swirled(const Positions& x, double size, double phase) {
  const double pi = std::acos(-1.0);
  Positions result = x;
  for (auto& p : result) {
    const double bubble = std::sin(pi * p[0]) * std::sin(pi * p[1]);
    const double a = p[0], b = p[1];
    p[0] += size * bubble * std::cos(phase + 2 * b);
    p[1] += size * bubble * std::sin(phase + 3 * a);
  }
  return result;
}

using Field = double (*)(double, double);
double linear(double x, double y) { return 3 - 2 * x + 5 * y; }
double smooth(double x, double y) { return std::sin(2 * x + 1) * std::cos(3 * y); }

struct Points {
  explicit Points(const Mesh& mesh) : whole(mesh), block(points_of(mesh)), start(whole.gather(mesh.coordinates())) {}
  std::vector<double> values(Field field, const Positions& x) const {
    std::vector<double> result;
    for (int e : whole.block_elements(0))
      for (int q = 0; q < block.points; ++q) {
        const auto p = Recovery::position(whole.elements()[e], block, q, x);
        result.push_back(field(p[0], p[1]));
      }
    return result;
  }
  std::vector<double> carried(const std::vector<double>& old, const Positions& from, const Positions& to) const {
    std::vector<double> now = old;
    remap.transfer({whole, block, from, to, variables, 1, old, now});
    return now;
  }
  WholeMesh whole;
  SoilBlock block;
  Positions start;
  ConvectionRemap remap;
  std::vector<StateVariable> variables{{"f", 1, "-"}};
};

double worst(const std::vector<double>& a, const std::vector<double>& b) {
  double result = 0;
  for (std::size_t i = 0; i < a.size(); ++i) result = std::max(result, std::abs(a[i] - b[i]));
  return result;
}

TEST(ConvectionRemap, LinearFieldsSurviveArbitraryMotion) {
  for (CellShape shape : {CellShape::tri6, CellShape::quad9}) {
    const auto mesh = box(shape, 6);
    const Points points(*mesh);
    // curved elements too: every node moves by itself
    const Positions from = swirled(points.start, 0.05, 0.3), to = swirled(points.start, 0.07, 2.0);
    EXPECT_GT(worst(points.values(linear, from), points.values(linear, to)), 0.1);
    EXPECT_LT(worst(points.carried(points.values(linear, from), from, to), points.values(linear, to)), 1e-12);
  }
}

TEST(ConvectionRemap, PointsAtRestKeepTheirValuesToTheLastBit) {
  const auto mesh = box(CellShape::tri6, 6);
  const Points points(*mesh);
  Positions to = points.start;
  const int moved = points.whole.elements()[30].nodes[0];
  to[moved][0] += 0.02;
  const auto old = points.values(smooth, points.start), now = points.carried(old, points.start, to);
  int changed = 0;
  for (int e : points.whole.block_elements(0)) {
    const auto& nodes = points.whole.elements()[e].nodes;
    const bool touches = std::count(nodes.begin(), nodes.begin() + 6, moved) > 0;
    for (int q = 0; q < points.block.points; ++q) {
      const int row = points.whole.first_row(e, points.block.points) + q;
      changed += now[row] != old[row];
      if (!touches) {
        EXPECT_EQ(now[row], old[row]);
      }
    }
  }
  EXPECT_GT(changed, 0);
}

TEST(ConvectionRemap, BoundsHoldAndAStepMakesNoNewExtremum) {
  const auto mesh = box(CellShape::tri6, 8);
  Points points(*mesh);
  points.variables = {{"f", 1, "-", RemapRule::value, 0.5, 10.0}};
  std::vector<double> field = points.values([](double x, double y) { return x + 0.2 * y > 0.55 ? 1.0 : 0.0; }, points.start);
  for (double& value : field) value = std::max(value, 0.5);
  Positions from = points.start;
  for (int step = 0; step < 20; ++step) {
    const Positions to = swirled(points.start, 0.05, 0.2 * step);
    field = points.carried(field, from, to);
    from = to;
  }
  for (double value : field) {
    EXPECT_GE(value, 0.5);
    EXPECT_LE(value, 1.35);  // recovered values at nodes overshoot a jump by less than its half
  }
}

/// There and back again in steps that move by a fixed share of an element: what the convection of a field costs.
double journey(ConvectionRemap remap, Field field, int n) {
  const auto mesh = box(CellShape::tri6, n);
  Points points(*mesh);
  points.remap = remap;
  std::vector<double> values = points.values(field, points.start);
  const std::vector<double> exact = values;
  Positions from = points.start;
  const int steps = 4 * n;
  for (int k = 1; k <= steps; ++k) {
    const Positions to = swirled(points.start, 0.1 * std::sin(std::acos(-1.0) * k / steps), 0.5);
    values = points.carried(values, from, k == steps ? points.start : to);
    from = to;
  }
  double sum = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) sum += std::pow(values[i] - exact[i], 2) / exact.size();
  return std::sqrt(sum);
}

TEST(ConvectionRemap, IsOfSecondOrderForSmoothFields) {
  for (const ConvectionRemap& remap : {ConvectionRemap(ConvectionRemap::Scheme::incremental, true),
                                       ConvectionRemap(ConvectionRemap::Scheme::upwind, true)}) {
    const double coarse = journey(remap, smooth, 8), medium = journey(remap, smooth, 16), fine = journey(remap, smooth, 32);
    EXPECT_LT(medium, 2e-4);
    EXPECT_GT(std::log2(coarse / medium), 1.8);
    EXPECT_GT(std::log2(medium / fine), 1.9);
  }
}

TEST(NodalRemap, QuadraticFieldsSurviveOnStraightElementsAndTheBoundaryKeepsItsOwn) {
  const auto mesh = box(CellShape::tri6, 6);
  const WholeMesh whole(*mesh);
  const Positions x = whole.gather(mesh->coordinates());
  const auto paths = find_paths(whole, x, {}, 0.5);
  Positions to = swirled(x, 0.03, 1.0);
  for (const MeshPath& path : paths)  // slide along the straight sides
    for (std::size_t i = 1; i + 1 < path.nodes.size(); ++i)
      for (int d = 0; d < 2; ++d) to[path.nodes[i]][d] = 0.7 * x[path.nodes[i]][d] + 0.3 * x[path.nodes[i + 1]][d];
  const NodalRemap remap(whole, paths, x, to);
  std::vector<double> old, exact;
  const auto field = [](const std::array<double, 2>& p) { return 1 + p[0] - 2 * p[1] + 3 * p[0] * p[1] - p[1] * p[1]; };
  for (int node = 0; node < whole.num_nodes(); ++node) {
    old.push_back(field(x[node]));
    exact.push_back(field(to[node]));
  }
  EXPECT_GT(worst(old, exact), 0.05);
  EXPECT_LT(worst(remap.apply(old, 1, Support::all_nodes), exact), 1e-12);
}

}  // namespace
}  // namespace mudline
