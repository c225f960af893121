#include <gtest/gtest.h>

#include "ale/conservation.hpp"
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
  explicit Points(const Mesh& mesh)
      : whole(mesh), block(points_of(mesh)), patches(whole, block), start(whole.gather(mesh.coordinates())) {}
  std::vector<double> values(Field field, const Positions& x) const {
    std::vector<double> result;
    for (int e : whole.block_elements(0))
      for (int q = 0; q < block.points; ++q) {
        const auto p = Recovery::position(whole.elements()[e], block, q, x);
        result.push_back(field(p[0], p[1]));
      }
    return result;
  }
  std::vector<double> transferred(const std::vector<double>& old, const Positions& from, const Positions& to) const {
    std::vector<double> now = old;
    remap.transfer({{whole, block, from}, {whole, block, to}, patches, variables, 1, old, now});
    return now;
  }
  GhostedMesh whole;
  SoilBlock block;
  RecoveryPatches patches;
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
    // elements become curved too: every node moves independently
    const Positions from = swirled(points.start, 0.05, 0.3), to = swirled(points.start, 0.07, 2.0);
    EXPECT_GT(worst(points.values(linear, from), points.values(linear, to)), 0.1);
    EXPECT_LT(worst(points.transferred(points.values(linear, from), from, to), points.values(linear, to)), 1e-12);
  }
}

TEST(ConvectionRemap, PointsAtRestKeepTheirValuesToTheLastBit) {
  const auto mesh = box(CellShape::tri6, 6);
  const Points points(*mesh);
  Positions to = points.start;
  const int moved = points.whole.elements()[30].nodes[0];
  to[moved][0] += 0.02;
  const auto old = points.values(smooth, points.start), now = points.transferred(old, points.start, to);
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
  points.variables = {{"f", 1, "-", Transfer::value, 0.5, 10.0}};
  std::vector<double> field =
      points.values([](double x, double y) { return x + 0.2 * y > 0.55 ? 1.0 : 0.0; }, points.start);
  for (double& value : field) value = std::max(value, 0.5);
  Positions from = points.start;
  for (int step = 0; step < 20; ++step) {
    const Positions to = swirled(points.start, 0.05, 0.2 * step);
    field = points.transferred(field, from, to);
    from = to;
  }
  for (double value : field) {
    EXPECT_GE(value, 0.5);
    EXPECT_LE(value, 1.35);  // recovered values at nodes overshoot a jump by less than its half
  }
}

/// Moves the mesh in steps of a thousandth of the box, with scatter of this size about a field; returns the share of
/// the scatter that is left and the error of the field itself, both rms.
std::pair<double, double> left_of_scatter(Field field, double size) {
  const auto mesh = box(CellShape::tri6, 8, 0.2);
  const Points points(*mesh);
  std::vector<double> clean = points.values(field, points.start), scattered = clean;
  for (std::size_t i = 0; i < scattered.size(); ++i) scattered[i] += size * std::sin(12.9898 * i + 78.233 * i * i);
  Positions from = points.start;
  for (int k = 1; k <= 10; ++k) {
    const Positions to = swirled(points.start, 0.001 * k, 0.5);
    clean = points.transferred(clean, from, to);
    scattered = points.transferred(scattered, from, to);
    from = to;
  }
  const std::vector<double> exact = points.values(field, from);
  double scatter = 0, off = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    scatter += std::pow(scattered[i] - clean[i], 2) / exact.size();
    off += std::pow(clean[i] - exact[i], 2) / exact.size();
  }
  return {std::sqrt(2 * scatter) / size, std::sqrt(off)};
}

TEST(ConvectionRemap, ScatterAboutAUniformFieldGoesLongBeforePointsCrossTheirElement) {
  const auto uniform = left_of_scatter([](double, double) { return 1.2; }, 0.01);
  EXPECT_LT(uniform.first, 0.7);  // upwinding alone would leave 0.9
  EXPECT_LT(uniform.second, 1e-15);
  // About a field that changes over the elements only large scatter is removed, and the field itself survives.
  EXPECT_LT(left_of_scatter(smooth, 0.5).first, 0.8);
  EXPECT_GT(left_of_scatter(smooth, 1e-3).first, 0.6);
  EXPECT_LT(left_of_scatter(smooth, 1e-3).second, 2e-3);
}

