// Mesh motion and remap in space, on every cell.
#include <gtest/gtest.h>

#include "ale/conservation.hpp"
#include "ale/interior_motion.hpp"
#include "ale/layer_remap.hpp"
#include "ale/nodal_remap.hpp"
#include "ale/quality.hpp"
#include "ale/remap.hpp"
#include "ale/surface_motion.hpp"
#include "ale/vertex_colours.hpp"
#include "ale_mesh.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

using testing::cube;
using testing::grains;
using testing::points_of;

double linear(const Point& x) { return 3 - 2 * x[0] + 5 * x[1] + 0.7 * x[2]; }
double quadratic(const Point& x) {
  return 1 + x[0] - 2 * x[1] + x[2] + 3 * x[0] * x[1] - x[1] * x[1] + 2 * x[2] * x[2] - x[0] * x[2] +
         0.5 * x[1] * x[2] + 0.3 * x[0] * x[0];
}

/// Inner nodes moved by a smooth field that vanishes on the boundary.
Positions swirled(const Positions& x, double size, double phase) {
  const double pi = std::acos(-1.0);
  Positions result = x;
  for (Point& p : result) {
    const double bubble = size * std::sin(pi * p[0]) * std::sin(pi * p[1]) * std::sin(pi * p[2]);
    const Point at = p;
    for (int d = 0; d < 3; ++d) p[d] += bubble * std::cos(phase + 2 * at[(d + 1) % 3] + d);
  }
  return result;
}

double worst(const std::vector<double>& a, const std::vector<double>& b) {
  double result = 0;
  for (std::size_t i = 0; i < a.size(); ++i) result = std::max(result, std::abs(a[i] - b[i]));
  return result;
}

class EveryCellOfSpace : public ::testing::TestWithParam<CellShape> {
 protected:
  template <class F>
  std::vector<double> at_points(F&& field, const Positions& x) const {
    std::vector<double> result;
    for (int e : whole.block_elements(0))
      for (int q = 0; q < block.points; ++q)
        result.push_back(field(Recovery::position(whole.elements()[e], block, q, x)));
    return result;
  }
  template <class F>
  std::vector<double> at_nodes(F&& field, const Positions& x) const {
    std::vector<double> result;
    for (const Point& p : x) result.push_back(field(p));
    return result;
  }
  double lowest_determinant(const Positions& x) const {
    double lowest = 1e300;
    for (const Simplex& t : corners.simplices) lowest = std::min(lowest, determinant(t, x));
    return lowest;
  }
  std::vector<char> inner() const {
    std::vector<char> movable;
    for (int node = 0; node < whole.num_nodes(); ++node)
      movable.push_back(whole.is_vertex(node) && !whole.on_boundary(node));
    return movable;
  }
  std::unique_ptr<Mesh> mesh = cube(GetParam(), 4, 0.15);
  GhostedMesh whole{*mesh};
  SoilBlock block = points_of(*mesh, order(GetParam()) == 2 && !is_simplex(GetParam()) ? 4 : 2);
  RecoveryPatches patches{whole, block};
  Positions start = whole.gather(mesh->coordinates());
  CornerSimplices corners{whole};
  std::vector<char> movable = inner();
  std::vector<std::vector<int>> colours = vertex_colours(whole, movable);
  std::vector<StateVariable> variables{{"f", 1, "-"}};
};
INSTANTIATE_TEST_SUITE_P(Space, EveryCellOfSpace,
                         ::testing::Values(CellShape::tet4, CellShape::tet10, CellShape::hex8, CellShape::hex27));

TEST_P(EveryCellOfSpace, NeighboursSeeEachOther) {
  int outer = 0;
  for (int e = 0; e < static_cast<int>(whole.elements().size()); ++e)
    for (int s = 0; s < num_sides(GetParam()); ++s) {
      const int other = whole.elements()[e].neighbours[s];
      outer += other < 0;
      if (other < 0) continue;
      const auto& back = whole.elements()[other].neighbours;
      EXPECT_EQ(std::count(back.begin(), back.end(), e), 1);
    }
  EXPECT_EQ(outer, 6 * 16 * (is_simplex(GetParam()) ? 2 : 1));
  for (int node = 0; node < whole.num_nodes(); ++node) {
    const Point& x = start[node];
    const bool on = std::any_of(x.begin(), x.end(), [](double c) { return std::min(c, 1 - c) < 1e-12; });
    EXPECT_EQ(whole.on_boundary(node), on);
  }
}

