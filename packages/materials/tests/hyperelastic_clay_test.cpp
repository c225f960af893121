// The elasticity of Modified Cam Clay that stores energy: closed paths of strain, stiffness, start, refusals. Paths are
// compared with the published potential in tests/verification/materials/test_hyperelastic_clay.py.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/errors.hpp"
#include "materials/register_materials.hpp"
#include "materials/skeleton/s_clay1s.hpp"
#include "point_driver.hpp"

namespace mudline {
namespace {

using Strain = std::array<double, 6>;
constexpr double g = 30.0;  // G/p' [-]
const std::array<double, 6> sheared{-80e3, -130e3, -90e3, 4e3, -6e3, 10e3};

/// M 1.2, lambda 0.15, kappa 0.03.
ModifiedCamClay clay_with_energy() {
  ModifiedCamClay law;
  law.ratio = 1.2;
  law.compression = 0.15;
  law.swelling = 0.03;
  law.shear_ratio = g;
  return law;
}

/// The same without: Poisson's ratio with the same G/p' at v = 2.
ModifiedCamClay clay_with_poisson() {
  ModifiedCamClay law = clay_with_energy();
  const double ratio = g * law.swelling / 2.0;  // G/K
  law.shear_ratio = 0.0;
  law.poisson = (1.5 - ratio) / (3.0 + ratio);
  return law;
}

std::vector<std::vector<Strain>> closed_paths() {
  const Strain volume{-2e-3, -2e-3, -2e-3, 0, 0, 0}, shear{5e-3, -1e-2, 5e-3, 0, 0, 0};
  const auto back = [](Strain leg) {
    for (double& c : leg) c = -c;
    return leg;
  };
  std::vector<std::vector<Strain>> all{{volume, shear, back(volume), back(shear)},
                                       {shear, volume, back(shear), back(volume)}};
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int path = 0; path < 10; ++path) {  // legs in all directions, so that the principal axes turn
    std::vector<Strain> legs(3 + path % 4);
    Strain sum{};
    for (std::size_t k = 0; k + 1 < legs.size(); ++k)
      for (int c = 0; c < 6; ++c) sum[c] += legs[k][c] = 4e-3 * uniform(engine);
    legs.back() = back(sum);
    all.push_back(legs);
  }
  return all;
}

/// What a closed path leaves: change of stress over the mean stress, and work over the largest work on the way.
struct Remainder {
  double stress = 0.0, work = 0.0;
};

/// Goes through a path in increments, with the work of each by Gauss' rule; the path must be elastic.
Remainder go_around(const Skeleton& law, const std::vector<Strain>& legs) {
  constexpr double node[4] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363};
  constexpr double weight[4] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763};
  constexpr int parts = 10;
  PointDriver point(law, sheared, 1.0, 30.0);
  double work = 0.0, largest = 0.0;
  for (const Strain& leg : legs)
    for (int n = 0; n < parts; ++n) {
      Strain part = leg, some, stress;
      std::vector<double> state;
      for (double& c : part) c /= parts;
      for (int k = 0; k < 8; ++k) {
        const double at = 0.5 * (1.0 + (k % 2 ? node[k / 2] : -node[k / 2]));
        for (int c = 0; c < 6; ++c) some[c] = at * part[c];
        EXPECT_TRUE(point.evaluate(some, stress, state));
        work += 0.5 * weight[k / 2] * sym6::work(stress.data(), part.data());
      }
      point.step(part);
      largest = std::max(largest, std::abs(work));
    }
  EXPECT_EQ(point.state()[ModifiedCamClay::plastic_shear_strain], 0.0);
  Remainder left;
  for (int c = 0; c < 6; ++c) left.stress = std::max(left.stress, std::abs(point.stress()[c] - sheared[c]) / 1e5);
  left.work = std::abs(work) / largest;
  return left;
}