/// The rms error after a motion there and back in steps of a fixed share of an element.
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
    values = points.transferred(values, from, k == steps ? points.start : to);
    from = to;
  }
  double sum = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) sum += std::pow(values[i] - exact[i], 2) / exact.size();
  return std::sqrt(sum);
}

/// Recovered values at the nodes of the wall x = 0, away from its corners.
std::vector<std::pair<double, double>> at_the_wall(Field field) {
  const auto mesh = box(CellShape::tri6, 8);
  const Points points(*mesh);
  const std::vector<double> rows = points.values(field, points.start);
  const Recovery recovered(points.whole, points.block, points.patches, points.start, rows, 1);
  std::vector<std::pair<double, double>> result;  // height, value
  for (int e : points.whole.block_elements(0))
    for (int a = 0; a < 3; ++a) {
      const Point& x = points.start[points.whole.elements()[e].nodes[a]];
      if (x[0] != 0 || x[1] < 0.2 || x[1] > 0.8) continue;
      const auto xi = reference_node(CellShape::tri6, a);
      MeshPlace place{e, {}};
      std::copy(xi.begin(), xi.end(), place.xi);
      double value;
      recovered.at(place, &value);
      result.push_back({x[1], value});
    }
  return result;
}

TEST(Recovery, IsQuadraticAtAWallWhereTheFieldIsSmoothAndLinearWhereItIsSteep) {
  const auto bent = at_the_wall([](double x, double y) { return 3 + x + 2 * y + 0.1 * x * x; });
  EXPECT_GT(bent.size(), 5u);
  for (const auto& [y, value] : bent) EXPECT_NEAR(value, 3 + 2 * y, 1e-12);
  for (const auto& [y, value] : at_the_wall([](double x, double) { return x * x; })) {
    EXPECT_LT(value, -1e-4);  // as a linear fit through points beside the wall gives
    EXPECT_GT(value, -1e-2);
  }
}

TEST(ConvectionRemap, WhatIsSteepAtAWallDoesNotGetSteeper) {
  const auto mesh = box(CellShape::tri6, 8);
  const Points points(*mesh);
  std::vector<double> values = points.values([](double x, double) { return std::exp(-50 * x); }, points.start);
  const double highest = *std::max_element(values.begin(), values.end());
  Positions from = points.start;
  for (int k = 1; k <= 200; ++k) {
    Positions to = points.start;  // along the wall
    for (auto& p : to) p[1] += 0.02 * std::sin(std::acos(-1.0) * p[1]) * std::sin(0.7 * k);
    values = points.transferred(values, from, to);
    from = to;
  }
  EXPECT_LT(*std::max_element(values.begin(), values.end()), highest);
}

TEST(ConvectionRemap, IsOfSecondOrderForSmoothFields) {
  for (const ConvectionRemap& remap : {ConvectionRemap(ConvectionRemap::Scheme::incremental, true),
                                       ConvectionRemap(ConvectionRemap::Scheme::upwind, true)}) {
    const double coarse = journey(remap, smooth, 8), medium = journey(remap, smooth, 16),
                 fine = journey(remap, smooth, 32);
    EXPECT_LT(medium, 2e-4);
    EXPECT_GT(std::log2(coarse / medium), 1.8);
    EXPECT_GT(std::log2(medium / fine), 1.9);
  }
}

/// A front three elements thick is transferred six times between two meshes: a single recovery smooths it away.
TEST(RecoveryRemap, AFrontOfThreeElementsSurvivesOtherMeshes) {
  const auto front = [](double x, double y) { return std::exp(-8 * (1 - y)) * (1 + 0.1 * x); };
  const auto one = box(CellShape::tri6, 8), other = box(CellShape::tri6, 9, 0.3);
  const Points a(*one), b(*other);
  const std::vector<double> exact = a.values(front, a.start);
  const auto by_single = [](const PointTransfer& t) {
    const Recovery recovered(t.before.mesh, t.before.block, t.patches, t.before.x, t.old, 1);
    const PointLocator locator(t.before.mesh, t.before.x);
    for (int e : t.after.mesh.block_elements(0))
      for (int q = 0; q < t.after.block.points; ++q)
        recovered.at(locator.find(Recovery::position(t.after.mesh.elements()[e], t.after.block, q, t.after.x), 0),
                     &t.now[t.after.mesh.first_row(e, t.after.block.points) + q]);
  };
  const auto error = [&](const auto& transfer) {
    std::vector<double> values = exact;
    for (int k = 0; k < 6; ++k) {
      const Points &from = k % 2 == 0 ? a : b, &to = k % 2 == 0 ? b : a;
      std::vector<double> now(static_cast<std::size_t>(to.block.elements) * to.block.points, 0.0);
      transfer(PointTransfer{{from.whole, from.block, from.start},
                             {to.whole, to.block, to.start},
                             from.patches,
                             from.variables,
                             1,
                             values,
                             now});
      values = now;
    }
    double sum = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) sum += std::pow(values[i] - exact[i], 2) / exact.size();
    return std::sqrt(sum);
  };
  const double twice = error([](const PointTransfer&t) { RecoveryRemap().transfer(t); }), single = error(by_single);
  EXPECT_LT(twice, 0.6 * single);
  EXPECT_LT(twice, 0.01);
}