TEST_P(EveryCellOfSpace, FindsThePointsOfACurvedMesh) {
  const Positions x = swirled(start, 0.06, 0.4);
  const PointLocator locator(whole, x);
  for (int k = 0; k < 60; ++k) {
    const Point at{0.01 + 0.98 * (k % 7) / 6.0, 0.01 + 0.95 * (k % 11) / 10.0, 0.03 + 0.9 * (k % 5) / 4.0};
    const MeshPlace found = locator.find(at, k % static_cast<int>(whole.elements().size()));
    const auto& element = whole.elements()[found.element];
    EXPECT_LT(outside_cell(element.shape, found.xi), 1e-9);
    const auto there = ElementMap(element.shape, [&](int a) { return x[element.nodes[a]].data(); }).at(found.xi);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(there[i], at[i], 1e-12);
  }
}

TEST_P(EveryCellOfSpace, NearestOnTheBoundaryBeatsEveryOtherPointOfIt) {
  Positions x = start;
  for (Point& p : x) p[2] += 0.15 * std::sin(3 * p[0]) * std::cos(2 * p[1]) * p[2];
  const PointLocator curved(whole, x), straight(whole, start);
  for (const Point& at :
       {Point{0.37, 0.6, 1.8}, {-0.4, 0.61, 0.3}, {1.7, 1.2, -0.2}, {0.5, 0.5, 1.01}, {0.2, -1e-3, 0.7}}) {
    const auto place = [&](const MeshPlace& found, const Positions& of) {
      const auto& element = whole.elements()[found.element];
      return ElementMap(element.shape, [&](int a) { return of[element.nodes[a]].data(); }).at(found.xi);
    };
    const auto on_cube = place(straight.nearest_on_boundary(at), start);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(on_cube[i], std::clamp(at[i], 0.0, 1.0), 1e-12);
    const MeshPlace best = curved.nearest_on_boundary(at);
    const double found = distance(place(best, x), at);
    double least = 1e300;
    for (int e = 0; e < static_cast<int>(whole.elements().size()); ++e)
      for (int s = 0; s < num_sides(GetParam()); ++s) {
        if (whole.elements()[e].neighbours[s] >= 0) continue;
        const bool triangle = is_simplex(GetParam());
        for (int i = 0; i <= 20; ++i)
          for (int j = 0; j <= (triangle ? 20 - i : 20); ++j) {
            Vec<double, 2> on{i / 20.0, j / 20.0};
            for (double& c : on) c = triangle ? c : 2 * c - 1;
            MeshPlace there{e, {}};
            const auto xi = on_side(GetParam(), s, on);
            std::copy(xi.begin(), xi.end(), there.xi);
            least = std::min(least, distance(place(there, x), at));
          }
      }
    EXPECT_LE(found, least + 1e-12);
    EXPECT_GE(found, least - 1e-2);  // the sampled places are this far apart
  }
}

TEST_P(EveryCellOfSpace, TheSimplicesOfTheElementsFillThemAndTheirIdealsAreAtRest) {
  double volume = 0;
  for (int i = 0; i < corners.of_elements; ++i) volume += determinant(corners.simplices[i], start) / 6;
  if (is_simplex(GetParam())) {
    EXPECT_NEAR(volume, 1, 1e-12);
  }
  EXPECT_EQ(corners.of_elements, static_cast<int>(whole.elements().size()) * (is_simplex(GetParam()) ? 1 : 8));
  Positions source = start;
  corners.add_tangents(start, source);
  EXPECT_GT(lowest_determinant(source), 0);
  for (const bool optimises : {true, false}) {
    Positions x = source;
    const InteriorMesh inside{whole, corners, source, source, movable, colours};
    optimises ? OptimisationMotion().move(inside, x) : ElasticMotion().move(inside, x);
    for (int node = 0; node < whole.num_nodes(); ++node) EXPECT_EQ(x[node], source[node]);
  }
}

/// The top is pushed in until it nearly meets the inner vertices.
TEST_P(EveryCellOfSpace, TheInsideFollowsThePushedBoundaryAndNothingFolds) {
  const double pi = std::acos(-1.0);
  Positions source = start, pushed = start;
  for (int node = 0; node < whole.num_nodes(); ++node)
    if (whole.on_boundary(node))
      pushed[node][2] *= 1 - 0.16 * std::pow(std::sin(pi * start[node][0]) * std::sin(pi * start[node][1]), 2);
  corners.add_tangents(start, source);
  corners.add_tangents(pushed, pushed);
  const double before = lowest_determinant(pushed);
  ASSERT_GT(before, 0);
  for (int type = 0; type < 2; ++type) {
    std::unique_ptr<InteriorMotion> motion;
    if (type == 0) motion = std::make_unique<OptimisationMotion>();
    if (type == 1) motion = std::make_unique<ElasticMotion>();
    Positions x = pushed;
    motion->move({whole, corners, source, source, movable, colours}, x);
    EXPECT_GT(lowest_determinant(x), 1.2 * before) << type;
    int moved = 0;
    for (int node = 0; node < whole.num_nodes(); ++node) {
      moved += x[node] != pushed[node];
      if (!movable[node]) {
        EXPECT_EQ(x[node], pushed[node]);
      }
    }
    EXPECT_EQ(moved, 27);
  }
}

