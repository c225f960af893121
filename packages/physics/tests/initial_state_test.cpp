// Stresses and pore pressures at the start against their definitions, point by point.
#include "physics/initial_state.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/tests/input_error.hpp"
#include "soil_model.hpp"

namespace mudline {
namespace {

const std::string gravity = array_parameter("gravity", "0, -10");

std::string start(const std::string& parameters) { return section_xml("initial state", parameters); }

/// Calls f(stress, y) for all points of all blocks; stress xx yy zz yz xz xy, tension positive.
template <class F>
void for_each_point(SoilModel& model, F&& f) {
  const State& state = model.store->committed();
  for (const SoilBlock& b : model.soil->blocks)
    for (int e = 0; e < b.elements; ++e)
      for (int q = 0; q < b.points; ++q) {
        double y = 0;
        for (int a = 0; a < b.u.nodes; ++a) y += b.u.N(q, a) * state.coordinates(b.nodes(e, a), 1);
        f(&state.arrays[b.stress](e * b.points + q, 0), y);
      }
}

TEST(InitialState, UniformStressesAreCompressionPositiveInTheDeck) {
  SoilModel model("", start(text_parameter("type", "uniform") + number_parameter("effective stress xx", 1) +
                            number_parameter("effective stress yy", 2) + number_parameter("effective stress zz", 3) +
                            number_parameter("shear stress xy", 4) + number_parameter("pore pressure", 5)));
  int points = 0;
  for_each_point(model, [&](const double* s, double) {
    ++points;
    const double expected[6] = {-1, -2, -3, 0, 0, -4};
    for (int c = 0; c < 6; ++c) EXPECT_EQ(s[c], expected[c]);
  });
  EXPECT_EQ(points, 6 * 9);
  for (int node = 0; node < model.mesh->num_nodes(); ++node)
    if (model.p(node) >= 0) {
      EXPECT_EQ(model.store->committed().value(model.p(node)), 5);
    }
}

TEST(InitialState, StressFreeIsTheDefault) {
  SoilModel model("", gravity);
  for_each_point(model, [](const double* s, double) {
    for (int c = 0; c < 6; ++c) EXPECT_EQ(s[c], 0);
  });
}

/// In a centrifuge stresses and pore pressures are those of the gravity at t = 0.
TEST(InitialState, GeostaticStressesAreThoseOfTheGravityAtTheStart) {
  SoilModel model("", gravity + text_parameter("gravity factor", "50 + t") +
                          start(text_parameter("type", "geostatic") + number_parameter("surcharge", 500) +
                                number_parameter("water level", 2) + number_parameter("K0", 0.75)));
  for_each_point(model, [](const double* s, double y) {
    EXPECT_NEAR(s[1], -(500 + 50 * (19600 * (3 - y) - 1e4 * (2 - y))), 1e-6);
  });
  for (int node = 0; node < model.mesh->num_nodes(); ++node)
    if (model.p(node) >= 0) {
      EXPECT_NEAR(model.store->committed().value(model.p(node)), 5e5 * (2 - model.x(node, 1)), 1e-6);
    }
}

/// gamma = 10 (0.6 2600 + 0.4 1000) = 19.6 kPa/m above and below the water, which is at y = 2 of 3 m.
TEST(InitialState, GeostaticStressesAreThoseOfTheWeightLessTheWaterPressure) {
  SoilModel model("", gravity + start(text_parameter("type", "geostatic") + number_parameter("surcharge", 500) +
                                      number_parameter("water level", 2) + number_parameter("K0", 0.75)));
  for_each_point(model, [](const double* s, double y) {
    const double vertical = 500 + 19600 * (3 - y) - 1e4 * (2 - y);
    EXPECT_NEAR(s[1], -vertical, 1e-8);
    EXPECT_NEAR(s[0], -0.75 * vertical, 1e-8);
    EXPECT_EQ(s[0], s[2]);
    EXPECT_EQ(s[5], 0);
  });
  for (int node = 0; node < model.mesh->num_nodes(); ++node)
    if (model.p(node) >= 0) {
      EXPECT_NEAR(model.store->committed().value(model.p(node)), 1e4 * (2 - model.x(node, 1)), 1e-9);
    }
}

TEST(InitialState, WaterAboveTheSurfaceWeighsOnTheTotalStress) {
  SoilModel model("", gravity + start(text_parameter("type", "geostatic") + number_parameter("water level", 8) +
                                      number_parameter("K0", 0.5)));
  for_each_point(model, [](const double* s, double y) { EXPECT_NEAR(s[1], -9600 * (3 - y), 1e-8); });
}

TEST(InitialState, TheBiotCoefficientScalesTheWaterPressure) {
  SoilModel model("",
                  gravity + start(text_parameter("type", "geostatic") + number_parameter("water level", 3) +
                                  number_parameter("K0", 0.5)),
                  SoilModel::box("plane strain"), SoilModel::sand(number_parameter("Biot coefficient", 0.8)));
  for_each_point(model, [](const double* s, double y) { EXPECT_NEAR(s[1], -(19600 - 8000) * (3 - y), 1e-8); });
}

TEST(InitialState, ExcessPressuresLeaveTheWeightUnderWater) {
  SoilModel model("", gravity + text_parameter("pore pressure", "excess") +
                          start(text_parameter("type", "geostatic") + number_parameter("K0", 0.5)));
  for_each_point(model, [](const double* s, double y) { EXPECT_NEAR(s[1], -9600 * (3 - y), 1e-8); });
  for (int node = 0; node < model.mesh->num_nodes(); ++node)
    if (model.p(node) >= 0) {
      EXPECT_EQ(model.store->committed().value(model.p(node)), 0);
    }
}

/// Sand with grains of 2600 kg/m3 over lighter soil of 2000 kg/m3; the interface y = 1.37 is no mesh line. Every point
/// has the weight of the soil above it.
TEST(InitialState, LayersThatAreNoMeshRegionsWeighAndStandPointByPoint) {
  std::string lower = SoilModel::sand(number_parameter("top", 1.37), "", "soil");
  lower.replace(lower.find("2600"), 4, "2000");
  SoilModel model("", gravity + start(text_parameter("type", "geostatic") + number_parameter("K0", 0.5)),
                  SoilModel::box("plane strain"), SoilModel::sand("") + lower);
  ASSERT_TRUE(model.soil->layered());
  const State& state = model.store->committed();
  int points[2] = {0, 0};
  for (const SoilBlock& b : model.soil->blocks)
    for (int row = 0; row < b.elements * b.points; ++row) {
      const double x = state.arrays[b.origin](row, 1), y = state.arrays[b.origin](row, 2);
      const Point place = b.place(row / b.points, row % b.points, state.coordinates);
      EXPECT_EQ(x, place[0]);
      EXPECT_EQ(y, place[1]);
      const int material = static_cast<int>(model.soil->which(b, state)(row, 0));
      EXPECT_EQ(model.soil->materials[material]->name, y > 1.37 ? "sand" : "soil");
      ++points[material];
      const double vertical = 19600 * (3 - std::max(y, 1.37)) + 16000 * std::max(0.0, 1.37 - y);
      EXPECT_NEAR(state.arrays[b.stress](row, 1), -vertical, 1e-8);
      EXPECT_NEAR(state.arrays[b.stress](row, 0), -0.5 * vertical, 1e-8);
    }
  EXPECT_EQ(points[0] + points[1], 6 * 9);
  EXPECT_EQ(points[0], 2 * 3 * 5);  // rows above 1.37: three of the upper elements, two of the middle ones
}

/// A top that varies with position makes an inclined interface; soil above all tops is refused.
TEST(InitialState, TopsAreFunctionsOfThePlaceAndMustCoverTheSoil) {
  SoilModel model("", "", SoilModel::box("plane strain"),
                  SoilModel::sand("") + SoilModel::sand(text_parameter("top", "0.5 + 0.5*x"), "", "soil"));
  const State& state = model.store->committed();
  for (const SoilBlock& b : model.soil->blocks)
    for (int row = 0; row < b.elements * b.points; ++row) {
      const double x = state.arrays[b.origin](row, 1), y = state.arrays[b.origin](row, 2);
      EXPECT_EQ(model.soil->which(b, state)(row, 0), y > 0.5 + 0.5 * x ? 0 : 1);
    }
  const auto with_tops = [](const std::string& upper, const std::string& lower, const std::string& fluid = "") {
    return SoilModel::sand(upper) + SoilModel::sand(lower, fluid, "soil");
  };
  const auto refused = [&](const std::string& materials, const std::string& physics = "") {
    return input_error([&] { SoilModel("", physics, SoilModel::box("plane strain"), materials); });
  };
  EXPECT_NE(refused(with_tops(number_parameter("top", 2.8), number_parameter("top", 1))).find("no material at"),
            std::string::npos);
  EXPECT_NE(refused(with_tops("", number_parameter("top", -1))).find("no soil is made of 'soil'"), std::string::npos);
  EXPECT_NE(refused(with_tops(number_parameter("top", 4), number_parameter("top", 4))).find("have the same top"),
            std::string::npos);
  EXPECT_NE(refused(with_tops("", "")).find("all but the uppermost one need a 'top'"), std::string::npos);
  EXPECT_NE(refused(with_tops("", number_parameter("top", 1), number_parameter("density", 1025)))
                .find("different pore fluids"),
            std::string::npos);
  EXPECT_NE(refused(with_tops("", text_parameter("top", "0.5 + 0.5*x")),
                    gravity + start(text_parameter("type", "geostatic") + number_parameter("K0", 0.5)))
                .find("varies with the place"),
            std::string::npos);
}

TEST(InitialState, K0ComesFromTheLawOrFromTheFrictionAngleAndOverconsolidation) {
  const std::string geostatic = text_parameter("type", "geostatic") + number_parameter("surcharge", 1000);
  const auto ratio = [&](const std::string& more, auto&& expected) {
    SoilModel model("", gravity + start(geostatic + more));
    for_each_point(model, [&](const double* s, double y) { EXPECT_NEAR(s[0] / s[1], expected(-s[1], y), 1e-12); });
  };
  ratio("", [](double, double) { return 0.25 / 0.75; });
  const double sine = 0.5;
  ratio(number_parameter("K0 friction angle [deg]", 30), [&](double, double) { return 1 - sine; });
  ratio(number_parameter("K0 friction angle [deg]", 30) + text_parameter("overconsolidation ratio", "1 + y"),
        [&](double, double y) { return (1 - sine) * std::pow(1 + y, sine); });
  ratio(number_parameter("K0 friction angle [deg]", 30) + number_parameter("preoverburden pressure", 4000),
        [&](double vertical, double) { return (1 - sine) * std::pow(1 + 4000 / vertical, sine); });
  ratio(text_parameter("K0", "0.5 + 0.1*y"), [](double, double y) { return 0.5 + 0.1 * y; });
}

TEST(InitialState, ContradictionsAreNamed) {
  const auto has = [](const std::string& physics, const std::string& part) {
    const std::string message = input_error([&] { SoilModel model("", physics); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  const std::string geostatic = text_parameter("type", "geostatic");
  has(start(geostatic), "a geostatic start needs gravity: give");
  has(gravity + start(geostatic + number_parameter("K0", 0.5) + number_parameter("K0 friction angle [deg]", 30)),
      "give either this or 'K0', not both");
  has(gravity + start(geostatic + number_parameter("overconsolidation ratio", 2) +
                      number_parameter("preoverburden pressure", 1)),
      "give either this or 'overconsolidation ratio', not both");
  has(start(text_parameter("type", "uniform") + number_parameter("preoverburden pressure", 1)),
      "preoverburden pressure: has a meaning only with 'type' = geostatic");
  has(gravity + start(geostatic + number_parameter("K0 friction angle [deg]", 95)),
      "K0 friction angle [deg]: 95 is out of range; allowed: [0, 90)");
  has(gravity + text_parameter("pore pressure", "excess") + start(geostatic + number_parameter("water level", 1)),
      "its level has no effect");
  for (const char* entry : {"K0", "surcharge", "water level"})
    has(start(text_parameter("type", "uniform") + number_parameter(entry, 1)),
        std::string(entry) + ": has a meaning only with 'type' = geostatic");
  has(start(number_parameter("overconsolidation ratio", 2)),
      "overconsolidation ratio: has a meaning only with 'type' = uniform, geostatic or by law");
  for (const char* entry : {"effective stress yy", "pore pressure"})
    has(gravity + start(geostatic + number_parameter(entry, 1)), std::string(entry) + ": has a meaning only with");
  for (const char* entry : {"K0", "overconsolidation ratio", "preoverburden pressure", "undrained strength"})
    has(gravity + start(geostatic + text_parameter(entry, "1 + t")),
        std::string(entry) + ": '1 + t' depends on the time; this number may depend on the place only");
}

}  // namespace
}  // namespace mudline
