// Linear elasticity, permeability laws, water, and entries that registration refuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "materials/register_materials.hpp"
#include "point_driver.hpp"

namespace mudline {
namespace {

Section section(Teuchos::ParameterList& list) {
  return Section(list, std::make_shared<Sources>(), std::make_shared<FunctionLibrary>(), "");
}

struct Registries {
  Registry<Skeleton> skeletons{"skeleton"};
  Registry<Fluid> fluids{"fluid"};
  Registry<Permeability> permeabilities{"permeability"};
  Registries() { register_materials(skeletons, fluids, permeabilities); }
};

TEST(LinearElastic, StressAddsToTheInitialStress) {
  Teuchos::ParameterList list;
  list.set("type", "linear elastic");
  list.set("Young's modulus", 1e7);
  list.set("Poisson's ratio", 0.25);
  const auto law = Registries().skeletons.create(section(list));
  PointDriver point(*law, {-5e4, -1e5, -5e4, 0, 0, 2e3}, 0.8);
  compress(point, Path::drained, 1e-3, 1);
  EXPECT_NEAR(point.stress()[1], -1e5 - 1e4, 1e-6);
  EXPECT_NEAR(point.stress()[0], -5e4, 1e-4);
  EXPECT_NEAR(point.strain()[0], 0.25e-3, 1e-12);
  point.step({0, 0, 0, 0, 0, 1e-3});
  EXPECT_NEAR(point.stress()[5], 2e3 + 4e3, 1e-6);
  EXPECT_NEAR(law->k0({}), 1.0 / 3.0, 1e-15);
}

TEST(PlaneTangent, IsThatOfTheWholeLaw) {
  const std::array<double, 6> stress{-6e4, -1e5, -7e4, 0, 0, 1e4}, increment{4e-3, -9e-3, 1e-3, 0, 0, 5e-3};
  Teuchos::ParameterList clay, sand, soft, metal;
  clay.set("type", "modified cam clay").set("critical stress ratio", 1.0).set("compression slope", 0.2);
  clay.set("swelling slope", 0.04).set("Poisson's ratio", 0.3).set("lode dependence", "sheng");
  sand.set("type", "mohr-coulomb").set("Young's modulus", 1e7).set("Poisson's ratio", 0.25);
  sand.set("friction angle [deg]", 30.0).set("cohesion", 5e3);
  soft.set("type", "tresca").set("rigidity index", 100.0).set("Poisson's ratio", 0.49).set("undrained strength", 3e4);
  metal.set("type", "von mises").set("Young's modulus", 1e7).set("Poisson's ratio", 0.25).set("yield stress", 6e4);
  for (Teuchos::ParameterList* list : {&clay, &sand, &soft, &metal}) {
    const auto law = Registries().skeletons.create(section(*list));
    const PointDriver point(*law, stress, 0.9);
    std::array<double, 6> whole_stress{}, plane_stress{};
    std::array<double, 36> whole{}, plane{};
    std::vector<double> state;
    ASSERT_TRUE(point.evaluate(increment, whole_stress, state, &whole));
    ASSERT_TRUE(point.evaluate(increment, plane_stress, state, &plane, true));
    EXPECT_EQ(whole_stress, plane_stress);
    EXPECT_NE(whole[0], 0);
    EXPECT_NE(whole[6 * 4 + 4], 0);
    EXPECT_NE(whole, plane) << "the plane tangent has no shear out of the plane";
    for (const int i : {0, 1, 2, 5})
      for (const int j : {0, 1, 2, 5}) EXPECT_EQ(whole[6 * i + j], plane[6 * i + j]) << i << " " << j;
  }
}

TEST(StrengthProfile, GrowsBelowTheReferenceElevation) {
  Teuchos::ParameterList sand, clay;
  sand.set("type", "mohr-coulomb").set("Young's modulus", 1e7).set("Poisson's ratio", 0.25);
  sand.set("friction angle [deg]", 30.0).set("cohesion", 5e3).set("cohesion gradient", 2e3);
  clay.set("type", "tresca").set("rigidity index", 100.0).set("Poisson's ratio", 0.49);
  clay.set("undrained strength", 5e3).set("undrained strength gradient", 2e3);
  for (Teuchos::ParameterList* list : {&sand, &clay}) {
    list->set("reference elevation", 3.0);
    const auto law = Registries().skeletons.create(section(*list));
    for (const double y : {5.0, 3.0, -1.0}) {
      std::vector<double> state(law->state_size());
      EXPECT_EQ(law->initialise({{0, 7, -y}, {-1e5, -1e5, -1e5, 0, 0, 0}, 0.8, 1.0, y}, state.data()), "");
      EXPECT_EQ(std::count(state.begin(), state.end(), 5e3 + 2e3 * std::max(0.0, 3.0 - y)), 1) << y;
    }
  }
}

std::unique_ptr<Permeability> permeability(const std::string& type, double index = 0.0, double reference = 0.0) {
  Teuchos::ParameterList list;
  list.set("type", type);
  list.set("hydraulic conductivity", 2e-8);
  if (index > 0.0) list.set("permeability index", index);
  if (reference > 0.0) list.set("reference void ratio", reference);
  return Registries().permeabilities.create(section(list));
}

TEST(Permeability, DerivativesAgreeWithDifferences) {
  for (const auto& law : {permeability("constant"), permeability("kozeny-carman"), permeability("log-linear", 0.4)})
    for (const double e : {0.3, 0.9, 2.5}) {
      const double h = 1e-5;
      const double slope = (law->conductivity(e + h, 1.1).k - law->conductivity(e - h, 1.1).k) / (2 * h);
      EXPECT_NEAR(law->conductivity(e, 1.1).dk_de, slope, 1e-8 * std::abs(slope));
    }
}

TEST(Permeability, ReferenceValueAppliesAtTheReferenceVoidRatio) {
  for (const char* type : {"kozeny-carman", "log-linear"}) {
    const double index = std::string(type) == "log-linear" ? 0.4 : 0.0;
    EXPECT_DOUBLE_EQ(permeability(type, index)->conductivity(1.1, 1.1).k, 2e-8);
    EXPECT_DOUBLE_EQ(permeability(type, index, 0.8)->conductivity(0.8, 1.1).k, 2e-8);
  }
  EXPECT_NEAR(permeability("log-linear", 0.4)->conductivity(1.5, 1.1).k, 2e-7, 1e-19);
  EXPECT_NEAR(permeability("kozeny-carman")->conductivity(2.0, 1.0).k, 2e-8 * (8.0 / 3.0) / 0.5, 1e-19);
  EXPECT_EQ(permeability("kozeny-carman")->conductivity(-0.1, 1.0).k, 0.0);
}

TEST(Fluid, Water) {
  Teuchos::ParameterList list;
  list.set("type", "water");
  const auto fresh = Registries().fluids.create(section(list));
  EXPECT_DOUBLE_EQ(fresh->density(), 1000.0);
  EXPECT_DOUBLE_EQ(fresh->bulk_modulus(), 2.2e9);
  EXPECT_DOUBLE_EQ(fresh->unit_weight(), 9810.0);
  list.set("density", 1025.0);
  list.set("incompressible", true);
  list.set("unit weight", 1e4);
  const auto sea = Registries().fluids.create(section(list));
  EXPECT_DOUBLE_EQ(sea->unit_weight(), 1e4);
  EXPECT_TRUE(std::isinf(sea->bulk_modulus()));
}

std::string complaint(const Teuchos::ParameterList& given) {
  Teuchos::ParameterList list(given);
  try {
    Registries().skeletons.create(section(list));
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Registration, RulesAcrossParametersAreChecked) {
  Teuchos::ParameterList clay;
  clay.set("type", "modified cam clay");
  clay.set("critical stress ratio", 1.2);
  clay.set("compression slope", 0.15);
  clay.set("swelling slope", 0.03);
  EXPECT_NE(complaint(clay).find("exactly one"), std::string::npos);
  clay.set("Poisson's ratio", 0.3);
  EXPECT_EQ(complaint(clay), "");
  clay.set("shear modulus", 1e6);
  EXPECT_NE(complaint(clay).find("exactly one"), std::string::npos);
  clay.remove("shear modulus");
  clay.set("swelling slope", 0.2);
  EXPECT_NE(complaint(clay).find("smaller"), std::string::npos);
  clay.set("swelling slope", 0.03);
  clay.set("stress state coefficient", 3.0);
  EXPECT_NE(complaint(clay).find("plays no role without 'spacing ratio'"), std::string::npos);
  clay.set("spacing ratio", 1.0);
  EXPECT_NE(complaint(clay).find("give more than 1"), std::string::npos);
  clay.set("spacing ratio", 2.3);
  EXPECT_EQ(complaint(clay), "");
  clay.set("stress state coefficient", 1.5);
  EXPECT_NE(complaint(clay).find("stress state coefficient"), std::string::npos);
  clay.set("stress state coefficient", 3.0);
  clay.set("lode dependence", "sheng");
  EXPECT_EQ(complaint(clay), "");
  clay.set("critical stress ratio", 2.5);
  EXPECT_NE(complaint(clay).find("convex"), std::string::npos);
}

/// The error message when `entry` is added to (or replaces one of) the list, "" if there is none.
template <class Value>
std::string complaint(Teuchos::ParameterList list, const char* entry, Value value) {
  list.set(entry, value);
  return complaint(list);
}

TEST(Registration, OptionsThatWouldHaveNoEffectAreRefused) {
  Teuchos::ParameterList sand, cone, clay, solid;
  for (auto* list : {&sand, &cone, &solid}) {
    list->set("Young's modulus", 1e7);
    list->set("Poisson's ratio", 0.3);
  }
  sand.set("type", "mohr-coulomb");
  sand.set("cohesion", 1e3);
  sand.set("friction angle [deg]", 30.0);
  EXPECT_EQ(complaint(sand), "");
  EXPECT_NE(complaint(sand, "stress tolerance", 1e-5).find("no error control"), std::string::npos);
  EXPECT_NE(complaint(sand, "dilation angle [deg]", 31.0).find("not be greater"), std::string::npos);
  EXPECT_NE(complaint(sand, "cohesion", 0.0).find("positive somewhere"), std::string::npos);
  sand.set("integration", "modified euler");
  EXPECT_EQ(complaint(sand, "stress tolerance", 1e-5), "");

  cone.set("type", "drucker-prager");
  cone.set("cohesion", 1e3);
  EXPECT_NE(complaint(cone).find("friction angle"), std::string::npos);
  cone.set("friction angle [deg]", 30.0);
  EXPECT_EQ(complaint(cone), "");
  EXPECT_NE(complaint(cone, "cone slope", 0.3).find("no effect"), std::string::npos);
  EXPECT_NE(complaint(cone, "match", "direct").find("no effect"), std::string::npos);

  clay.set("type", "tresca");
  clay.set("undrained strength", 1e4);
  clay.set("Poisson's ratio", 0.49);
  EXPECT_NE(complaint(clay).find("exactly one"), std::string::npos);
  clay.set("rigidity index", 100.0);
  EXPECT_EQ(complaint(clay), "");
  for (const char* entry : {"rate coefficient", "rate exponent", "reference strain rate", "ductility"})
    EXPECT_NE(complaint(clay, entry, 0.1).find("no effect"), std::string::npos) << entry;
  EXPECT_NE(complaint(clay, "shear modulus", 1e6).find("exactly one"), std::string::npos);
  clay.set("rate law", "power");
  EXPECT_NE(complaint(clay, "rate coefficient", 0.1).find("no effect"), std::string::npos);
  EXPECT_EQ(complaint(clay, "rate exponent", 0.1), "");

  solid.set("type", "von mises");
  solid.set("yield stress", 1e5);
  EXPECT_EQ(complaint(solid), "");
  EXPECT_NE(complaint(solid, "saturation stress", 1e4).find("belong together"), std::string::npos);
}

TEST(Registration, EveryEntryIsDocumented) {
  Registries r;
  for (const auto& docs : {r.skeletons.document(), r.fluids.document(), r.permeabilities.document()})
    for (const auto& entry : docs) {
      EXPECT_FALSE(entry.summary.empty());
      EXPECT_FALSE(entry.parameters.empty());
      for (const auto& p : entry.parameters) EXPECT_GT(std::count(p.doc.begin(), p.doc.end(), ' '), 2) << p.name;
    }
}

}  // namespace
}  // namespace mudline