/// Every inner vertex starts far off its optimum, in a mesh without folded elements; none folds during the
/// optimisation.
TEST_P(EveryCellOfSpace, OptimisationBringsTheMeshBack) {
  Positions source = start, x = start;
  for (int node = 0; node < whole.num_nodes(); ++node)
    if (movable[node])
      for (int d = 0; d < 3; ++d) x[node][d] += 0.06 * std::sin(1.7 * node + 2.1 * d);
  corners.add_tangents(start, source);
  corners.add_tangents(start, x);
  ASSERT_GT(lowest_determinant(x), 0);
  double largest = 0;
  for (int node = 0; node < whole.num_nodes(); ++node) largest = std::max(largest, distance(x[node], source[node]));
  ASSERT_GT(largest, 0.07);
  OptimisationMotion().move({whole, corners, source, source, movable, colours}, x);
  for (int node = 0; node < whole.num_nodes(); ++node)
    if (whole.is_vertex(node)) {
      EXPECT_LT(distance(x[node], source[node]), 2e-3);
    }
}

TEST_P(EveryCellOfSpace, LinearFieldsSurviveArbitraryMotion) {
  const Positions from = swirled(start, 0.05, 0.3), to = swirled(start, 0.07, 2.0);
  const std::vector<double> old = at_points(linear, from), exact = at_points(linear, to);
  std::vector<double> now = old;
  ConvectionRemap().transfer({{whole, block, from}, {whole, block, to}, patches, variables, 1, old, now});
  EXPECT_GT(worst(old, exact), 0.05);
  EXPECT_LT(worst(now, exact), 1e-12);
}

TEST_P(EveryCellOfSpace, RecoveryReproducesQuadraticFieldsAtTheVerticesInside) {
  const std::vector<double> rows = at_points(quadratic, start);
  const Recovery recovered(whole, block, patches, start, rows, 1);
  int checked = 0;
  for (int e : whole.block_elements(0)) {
    const auto& element = whole.elements()[e];
    for (int a = 0; a < num_corners(GetParam()); ++a) {
      const Point& x = start[element.nodes[a]];
      if (std::any_of(x.begin(), x.end(), [](double c) { return c == 0 || c == 1; })) continue;
      double value;
      MeshPlace place{e, {}};
      const auto xi = reference_node(GetParam(), a);
      std::copy(xi.begin(), xi.end(), place.xi);
      recovered.at(place, &value);
      EXPECT_NEAR(value, quadratic(x), 1e-11);
      ++checked;
    }
  }
  EXPECT_GT(checked, 50);
}

TEST_P(EveryCellOfSpace, TheGrainsComeBackToTheLastDigits) {
  const Positions to = swirled(start, 0.04, 1.0);
  const auto ratio = [](const Point& x) { return 0.8 + 0.3 * std::sin(3 * x[0]) * std::cos(2 * x[1] + x[2]); };
  const std::vector<double> old = at_points(ratio, start);
  std::vector<double> now = old;
  block.made_of = {0};
  const PointTransfer transfer{{whole, block, start}, {whole, block, to}, patches, variables, 1, old, now};
  ConvectionRemap().transfer(transfer);
  Soil soil;
  soil.geometry = Geometry::space;
  soil.blocks = {block};
  EXPECT_NEAR(soil_volume(whole, soil, start), 1, 1e-13);
  const double mass = grains(whole, block, start, soil.geometry, old),
               transferred = grains(whole, block, to, soil.geometry, now);
  const std::vector<Grains> restored = restore_grains(transfer, soil, 0, -1);
  EXPECT_GT(std::abs(transferred / mass - 1), 1e-7);  // the transfer alone does not conserve
  EXPECT_NEAR(restored[0].lost(), 1 - transferred / mass, 1e-13);
  EXPECT_NEAR(grains(whole, block, to, soil.geometry, now) / mass, 1, 1e-13);
}

