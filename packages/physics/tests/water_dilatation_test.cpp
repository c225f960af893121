// The volume strain that laws of saturated soil see, against its definition.
#include "physics/biot/water_dilatation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "framework/element_loop.hpp"
#include "physics/inventory.hpp"
#include "soil_model.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

const std::string by_water = text_parameter("volume strain", "water balance");

/// Moves the nodes of the trial state by a displacement.
template <class F>
void move(SoilModel& model, F&& displacement) {
  model.set_motion(model.store->trial().value, displacement);
  for (int node = 0; node < model.mesh->num_nodes(); ++node)
    for (int i = 0; i < 2; ++i)
      model.store->trial().coordinates(node, i) = model.x(node, i) + model.store->trial().value(model.u(node, i));
}

/// Sum over all points of volume times what the law sees beyond the motion times a function of the place, and of the
/// sizes of its terms. The places are those in the middle of the step.
template <class F>
Vec<double, 2> moment(SoilModel& model, const PointView& beyond, F&& weight) {
  const SoilBlock& b = model.soil->blocks[0];
  Vec<double, 2> sum{};
  const CoordinateView middle("middle", model.mesh->num_nodes(), 2);
  for (int node = 0; node < model.mesh->num_nodes(); ++node)
    for (int i = 0; i < 2; ++i) middle(node, i) = 0.5 * (model.view.x_old(node, i) + model.view.x_end(node, i));
  const LoopLevel level = loop_level(model.view, {0.5, middle, 0.5}, b);
  with_element<1>(model.soil->geometry, b, [&](auto coordinates, auto shapes) {
    using Loop = ElementLoop<decltype(coordinates), decltype(shapes)>;
    const Loop loop{b, level};
    for (int e = 0; e < b.elements; ++e)
      loop.template for_each_point<false, false>(
          e, [&](int q, const typename Loop::Shape& s, const typename Loop::Fields&) {
            const Point at = b.place(e, q, middle);
            const double part = s.dv * beyond(e * b.points + q, 0) * weight(at[0], at[1]);
            sum[0] += part;
            sum[1] += std::abs(part);
          });
  });
  return sum;
}

TEST(WaterDilatation, AVolumeStrainOfThePressuresShapesStays) {
  for (const char* geometry : {"plane strain", "axisymmetric"}) {
    SoilModel model("", by_water, SoilModel::box(geometry));
    model.view.dt = 1e-9;  // nothing drains
    move(model, [&](double x, double y) {
      return model.soil->geometry == Geometry::plane_strain ? Vec<double, 2>{1e-7 * x * x, -3e-7 * y * x}
                                                            : Vec<double, 2>{1e-7 * x, -3e-7 * y * y};
    });
    const PointView beyond = WaterDilatation(*model.soil).find(model.view)[0];
    for (std::size_t i = 0; i < beyond.extent(0); ++i) EXPECT_NEAR(beyond(i, 0), 0, 1e-13) << geometry;
  }
}

TEST(WaterDilatation, WhatItTakesHasNoMomentWithThePressuresShapes) {
  SoilModel model("", by_water);
  model.view.dt = 1e-9;
  // small, so that volumes of the start, the middle and the end are the same: the masses of grains stay exactly
  move(model, [](double x, double y) { return Vec<double, 2>{2e-7 * std::sin(9 * x + y), 1e-7 * std::cos(5 * y)}; });
  const PointView beyond = WaterDilatation(*model.soil).find(model.view)[0];
  const auto one = [](double, double) { return 1.0; };
  const Vec<double, 2> all = moment(model, beyond, one);
  EXPECT_GT(all[1], 1e-7);
  EXPECT_NEAR(all[0], 0, 1e-5 * all[1]);
  for (const double x : {1.0, 2.0, 3.0}) {  // cells are squares of 1 m: a hat along x, all along y
    const auto hat = [x](double at, double) { return std::max(0.0, 1 - std::abs(at - x)); };
    const Vec<double, 2> one_node = moment(model, beyond, hat);
    EXPECT_NEAR(one_node[0], 0, 1e-5 * one_node[1]) << x;
  }
}