TEST(ClayWithEnergy, ClosedPathsOfStrainLeaveNothing) {
  for (const auto& legs : closed_paths())
    for (const auto volume : {ModifiedCamClay::Volume::current, ModifiedCamClay::Volume::initial})
      for (const auto method : {IntegrationOptions::Method::dormand_prince, IntegrationOptions::Method::implicit})
        for (const auto lode : {ModifiedCamClay::Lode::none, ModifiedCamClay::Lode::sheng}) {
          ModifiedCamClay law = clay_with_energy();
          law.volume = volume;
          law.integration.method = method;
          law.lode = lode;
          const Remainder left = go_around(PointwiseSkeleton<ModifiedCamClay>(law), legs);
          EXPECT_LT(left.stress, 1e-10);
          EXPECT_LT(left.work, 1e-10);
        }
}

/// Inside the inclined surface of a bonded clay with a fabric.
TEST(ClayWithEnergy, NaturalClayLeavesNothingToo) {
  for (const auto method : {IntegrationOptions::Method::dormand_prince, IntegrationOptions::Method::implicit}) {
    SClay1s natural;
    natural.clay = clay_with_energy();
    natural.clay.integration.method = method;
    natural.rotation = 30.0;
    natural.initial_bonding = 5.0;
    natural.degradation = 8.0;
    const PointwiseSkeleton<SClay1sByParts> law{SClay1sByParts{{natural}}};
    for (const auto& legs : closed_paths()) {
      const Remainder left = go_around(law, legs);
      EXPECT_LT(left.stress, 1e-10);
      EXPECT_LT(left.work, 1e-10);
    }
  }
}

TEST(ClayWithEnergy, WithPoissonsRatioTheSamePathsLeaveStressAndWork) {
  for (const auto& legs : closed_paths()) {
    const Remainder left = go_around(PointwiseSkeleton<ModifiedCamClay>(clay_with_poisson()), legs);
    EXPECT_GT(left.stress, 1e-3);
    EXPECT_GT(left.work, 1e-3);
  }
}

/// D = 2 G on the deviator + K/p'^2 sigma sigma, with K = v p'/kappa exp(-q^2/(6 g p'^2)); at the start of the path and
/// from the moduli.
TEST(ClayWithEnergy, StiffnessIsSymmetricAndCouplesVolumeWithShear) {
  for (const auto lode : {ModifiedCamClay::Lode::none, ModifiedCamClay::Lode::sheng}) {
    ModifiedCamClay parameters = clay_with_energy();
    parameters.lode = lode;
    const PointwiseSkeleton<ModifiedCamClay> law(parameters);
    PointDriver point(law, sheared, 1.0, 30.0);
    Strain stress;
    std::vector<double> state;
    std::array<double, 36> tangent;
    ASSERT_TRUE(point.evaluate({}, stress, state, &tangent));
    EXPECT_EQ(stress, sheared);
    const double p = point.p(), h = std::pow(point.q() / p, 2) / (6.0 * g), bulk = 2.0 * p / 0.03 * std::exp(-h);
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        double expected = bulk / (p * p) * sheared[i] * sheared[j];
        if (i == j) expected += g * p * (i < 3 ? 2.0 : 1.0);
        if (i < 3 && j < 3) expected -= g * p * 2.0 / 3.0;
        EXPECT_NEAR(tangent[6 * i + j], expected, 1e-11 * bulk) << i << " " << j;
      }
    const ElasticModuli moduli = law.moduli(sheared.data(), 1.0, point.state().data());
    EXPECT_NEAR(moduli.bulk / bulk, 1.0, 1e-12);
    EXPECT_NEAR(moduli.shear / (g * p), 1.0, 1e-12);
  }
}

/// Elastic shear at constant volume raises p': ln(p'/p'_0) = v h/kappa with a constant v, to any size of increment.
TEST(ClayWithEnergy, UndrainedShearRaisesTheMeanStress) {
  ModifiedCamClay parameters = clay_with_energy();
  parameters.volume = ModifiedCamClay::Volume::initial;
  const PointwiseSkeleton<ModifiedCamClay> law(parameters);
  for (const int steps : {1, 7}) {
    PointDriver point(law, isotropic_stress(100e3), 1.0, 10.0);
    compress(point, Path::undrained, 0.01, steps);
    EXPECT_NEAR(point.q() / point.p(), 3.0 * g * 0.01, 1e-12);
    EXPECT_NEAR(std::log(point.p() / 100e3), 2.0 / 0.03 * 1.5 * g * 1e-4, 1e-12);
  }
}