TEST(Conservation, TheGrainsComeBackToTheLastDigitsAndPointsAtRestKeepTheirs) {
  for (Geometry geometry : {Geometry::plane_strain, Geometry::axisymmetric}) {
    const bool axisymmetric = geometry == Geometry::axisymmetric;
    const auto mesh = box(CellShape::tri6, 6);
    Points points(*mesh);
    Positions to = points.start;
    for (auto& p : to)  // the right part rests
      if (p[0] < 0.6) p[1] += 0.03 * std::sin(4 * std::acos(-1.0) * p[1]) * std::sin(std::acos(-1.0) * p[0] / 0.6);
    const auto ratio = [](double x, double y) { return 1 + 0.3 * std::sin(2 * x) * std::cos(3 * y); };
    const std::vector<double> old = points.values(ratio, points.start);
    std::vector<double> now = points.transferred(old, points.start, to);
    const auto transported = now;
    const auto grains = [&](const std::vector<double>& values, const Positions& x) {
      double sum = 0;  // by the points' own volumes, computed independently
      for (int e : points.whole.block_elements(0)) {
        const auto& nodes = points.whole.elements()[e].nodes;
        for (int q = 0; q < points.block.points; ++q) {
          double j[4] = {0, 0, 0, 0}, r = 0;
          for (int a = 0; a < 6; ++a) {
            r += points.block.u.N(q, a) * x[nodes[a]][0];
            for (int k = 0; k < 4; ++k) j[k] += x[nodes[a]][k / 2] * points.block.u.dN(q, a, k % 2);
          }
          const double dv =
              points.block.u.weights(q) * (j[0] * j[3] - j[1] * j[2]) * (axisymmetric ? 2 * std::acos(-1.0) * r : 1);
          sum += dv / (1 + values[points.whole.first_row(e, points.block.points) + q]);
        }
      }
      return sum;
    };
    const double mass = grains(old, points.start);
    Soil soil;
    soil.geometry = geometry;
    points.block.made_of = {0};
    const std::vector<Grains> restored = restore_grains({{points.whole, points.block, points.start},
                                                         {points.whole, points.block, to},
                                                         points.patches,
                                                         points.variables,
                                                         1,
                                                         old,
                                                         now},
                                                        soil, 0, -1);
    const double share = restored[0].missing / restored[0].before;
    EXPECT_EQ(restored[0].lost(), share);
    EXPECT_GT(std::abs(share), 1e-7);  // the transfer alone does not conserve
    EXPECT_NEAR(grains(transported, to) / mass, 1 - share, 1e-13);
    EXPECT_NEAR(grains(now, to) / mass, 1, 1e-14);
    int rest = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      EXPECT_NEAR(now[i], transported[i], 1e-3);
      rest += now[i] == transported[i];
    }
    EXPECT_GT(rest, static_cast<int>(now.size()) / 5);
  }
}