TEST(WaterDilatation, TheGrainsOfEveryMaterialStay) {
  // two layers, whose interface crosses cells; the void ratio of the trial state is one of the motion
  const std::string layers =
      SoilModel::sand("", "", "upper") + SoilModel::sand(number_parameter("top", 1.4), "", "lower");
  SoilModel model("", by_water, SoilModel::box("axisymmetric"), layers);
  model.view.dt = 1e-9;
  move(model, [](double x, double y) { return Vec<double, 2>{2e-2 * std::sin(9 * x + y), 1e-2 * std::cos(5 * y)}; });
  const SoilBlock& b = model.soil->blocks[0];
  const PointView void_ratio = model.store->trial().arrays[b.void_ratio];
  for (std::size_t i = 0; i < void_ratio.extent(0); ++i) void_ratio(i, 0) = 0.6 + 0.1 * std::sin(3.0 * i);
  const auto masses = [&] {
    State state = model.store->trial();
    return take_inventory(*model.soil, state).grains;
  };
  const std::vector<double> before = masses();
  const PointView beyond = WaterDilatation(*model.soil).find(model.view)[0];
  double largest = 0;
  for (std::size_t i = 0; i < void_ratio.extent(0); ++i) {
    largest = std::max(largest, std::abs(beyond(i, 0)));
    void_ratio(i, 0) = (1 + void_ratio(i, 0)) * std::exp(beyond(i, 0)) - 1;
  }
  EXPECT_GT(largest, 1e-2);
  const std::vector<double> after = masses();
  for (int k = 0; k < 2; ++k) EXPECT_NEAR(after[k] / before[k], 1, 1e-14) << k;
}

TEST(WaterDilatation, SoilThatDrainsWithinTheStepSeesItsMotion) {
  // nodes of a cell 1 m x 1 m: w = dt C/(dt C + V), C/V between 2 and 12 c_v/m2, c_v = 12 MPa 1e-8 m2/(Pa s)
  double before = 0;
  for (const double dt : {1e-9, 1.0, 1e9}) {
    SoilModel model("", by_water);
    model.view.dt = dt;
    move(model, [](double x, double y) { return Vec<double, 2>{2e-3 * std::sin(9 * x + y), 0}; });
    const PointView beyond = WaterDilatation(*model.soil).find(model.view)[0];
    const double size = moment(model, beyond, [](double, double) { return 1.0; })[1];
    if (dt == 1e-9) before = size;
    if (dt == 1.0) {  // c_v dt = 0.12 m2
      EXPECT_LT(size, before / (1 + 2 * 0.12));
      EXPECT_GT(size, before / (1 + 12 * 0.12));
    }
    if (dt == 1e9) {
      EXPECT_LT(size, 1e-7 * before);
    }
  }
}

TEST(WaterDilatation, IsForTheLawsThatTheDeckSays) {
  EXPECT_FALSE(SoilModel().soil->blocks[0].sees_water);
  EXPECT_TRUE(SoilModel("", by_water).soil->blocks[0].sees_water);
  const std::string clay = section_xml(
      "sand",
      number_parameter("void ratio", 1) + number_parameter("grain density", 2600) +
          section_xml("skeleton",
                      text_parameter("type", "modified cam clay") + number_parameter("critical stress ratio", 1) +
                          number_parameter("compression slope", 0.2) + number_parameter("swelling slope", 0.04) +
                          number_parameter("Poisson's ratio", 0.3)) +
          section_xml("fluid", text_parameter("type", "water")) +
          section_xml("permeability",
                      text_parameter("type", "constant") + number_parameter("hydraulic conductivity", 1e-9)));
  const std::string start = section_xml(
      "initial state", text_parameter("type", "uniform") + number_parameter("effective stress xx", 5e4) +
                           number_parameter("effective stress yy", 5e4) + number_parameter("effective stress zz", 5e4));
  EXPECT_FALSE(SoilModel("", start, SoilModel::box("plane strain"), clay).soil->blocks[0].sees_water);
  const std::string hardening = text_parameter("volume strain", "hardening");
  EXPECT_TRUE(SoilModel("", start + hardening, SoilModel::box("plane strain"), clay).soil->blocks[0].sees_water);
  EXPECT_FALSE(SoilModel("", hardening).soil->blocks[0].sees_water);
}

}  // namespace
}  // namespace mudline
