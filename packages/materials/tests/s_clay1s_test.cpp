// Natural clay: without parts it is Modified Cam Clay, the parts start and turn as published, and contradictory numbers
// are refused. Paths against another integration of the equations: tests/verification/strength/test_s_clay1s.py.
#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "materials/conformance/sampler.hpp"
#include "materials/register_materials.hpp"
#include "point_driver.hpp"

namespace mudline {
namespace {

Teuchos::ParameterList clay(const std::string& type = "s-clay1s") {
  Teuchos::ParameterList list;
  list.set("type", type).set("critical stress ratio", 1.2).set("compression slope", 0.3).set("swelling slope", 0.03);
  list.set("Poisson's ratio", 0.2);
  return list;
}

std::shared_ptr<Skeleton> create(Teuchos::ParameterList& list) {
  Registry<Skeleton> skeletons("skeleton");
  Registry<Fluid> fluids("fluid");
  Registry<Permeability> permeabilities("permeability");
  register_materials(skeletons, fluids, permeabilities);
  return skeletons.create(Section(list, std::make_shared<Sources>(), std::make_shared<FunctionLibrary>(), ""));
}

std::string refusal(Teuchos::ParameterList list) {
  try {
    create(list);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SClay1s, WithoutPartsItIsCamClayBitForBit) {
  for (const char* lode : {"none", "sheng"}) {
    Teuchos::ParameterList a = clay("modified cam clay"), b = clay();
    for (auto* list : {&a, &b}) list->set("lode dependence", lode).set("normal compression volume", 4.0);
    const auto cam = create(a), natural = create(b);
    Sampler sample(*cam, 11, false);
    for (int n = 0; n < 100; ++n) {
      const InitialPoint start = sample.point();
      const MaterialPoint one(*cam, start), other(*natural, start);
      PointMotion motion;
      motion.strain = sample.increment(1e-6, 2e-2);
      const PointTrial x = one.evaluate(motion, 1.0, true), y = other.evaluate(motion, 1.0, true);
      EXPECT_EQ(x.stress, y.stress);
      EXPECT_EQ(x.tangent, y.tangent);
      EXPECT_TRUE(std::equal(x.state.begin(), x.state.end(), y.state.begin()));
      EXPECT_EQ(cam->k0(start), natural->k0(start));
      EXPECT_EQ(cam->void_ratio(start), natural->void_ratio(start));
    }
  }
}

/// A part that has no effect makes the general equations those of Modified Cam Clay.
TEST(SClay1s, TheGeneralEquationsHoldCamClay) {
  Teuchos::ParameterList a = clay("modified cam clay"), b = clay();
  b.set("initial bonding", 1e-13);
  for (auto* list : {&a, &b}) list->set("lode dependence", "sheng").set("stress tolerance", 1e-8);
  const auto cam = create(a), natural = create(b);
  for (const double axial : {0.1, -0.1}) {
    PointDriver one(*cam, isotropic_stress(1e5), 1.5, 1.5), other(*natural, isotropic_stress(1e5), 1.5, 1.5);
    compress(one, Path::undrained, axial, 100);
    compress(other, Path::undrained, axial, 100);
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(one.stress()[c], other.stress()[c], 1e-7 * 1e5);
  }
}

/// M = 1.2: sin phi = 0.5, K0 = 0.5, eta0 = 0.75, so the inclination is (0.5625 + 2.25 - 1.44)/3 = 0.4575.
TEST(SClay1s, StartsWithTheFabricOfVirginCompression) {
  Teuchos::ParameterList by_stress = clay(), by_axis = clay();
  by_stress.set("fabric rotation rate", 30.0);
  by_axis.set("fabric rotation rate", 30.0).set("fabric axis", "y");
  const std::array<double, 6> at_rest{-5e4, -1e5, -5e4, 0.0, 0.0, 0.0};
  for (Teuchos::ParameterList* list : {&by_stress, &by_axis}) {
    const auto law = create(*list);
    EXPECT_NEAR(law->k0({}), 0.5, 1e-12);
    PointDriver point(*law, at_rest, 1.8);
    const double expected[6] = {0.1525, -0.305, 0.1525, 0.0, 0.0, 0.0};
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(point.state()[4 + c], expected[c], 1e-12);
    const SoilState state = law->soil_state(at_rest.data(), 1.8, point.state().data());
    EXPECT_NEAR(*state.overconsolidation_ratio, 1.0, 1e-12);
    EXPECT_FALSE(state.undrained_strength);
  }
  std::vector<double> state(create(by_stress)->state_size());
  InitialPoint isotropic{};
  isotropic.stress = isotropic_stress(1e5);
  isotropic.void_ratio = 1.8;
  EXPECT_NE(create(by_stress)->initialise(isotropic, state.data()).find("give 'fabric axis'"), std::string::npos);
  EXPECT_EQ(create(by_axis)->initialise(isotropic, state.data()), "");
}

/// The surface through the stress is that of bonded clay, the state of the remoulded one within it.
TEST(SClay1s, BondingAndVoidRatioAtTheStart) {
  Teuchos::ParameterList list = clay();
  list.set("fabric rotation rate", 30.0).set("initial bonding", 4.0).set("normal compression volume", 4.0);
  const auto law = create(list);
  InitialPoint point{};
  point.stress = {-5e4, -1e5, -5e4, 0.0, 0.0, 0.0};
  point.overconsolidation_ratio = 1.6;
  point.void_ratio = law->void_ratio(point);
  // p' = 2/3 1e5, q = 5e4; F = p' + (q - 0.4575 p')^2/((1.44 - 0.4575^2) p')
  const double p = 2e5 / 3.0, over = 5e4 - 0.4575 * p, size = p + over * over / ((1.44 - 0.4575 * 0.4575) * p);
  const double remoulded = 1.6 * size / 5.0;
  EXPECT_NEAR(1.0 + point.void_ratio, 4.0 - 0.3 * std::log(remoulded / 1e3) + 0.03 * std::log(remoulded / p), 1e-12);
  std::vector<double> state(law->state_size());
  EXPECT_EQ(law->initialise(point, state.data()), "");
  EXPECT_NEAR(state[0], remoulded, 1e-6 * remoulded);
  EXPECT_EQ(state[3], 4.0);
}

TEST(SClay1s, CreepNeedsTime) {
  Teuchos::ParameterList list = clay();
  list.set("creep slope", 0.006);
  const auto law = create(list);
  InitialPoint start;
  start.stress = isotropic_stress(1e5);
  start.void_ratio = 1.5;
  const MaterialPoint point(*law, start);
  const PointTrial still = point.evaluate({}, 0.0, false), day = point.evaluate({}, 86400.0, false),
                   later = point.evaluate({}, 864000.0, false);
  EXPECT_EQ(still.stress, point.stress());
  EXPECT_GT(day.stress[0], -1e5);  // it relaxes
  EXPECT_GT(later.stress[0], day.stress[0]);
}

TEST(SClay1s, RefusesNumbersThatPlayNoRole) {
  EXPECT_EQ(refusal(clay()), "");
  const auto with = [](const std::string& name, double value) {
    Teuchos::ParameterList list = clay();
    list.set(name, value);
    return list;
  };
  for (const auto& [name, part] :
       std::vector<std::pair<std::string, std::string>>{{"fabric shear weight", "fabric rotation rate"},
                                                        {"initial inclination", "fabric rotation rate"},
                                                        {"bond degradation rate", "initial bonding"},
                                                        {"bond shear weight", "initial bonding"},
                                                        {"reference time", "creep slope"}})
    EXPECT_NE(refusal(with(name, 0.5)).find("plays no role without '" + part + "'"), std::string::npos) << name;
  Teuchos::ParameterList leaning = with("fabric rotation rate", 20.0), casm = with("creep slope", 0.006),
                         line = with("creep slope", 0.006), weak = with("fabric rotation rate", 20.0);
  leaning.set("initial inclination", 1.19);
  casm.set("spacing ratio", 2.5);
  line.set("integration", "implicit");
  weak.set("critical stress ratio", 0.5);
  EXPECT_NE(refusal(leaning).find("leans too far; allowed: below 1.169"), std::string::npos);
  EXPECT_NE(refusal(casm).find("CASM"), std::string::npos);
  EXPECT_NE(refusal(line).find("there is no yield surface"), std::string::npos);
  EXPECT_NE(refusal(weak).find("fabric shear weight"), std::string::npos);
  EXPECT_NE(refusal(with("creep slope", 0.3)).find("below the compression slope"), std::string::npos);
}

}  // namespace
}  // namespace mudline