TEST(Conservation, TheFreeBoundaryKnowsWhatVolumeItMoves) {
  for (bool axisymmetric : {false, true}) {
    const auto mesh = box(CellShape::tri6, 6);
    const Points points(*mesh);
    Soil soil;
    soil.geometry = axisymmetric ? Geometry::axisymmetric : Geometry::plane_strain;
    soil.blocks = {points.block};
    Positions x = points.start;
    for (auto& p : x) p[1] *= 1 + 0.1 * std::sin(3 * p[0]);  // a curved top
    EXPECT_NEAR(soil_volume(points.whole, soil, points.start), axisymmetric ? std::acos(-1.0) : 1.0, 1e-13);
    std::vector<double> free(points.whole.num_nodes(), 0.0);
    std::vector<double> held(2 * points.whole.num_nodes(), 0.0);
    int tops = 0;
    for (std::size_t node = 0; node < x.size(); ++node) {
      if (points.start[node][1] < 1 - 1e-12 || std::abs(points.start[node][0] - 0.5) > 0.49) continue;  // ends rest
      free[node] = points.start[node][0] < 0.3 ? 0.5 : 1.0;  // half the freedom on the left
      if (points.start[node][0] > 0.5) held[2 * node] = 1;
      if (points.start[node][0] > 0.7) held[2 * node + 1] = 1;
      tops += points.start[node][0] <= 0.7;
    }
    for (std::size_t node = 0; node < x.size(); ++node)  // a roller: its normal is held
      if (points.start[node][0] > 1 - 1e-12 && std::abs(points.start[node][1] - 0.5) < 0.49)
        free[node] = held[2 * node] = 1;
    const FreeBoundary boundary(points.whole, soil, free, held, x);
    EXPECT_EQ(static_cast<int>(boundary.movers.size()), tops);
    Positions there = x, back = x;
    const double step = 1e-5;
    for (const auto& mover : boundary.movers) {
      EXPECT_GT(mover.normal[1], 0.4);
      for (int d = 0; d < 2; ++d) {
        there[mover.node][d] += step * mover.normal[d];
        back[mover.node][d] -= step * mover.normal[d];
      }
    }
    const double slope = (soil_volume(points.whole, soil, there) - soil_volume(points.whole, soil, back)) / (2 * step);
    EXPECT_NEAR(slope / boundary.area, 1, 1e-9);
  }
}

TEST(NodalRemap, QuadraticFieldsSurviveOnStraightElementsAndTheBoundaryKeepsItsOwn) {
  const auto mesh = box(CellShape::tri6, 6);
  const GhostedMesh whole(*mesh);
  const Positions x = whole.gather(mesh->coordinates());
  const auto paths = find_paths(whole, x, {}, 0.5);
  Positions to = swirled(x, 0.03, 1.0);
  for (const MeshPath& path : paths)  // slide along the straight sides
    for (std::size_t i = 1; i + 1 < path.nodes.size(); ++i)
      for (int d = 0; d < 2; ++d) to[path.nodes[i]][d] = 0.7 * x[path.nodes[i]][d] + 0.3 * x[path.nodes[i + 1]][d];
  const NodalRemap remap(whole, paths, x, to);
  std::vector<double> old, exact;
  const auto field = [](const Point& p) { return 1 + p[0] - 2 * p[1] + 3 * p[0] * p[1] - p[1] * p[1]; };
  for (int node = 0; node < whole.num_nodes(); ++node) {
    old.push_back(field(x[node]));
    exact.push_back(field(to[node]));
  }
  EXPECT_GT(worst(old, exact), 0.05);
  EXPECT_LT(worst(remap.apply(old, 1, Support::all_nodes), exact), 1e-12);
}

TEST(NodalRemap, AFieldThatJumpsKeepsItsRangeWhenLimited) {
  const auto mesh = box(CellShape::tri6, 6);
  const GhostedMesh whole(*mesh);
  const Positions x = whole.gather(mesh->coordinates());
  const NodalRemap remap(whole, {}, x, swirled(x, 0.03, 1.0));
  std::vector<double> step, linear, there;
  const auto plane = [](const Point& p) { return 2 * p[0] - p[1]; };
  for (int node = 0; node < whole.num_nodes(); ++node) {
    step.push_back(x[node][0] < 0.4 ? -8.0 : 0.0);
    linear.push_back(plane(x[node]));
    there.push_back(plane(swirled(x, 0.03, 1.0)[node]));
  }
  std::vector<double> free = step, limited = step;
  for (int k = 0; k < 50; ++k) {
    free = remap.apply(free, 1, Support::all_nodes);
    limited = remap.apply(limited, 1, Support::all_nodes, true);
  }
  EXPECT_GT(*std::max_element(free.begin(), free.end()), 0.5);  // the overshoot that the limit prevents
  EXPECT_EQ(*std::max_element(limited.begin(), limited.end()), 0.0);
  EXPECT_EQ(*std::min_element(limited.begin(), limited.end()), -8.0);
  EXPECT_LT(worst(remap.apply(linear, 1, Support::all_nodes, true), there), 1e-12);
}

}  // namespace
}  // namespace mudline