TEST_P(EveryCellOfSpace, NodalFieldsOfTheElementsOrderSurvive) {
  Positions to = start;  // inner vertices and mid-side nodes move alike: the old mesh has straight edges
  for (int node = 0; node < whole.num_nodes(); ++node)
    if (!whole.on_boundary(node))
      for (int d = 0; d < 3; ++d) to[node][d] += 0.03 * std::sin(1.7 * node + d);
  const NodalRemap remap(whole, {}, start, to);
  const auto field = order(GetParam()) == 2 ? quadratic : linear;
  // In a distorted hexahedron only linear fields are exact: the inverse of its map is no polynomial.
  const bool exact = is_simplex(GetParam());
  const auto chosen = exact ? field : linear;
  EXPECT_LT(worst(remap.apply(at_nodes(chosen, start), 1, Support::all_nodes), at_nodes(chosen, to)), 1e-12);
}

/// A linear function is continued from the rows of one half to those of the other.
TEST_P(EveryCellOfSpace, RowsAreContinuedLinearly) {
  std::vector<double> table = at_points(linear, start);
  const std::vector<double> exact = table;
  std::vector<char> known;
  for (double x : at_points([](const Point& p) { return p[0]; }, start))
    known.push_back(x < 0.5 && known.size() % 7 != 0);
  for (std::size_t row = 0; row < table.size(); ++row)
    if (!known[row]) table[row] = 1e30;
  std::vector<double> now = table;
  continue_rows({{whole, block, start}, {whole, block, start}, patches, variables, 1, table, now}, table, known);
  int continued = 0;
  for (std::size_t row = 0; row < table.size(); ++row)
    if (known[row] > 1) {
      ++continued;
      EXPECT_NEAR(table[row], exact[row], 1e-11) << int(known[row]);
    }
  EXPECT_GT(continued, static_cast<int>(table.size()) / 4);
}

/// Boundary vertices slide back along plane faces; their values are transferred.
TEST_P(EveryCellOfSpace, BoundaryNodesSlideInTheirPlanesAndTheirValuesComeFromTheFaces) {
  const MeshSurfaces surfaces = split_surfaces(boundary_faces(whole), start, {}, 0.5, [](int) { return false; });
  ASSERT_EQ(surfaces.patches.size(), 6u);
  ASSERT_EQ(surfaces.curves.size(), 12u);
  for (int node = 0; node < whole.num_nodes(); ++node) {
    const Point& at = start[node];
    int sides = 0;
    for (int d = 0; d < 3; ++d) sides += at[d] == 0 || at[d] == 1;
    EXPECT_EQ(surfaces.patch_of[node] >= 0, sides == 1);
  }
  const SurfaceMotion motion(surfaces, start, 0.4);
  // Vertices inside the faces start displaced along them; mid-side nodes and inner nodes follow.
  Positions x_old = start;
  for (int node = 0; node < whole.num_nodes(); ++node)
    if (whole.is_vertex(node) && surfaces.patch_of[node] >= 0)
      for (int d = 0; d < 3; ++d)
        if (start[node][d] != 0 && start[node][d] != 1) x_old[node][d] += 0.05 * std::sin(1.7 * node + d);
  for (const auto& element : whole.elements())
    for (int a = num_corners(element.shape); a < num_nodes(element.shape); ++a) {
      const std::vector<int> around = corners_around(element.shape, a);
      Point mean{};
      for (int c : around)
        for (int d = 0; d < 3; ++d) mean[d] += x_old[element.nodes[c]][d] / around.size();
      x_old[element.nodes[a]] = mean;
    }
  Positions x = x_old;
  motion.move(
      x_old, [](const Point&) { return std::optional<NearBody>(); }, x);
  double moved = 0;
  for (int node = 0; node < whole.num_nodes(); ++node) {
    moved = std::max(moved, distance(x[node], x_old[node]));
    if (!whole.on_boundary(node)) {
      EXPECT_EQ(x[node], x_old[node]);
    }
    for (int d = 0; d < 3; ++d)
      if (start[node][d] == 0 || start[node][d] == 1) {
        EXPECT_EQ(x[node][d], start[node][d]);
      }
  }
  EXPECT_GT(moved, 0.01);
  const NodalRemap remap(whole, surfaces.curves, x_old, x, &motion);
  EXPECT_LT(worst(remap.apply(at_nodes(linear, x_old), 1, Support::all_nodes), at_nodes(linear, x)), 1e-12);
  // Values prescribed on a face do not change: inner values have no influence.
  std::vector<double> held = at_nodes([](const Point&) { return 100.0; }, x);
  for (int node = 0; node < whole.num_nodes(); ++node)
    if (whole.on_boundary(node)) held[node] = 7;
  const std::vector<double> now = remap.apply(held, 1, Support::all_nodes);
  for (int node = 0; node < whole.num_nodes(); ++node)
    if (whole.on_boundary(node)) {
      EXPECT_NEAR(now[node], 7, 1e-13);
    }
}

}  // namespace
}  // namespace mudline
