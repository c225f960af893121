// Transfer of layers whose interface is no mesh line to a moved mesh: each layer keeps its own fields and grains.
#include "ale/layer_remap.hpp"

#include <gtest/gtest.h>

#include "ale/conservation.hpp"
#include "ale_mesh.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

using testing::box;
using testing::cube;
using testing::points_of;

constexpr double interface = 0.47;  // [m] height, not a mesh line of the meshes below

/// A law whose state is the height at which it started.
class Remembers : public Skeleton {
 public:
  const std::vector<StateVariable>& state_variables() const override { return variables_; }
  std::string initialise(const InitialPoint& point, double* state) const override {
    state[0] = point.height;
    return point.void_ratio > 5 ? "too loose" : "";
  }
  int evaluate(const SkeletonWorkset&) const override { return 0; }
  ElasticModuli moduli(const double*, double, const double*) const override { return {1, 1}; }

 private:
  std::vector<StateVariable> variables_{{"height", 1, "m"}};
};

/// Two layers in a unit square or cube: fields that are linear in each and jump between them.
struct Layers {
  Layers(CellShape shape, int n, double width = 1)
      : Layers(dimension(shape) == 2 ? box(shape, n, 0.2, width) : cube(shape, n, 0.15, width)) {
    this->width = width;
  }
  explicit Layers(std::unique_ptr<Mesh> made)
      : mesh(std::move(made)),
        space(*mesh, {displacement_field()}),
        whole(*mesh),
        block(points_of(*mesh)),
        patches(whole, block),
        start(whole.gather(mesh->coordinates())) {
    soil.space = &space;
    up = whole.dimension() - 1;
    soil.geometry = mesh->geometry();
    soil.up[up] = 1;
    for (int k = 0; k < 2; ++k) {
      auto material = std::make_shared<SoilMaterial>();
      material->name = k == 0 ? "upper" : "lower";
      material->has_top = k == 1;
      material->top = interface;
      material->skeleton = std::make_shared<Remembers>();
      soil.materials.push_back(material);
    }
    block.made_of = {0, 1};
    soil.blocks = {block};
    table.columns = 6 + 2 + 1 + 1 + whole.dimension();
    table.variables = {{"effective stress", 6, "Pa"},  {"void ratio", 1, "-", Transfer::mass, -1.0},
                       {"initial void ratio", 1, "-"}, {"height", 1, "m"},
                       {"material", 1, "-"},           {"place at the start", whole.dimension(), "m"}};
  }
  static double field(int column, int material, double x, double y) {
    return (material == 0 ? 1.0 : -2.0) * (column + 1) + (material == 0 ? 0.3 : 0.7) * column * x -
           0.4 * (column + 2) * y;
  }
  static double ratio(int material, double x, double y) { return material == 0 ? 1.5 - 0.2 * y : 0.6 + 0.1 * x; }
  double value(int column, int material, const Point& p) const {
    if (column == table.void_ratio) return ratio(material, p[0], p[up]);
    if (column == table.origin) return material;
    if (column > table.origin) return p[column - table.origin - 1];
    return field(column, material, p[0], p[up]) + (up == 2 ? 0.2 * material * p[1] : 0.0);
  }
  template <class F>
  void each(const Positions& x, F&& f) const {
    for (int e : whole.block_elements(0))
      for (int q = 0; q < block.points; ++q)
        f(whole.first_row(e, block.points) + q, Recovery::position(whole.elements()[e], block, q, x));
  }
  std::vector<double> at(const Positions& x) const {
    std::vector<double> rows(block.elements * block.points * table.columns);
    each(x, [&](int row, const auto& p) {
      for (int c = 0; c < table.columns; ++c) rows[row * table.columns + c] = value(c, p[up] > interface ? 0 : 1, p);
    });
    return rows;
  }
  PointTransfer transfer(const Positions& to, const std::vector<double>& old, std::vector<double>& now) const {
    return {{whole, block, start}, {whole, block, to}, patches, table.variables, table.columns, old, now};
  }
  int up;
  double width = 1;  // [m] of a mesh that is one metre high
  std::unique_ptr<Mesh> mesh;
  Space space;
  GhostedMesh whole;
  SoilBlock block;
  RecoveryPatches patches;
  Positions start;
  Soil soil;
  SoilTable table{0, 0, 6, 8, 9};
};