/// With a normal compression line: unloaded from pc on the line and sheared elastically, the clay has the void ratio
/// that the law finds for the stress, and starts from it with that pc.
TEST(ClayWithEnergy, TheNormalLineIsReadAtRest) {
  for (const auto volume : {ModifiedCamClay::Volume::current, ModifiedCamClay::Volume::initial}) {
    ModifiedCamClay parameters = clay_with_energy();
    parameters.volume = volume;
    const PointwiseSkeleton<ModifiedCamClay> plain(parameters);
    parameters.normal_volume = 2.6;
    parameters.reference_pressure = 1e3;
    const double pc = 300e3, v = 2.6 - 0.15 * std::log(300.0) + 0.03 * std::log(pc / 100e3);
    PointDriver point(plain, isotropic_stress(100e3), v - 1.0, 3.0);
    point.step({-1e-3, -2e-3, -1e-3, 0, 0, 4e-3});
    InitialPoint start{{}, point.stress(), point.v() - 1.0};
    if (volume == ModifiedCamClay::Volume::initial) {  // sheared at the same p', with the v of the start
      const double shear = 4e-3, h = 0.5 * g * shear * shear;
      start = {{}, {-100e3, -100e3, -100e3, 0, 0, g * 100e3 * shear}, v / (1.0 - h) - 1.0};
    }
    double state[ModifiedCamClay::state_size];
    ASSERT_EQ(parameters.initialise(start, state), "");
    EXPECT_NEAR(state[ModifiedCamClay::preconsolidation] / pc, 1.0, 1e-10);
    start.overconsolidation_ratio = *parameters.soil_state(start.stress.data(), 1.0, state).overconsolidation_ratio;
    EXPECT_NEAR(parameters.void_ratio(start), start.void_ratio, 1e-10);
  }
}

std::string refusal(Teuchos::ParameterList list) {
  Registry<Skeleton> skeletons("skeleton");
  Registry<Fluid> fluids("fluid");
  Registry<Permeability> permeabilities("permeability");
  register_materials(skeletons, fluids, permeabilities);
  list.set("critical stress ratio", 1.2).set("compression slope", 0.15).set("swelling slope", 0.03);
  try {
    skeletons.create(Section(list, std::make_shared<Sources>(), std::make_shared<FunctionLibrary>(), ""));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ClayWithEnergy, RefusesWhatContradictsIt) {
  for (const char* type : {"modified cam clay", "s-clay1s"}) {
    Teuchos::ParameterList good;
    good.set("type", type).set("shear modulus ratio", g);
    EXPECT_EQ(refusal(good), "");
    Teuchos::ParameterList none(good), negative(good), two(good), strings(good), critical(good);
    none.set("shear modulus ratio", 0.0);
    negative.set("shear modulus ratio", -1.0);
    two.set("Poisson's ratio", 0.3);
    strings.sublist("small-strain stiffness").set("ratio", 5.0).set("reference strain", 1e-4);
    critical.set("critical state volume", 2.5);
    EXPECT_NE(refusal(none).find("shear modulus ratio: the ratio must be positive"), std::string::npos);
    EXPECT_NE(refusal(negative).find("shear modulus ratio: -1 is out of range"), std::string::npos);
    EXPECT_NE(refusal(two).find("exactly one of"), std::string::npos);
    EXPECT_NE(refusal(strings).find("small-strain stiffness: contradictory with a 'shear modulus ratio'"),
              std::string::npos);
    EXPECT_NE(refusal(critical).find("give 'normal compression volume'"), std::string::npos);
  }
}

}  // namespace
}  // namespace mudline