/// Positions with the inner nodes moved up and down; the boundary stays.
Positions swung(const Layers& layers, double size) {
  const double pi = std::acos(-1.0);
  Positions result = layers.start;
  for (Point& p : result)
    p[layers.up] += size * std::sin(pi * p[0] / layers.width) * std::sin(pi * p[layers.up]) *
                    (layers.up == 2 ? std::sin(pi * p[1] / layers.width) : 1.0);
  return result;
}

TEST(LayerRemap, FieldsThatAreLinearInEachLayerSurviveWhereverItsPointsGo) {
  // A width of 15 gives flat elements, as layers are meshed.
  for (const auto& [shape, width] :
       {std::pair{CellShape::tri6, 1.0}, std::pair{CellShape::quad9, 1.0}, std::pair{CellShape::tet10, 1.0},
        std::pair{CellShape::hex27, 1.0}, std::pair{CellShape::tri6, 15.0}, std::pair{CellShape::quad9, 15.0},
        std::pair{CellShape::tet10, 15.0}, std::pair{CellShape::hex27, 15.0}})
    for (double size : {0.05, -0.05}) {
      Layers layers(shape, 8, width);
      const Positions to = swung(layers, size);
      const std::vector<double> old = layers.at(layers.start);
      std::vector<double> now = old;
      const ConvectionRemap remap(ConvectionRemap::Scheme::upwind, false);
      const LayerChanges changes = LayerRemap(layers.soil, remap).transfer(layers.transfer(to, old, now), layers.table);
      EXPECT_GT(changes.changed, 5);
      EXPECT_EQ(changes.started, 0);
      EXPECT_EQ(changes.problem, "");
      layers.each(to, [&](int row, const auto& p) {
        const double* found = &now[row * layers.table.columns];
        const int material = static_cast<int>(found[layers.table.origin]);
        EXPECT_EQ(material, changes.is[row]);
        EXPECT_EQ(material, p[layers.up] > interface ? 0 : 1);
        for (int c = 0; c < layers.table.columns; ++c)
          EXPECT_NEAR(found[c], layers.value(c, material, p), 1e-11 * width)
              << c << " at " << p[0] << " " << p[layers.up];
      });
    }
}

/// Volumes of the grains of each layer by the shares of each point, computed independently of the code under test.
Vec<double, 2> grains_of(const Layers& layers, const std::vector<double>& rows, const Positions& x) {
  Vec<double, 2> sum{};
  for (int e : layers.whole.block_elements(0)) {
    const auto& nodes = layers.whole.elements()[e].nodes;
    const auto of = [&](int q) {
      return &rows[(layers.whole.first_row(e, layers.block.points) + q) * layers.table.columns];
    };
    double low = 1e300, high = -1e300;
    for (int q = 0; q < layers.block.points; ++q) low = std::min(low, of(q)[layers.table.origin + 2]);
    for (int q = 0; q < layers.block.points; ++q) high = std::max(high, of(q)[layers.table.origin + 2]);
    for (int q = 0; q < layers.block.points; ++q) {
      double j[4] = {0, 0, 0, 0};
      for (int a = 0; a < layers.block.u.nodes; ++a)
        for (int k = 0; k < 4; ++k) j[k] += x[nodes[a]][k / 2] * layers.block.u.dN(q, a, k % 2);
      const double volume = layers.block.u.weights(q) * (j[0] * j[3] - j[1] * j[2]),
                   solid = volume / (1 + of(q)[layers.table.void_ratio]),
                   upper = std::min(
                       1.0, std::max(0.0, 0.5 + (of(q)[layers.table.origin + 2] - interface) /
                                                    (1.4 * (high - low) / std::sqrt(1.0 * layers.block.points))));
      sum[0] += upper * solid;
      sum[1] += (1 - upper) * solid;
    }
  }
  return sum;
}

/// The loss by the shares of cut elements' points alone changes no void ratio, and is reported.
TEST(LayerRemap, TheGrainsOfALayerComeBackToTheLastDigitsAndNoneForAPointThatJumps) {
  const Layers layers(CellShape::tri6, 8);
  std::vector<double> old = layers.at(layers.start);
  for (double size : {0.001, 0.01, 0.05}) {
    const Positions to = swung(layers, size);
    std::vector<double> now = old;
    const PointTransfer transfer = layers.transfer(to, old, now);
    const LayerChanges changes = LayerRemap(layers.soil, ConvectionRemap()).transfer(transfer, layers.table);
    const auto before = grains_of(layers, old, layers.start), transferred = grains_of(layers, now, to);
    const std::vector<double> unrestored = now;
    const auto restored =
        restore_grains(transfer, layers.soil, layers.table.void_ratio, layers.table.origin, changes.ratios);
    const auto after = grains_of(layers, now, to);
    ASSERT_EQ(restored.size(), 2u);
    for (int k : {0, 1}) {
      EXPECT_NEAR(restored[k].before, before[k], 1e-14);
      EXPECT_NEAR((after[k] + restored[k].unresolved) / before[k], 1, 1e-14);
      // The bound is the content of a row of the cut elements' points: 0.0625 (1/1.6 - 1/2.4).
      EXPECT_LT(std::abs(restored[k].unresolved), 0.5 * 0.0625 * 0.21);
    }
    EXPECT_LT(std::abs(before[0] - transferred[0]), 0.02 * before[0]);
    EXPECT_GT(std::abs(restored[0].unresolved), size > 0.02 ? 1e-5 : 0.0);
    EXPECT_LT(std::abs(restored[0].missing), 1e-3 * before[0]);
    EXPECT_GT(changes.changed, size > 0.02 ? 5 : -1);
    double most = 0;
    for (std::size_t row = 0; row < now.size() / layers.table.columns; ++row)
      most = std::max(most, std::abs(now[row * layers.table.columns + layers.table.void_ratio] -
                                     unrestored[row * layers.table.columns + layers.table.void_ratio]));
    EXPECT_LT(most, 2e-3 * 2.4);  // the transfer's own loss
  }
}

/// The layers are upside down at first, so that points become a material that is nowhere near. The law starts from the
/// place of the soil at the start, and reports where it cannot.
TEST(LayerRemap, ALawStartsAnewWhereNoSoilOfItsMaterialIsNear) {
  Layers layers(CellShape::tri6, 8);
  std::vector<double> old = layers.at(layers.start);
  layers.each(layers.start, [&](int row, const auto& p) {
    old[row * layers.table.columns + layers.table.origin] = p[1] > 1 - interface ? 1 : 0;
    old[row * layers.table.columns + layers.table.void_ratio] = 1.5;
  });
  std::vector<double> now = old;
  const Positions to = swung(layers, 0.01);
  const ConvectionRemap convection;
  const LayerRemap remap(layers.soil, convection);
  LayerChanges changes = remap.transfer(layers.transfer(to, old, now), layers.table);
  EXPECT_GT(changes.started, 100);
  EXPECT_GT(changes.changed, changes.started);
  int far = 0;
  layers.each(to, [&](int row, const auto& p) {
    if (changes.is[row] != 1 || p[1] > 0.2) return;
    ++far;
    EXPECT_NEAR(now[row * layers.table.columns + layers.table.law], p[1], 1e-12);
  });
  EXPECT_GT(far, 20);
  for (std::size_t row = 0; row < old.size(); row += layers.table.columns) old[row + layers.table.void_ratio] = 6;
  now = old;
  changes = remap.transfer(layers.transfer(to, old, now), layers.table);
  EXPECT_NE(changes.problem.find("the law of material 'lower'"), std::string::npos) << changes.problem;
  EXPECT_NE(changes.problem.find("too loose"), std::string::npos) << changes.problem;
}

}  // namespace
}  // namespace mudline
