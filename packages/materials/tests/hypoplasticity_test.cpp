// Hypoplastic sand: what must hold whatever the path. tests/verification/strength/test_hypoplasticity.py compares whole
// paths with an integration of the published equations.
#include "materials/skeleton/hypoplasticity.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/pi.hpp"
#include "materials/register_materials.hpp"
#include "point_driver.hpp"

namespace mudline {
namespace {

using Law = PointwiseSkeleton<AutomaticTangent<Hypoplasticity>>;
using Tensor = std::array<double, 6>;

/// Hochstetten sand (docs/materials.md).
Hypoplasticity sand(bool intergranular = true, double tolerance = 1e-4) {
  Hypoplasticity law;
  law.friction = 33.0;
  law.hardness = 1e9;
  law.compression_exponent = 0.25;
  law.densest = 0.55;
  law.critical = 0.95;
  law.loosest = 1.05;
  law.peak_exponent = 0.25;
  law.stiffness_exponent = 1.5;
  law.tolerance = tolerance;
  if (!intergranular) return law;
  law.range = 1e-4;
  law.reversal = 5.0;
  law.turn = 2.0;
  law.evolution_exponent = 0.5;
  law.decay_exponent = 6.0;
  return law;
}

double critical_ratio() {
  const double sine = std::sin(33.0 * pi / 180.0);
  return 6.0 * sine / (3.0 - sine);
}

struct Answer {
  Tensor stress;
  std::vector<double> state;
  std::array<double, 36> tangent;
};

Answer answer(const PointDriver& point, const Tensor& strain) {
  Answer r;
  EXPECT_TRUE(point.evaluate(strain, r.stress, r.state, &r.tangent));
  return r;
}

/// Largest difference of the tangent from central differences, relative to its largest entry.
double tangent_error(const PointDriver& point, const Tensor& strain, double step) {
  const Answer at = answer(point, strain);
  double error = 0.0, size = 0.0;
  for (int j = 0; j < 6; ++j) {
    Tensor high = strain, low = strain;
    high[j] += step;
    low[j] -= step;
    const Answer a = answer(point, high), b = answer(point, low);
    for (int i = 0; i < 6; ++i) {
      error = std::max(error, std::abs(at.tangent[6 * i + j] - (a.stress[i] - b.stress[i]) / (2.0 * step)));
      size = std::max(size, std::abs(at.tangent[6 * i + j]));
    }
  }
  return error / size;
}

const Tensor anisotropic{-80e3, -150e3, -70e3, 4e3, -6e3, 12e3}, skew{3e-4, -9e-4, 1e-4, 2e-4, -3e-4, 5e-4};

TEST(Hypoplasticity, TangentAgreesWithDifferences) {
  for (const bool intergranular : {false, true})
    for (const double scale : {0.01, 0.1, 1.0, 10.0}) {
      const Law law(sand(intergranular));
      PointDriver point(law, anisotropic, 0.75);
      Tensor strain;
      for (int i = 0; i < 6; ++i) strain[i] = scale * skew[i];
      EXPECT_LT(tangent_error(point, strain, 1e-9), 1e-6) << intergranular << " " << scale;
      point.step(skew);
      EXPECT_LT(tangent_error(point, strain, 1e-9), 1e-6) << "onward " << intergranular << " " << scale;
      for (double& x : strain) x = -x;
      EXPECT_LT(tangent_error(point, strain, 1e-9), 1e-6) << "back " << intergranular << " " << scale;
    }
}

TEST(Hypoplasticity, TangentAgreesWithDifferencesOnAStraightPath) {
  const Law law(sand());
  PointDriver point(law, isotropic_stress(1e5), 0.75);
  compress(point, Path::oedometric, 0.02, 20);  // now the intergranular strain is at rest
  for (const double size : {1e-5, 1e-4, 1e-3, 1e-2})
    EXPECT_LT(tangent_error(point, {0.0, -size, 0.0, 0.0, 0.0, 0.0}, 1e-5 * size), 1e-5) << size;
}

TEST(Hypoplasticity, ZeroStrainChangesNothingAndIsStiff) {
  for (const bool intergranular : {false, true}) {
    const Law law(sand(intergranular));
    PointDriver point(law, anisotropic, 0.75);
    point.step(skew);
    const auto before = point.state();
    const Answer still = answer(point, {});
    EXPECT_EQ(still.stress, point.stress());
    EXPECT_EQ(still.state, before);
    const ElasticModuli m = law.moduli(point.stress().data(), point.v() - 1.0, before.data());
    for (int i = 0; i < 6; ++i) {
      EXPECT_GT(still.tangent[7 * i], 0.1 * m.shear);
      EXPECT_LT(still.tangent[7 * i], 4.0 * (m.bulk + m.shear));
    }
    // it is the limit of small strains that turn back
    Tensor back;
    for (int i = 0; i < 6; ++i) back[i] = -1e-7 * skew[i];
    if (!intergranular) continue;
    const Answer small = answer(point, back);
    for (int i = 0; i < 36; ++i) EXPECT_NEAR(small.tangent[i], still.tangent[i], 1e-3 * still.tangent[0]);
  }
}

TEST(Hypoplasticity, OneStepOrManyOfStraightStrain) {
  const Tensor strain{2e-3, -8e-3, 1e-3, 1e-3, -2e-3, 3e-3};
  for (const bool intergranular : {false, true}) {
    const Law law(sand(intergranular, 1e-6));
    PointDriver one(law, anisotropic, 0.7), many(law, anisotropic, 0.7);
    one.step(strain);
    Tensor part;
    for (int i = 0; i < 6; ++i) part[i] = strain[i] / 200;
    for (int n = 0; n < 200; ++n) many.step(part);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(one.stress()[i], many.stress()[i], 3e-5 * one.p());
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(one.state()[i], many.state()[i], 1e-4 * 1e-4);
  }
}

TEST(Hypoplasticity, ErrorFallsWithTheTolerance) {
  const Tensor strain{2e-3, -8e-3, 1e-3, 1e-3, -2e-3, 3e-3};
  const Law exact_law(sand(true, 1e-9));
  const Answer exact = answer(PointDriver(exact_law, anisotropic, 0.7), strain);
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const Law law(sand(true, tolerance));
    const Answer r = answer(PointDriver(law, anisotropic, 0.7), strain);
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(r.stress[i], exact.stress[i], 10.0 * tolerance * 1e5) << tolerance;
  }
}

TEST(Hypoplasticity, AVeryShortRangeIsNone) {
  Hypoplasticity shortest = sand(true);
  shortest.range = 1e-8;
  const Law without(sand(false)), with(shortest);
  PointDriver a(without, isotropic_stress(1e5), 0.75), b(with, isotropic_stress(1e5), 0.75);
  compress(a, Path::undrained, 0.01, 100);
  compress(b, Path::undrained, 0.01, 100);
  EXPECT_NEAR(a.p(), b.p(), 1e-3 * a.p());
  EXPECT_NEAR(a.q(), b.q(), 1e-3 * a.p());
}

TEST(Hypoplasticity, ReversalIsStiffByTheRatioGiven) {
  const Law with(sand(true)), without(sand(false));
  PointDriver point(with, isotropic_stress(1e5), 0.75);
  compress(point, Path::oedometric, 0.01, 100);
  PointDriver plain(without, point.stress(), point.v() - 1.0);
  const Tensor back{0, 1e-8, 0, 0, 0, 0}, onward{0, -1e-8, 0, 0, 0, 0};
  const double linear = 0.5 * (answer(plain, back).stress[1] - answer(plain, onward).stress[1]);
  EXPECT_NEAR((answer(point, back).stress[1] - point.stress()[1]) / linear, 5.0, 1e-2);
  // and the stiffness onward is that of the law without intergranular strain
  EXPECT_NEAR(
      (answer(point, onward).stress[1] - point.stress()[1]) / (answer(plain, onward).stress[1] - plain.stress()[1]),
      1.0, 1e-2);
}

TEST(Hypoplasticity, LooseAndDenseEndAtTheSameCriticalState) {
  const Law law(sand());
  const double confining = 1e5;
  double ratio[2], voids[2], peak = 0.0;
  for (const int loose : {0, 1}) {
    PointDriver point(law, isotropic_stress(confining), loose ? 0.9 : 0.65);
    for (int i = 0; i < 40; ++i) {
      compress(point, Path::drained, 0.05, 100);
      if (!loose) peak = std::max(peak, point.q() / point.p());
      if (i > 0) continue;
      EXPECT_EQ(sym6::trace(point.strain().data()) < 0.0, loose == 1) << "loose contracts, dense dilates";
    }
    ratio[loose] = point.q() / point.p();
    voids[loose] = point.v() - 1.0;
  }
  const double p = confining / (1.0 - critical_ratio() / 3.0);
  const double critical = 0.95 * std::exp(-std::pow(3.0 * p / 1e9, 0.25));
  EXPECT_GT(peak, 1.1 * critical_ratio());
  for (const int loose : {0, 1}) {
    EXPECT_NEAR(ratio[loose], critical_ratio(), 1e-2 * critical_ratio());
    EXPECT_NEAR(voids[loose], critical, 1e-2);
  }
}

TEST(Hypoplasticity, RotatedInputGivesRotatedOutput) {
  const Law law(sand());
  const double c = std::cos(0.7), s = std::sin(0.7), turn[9] = {c, -s, 0, s, c, 0, 0, 0, 1};
  const auto rotated = [&](const Tensor& a, double shear) {  // shear: 2 for a strain
    Tensor tensor = a, out;
    for (int i = 3; i < 6; ++i) tensor[i] /= shear;
    sym6::rotate(turn, tensor.data(), out.data());
    for (int i = 3; i < 6; ++i) out[i] *= shear;
    return out;
  };
  PointDriver plain(law, anisotropic, 0.75), turned(law, rotated(anisotropic, 1.0), 0.75);
  Tensor strain = skew;
  for (int n = 0; n < 4; ++n) {
    plain.step(strain);
    turned.step(rotated(strain, 2.0));
    for (double& x : strain) x *= -0.6;
  }
  const Tensor expected = rotated(plain.stress(), 1.0);
  Tensor h;
  for (int i = 0; i < 6; ++i) h[i] = plain.state()[i];
  h = rotated(h, 1.0);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(turned.stress()[i], expected[i], 1e-5);
    EXPECT_NEAR(turned.state()[i], h[i], 1e-14);
  }
}

TEST(Hypoplasticity, LoosenedSoilKeepsTheMinimumStressAndRecovers) {
  for (const bool intergranular : {false, true})
    for (const double size : {1e-5, 1e-3, 5e-2}) {
      const Law law(sand(intergranular));
      PointDriver point(law, {-900.0, -1500.0, -800.0, 0, 0, 200.0}, 0.8);
      for (int n = 0; n * size < 0.2 && n < 400; ++n) {
        point.step({size, size, 0.5 * size, 0, 0, 0.3 * size});
        ASSERT_GT(point.p(), 9.9);
        ASSERT_LT(point.q(), 2.0 * point.p());
        const Answer r = answer(point, {size, -size, 0, 0, 0, 0});
        for (const double x : r.tangent) ASSERT_TRUE(std::isfinite(x));
      }
      if (size > 1e-4) {
        EXPECT_LT(point.p(), 11.0);
      }
      point.step({-2e-2, -2e-2, -2e-2, 0, 0, 0});
      EXPECT_GT(point.p(), 300.0);
    }
}

TEST(Hypoplasticity, CyclesAtConstantVolumeLiquefy) {
  const Law law(sand());
  PointDriver point(law, isotropic_stress(5e4), 0.85);
  for (int n = 0; n < 50; ++n) {
    if (testing::Test::HasFatalFailure()) break;
    compress(point, Path::undrained, n % 2 == 0 ? 2e-3 : -2e-3, 10);
    ASSERT_GT(point.p(), 9.9);
  }
  EXPECT_LT(point.p(), 0.1 * 5e4);
}

/// A transfer to another mesh may leave a mean stress that the shear stress beside it does not fit.
TEST(Hypoplasticity, AStressThatNoSandBearsKeepsItsPressureAndLosesShear) {
  Hypoplasticity law = sand(false);
  law.prepare();
  const auto started = [&](const Tensor& stress) {
    SkeletonPoint in;
    std::copy(stress.begin(), stress.end(), in.stress);
    in.void_ratio = 0.75;
    const Tensor none{};
    const std::vector<double> old(Hypoplasticity::state_size, 0.0);
    std::vector<double> state = old;
    Tensor result;
    EXPECT_TRUE(law.update(in, none.data(), old.data(), result.data(), state.data()));
    return result;
  };
  EXPECT_EQ(started(anisotropic), anisotropic);
  const Tensor pulled_a_little{0.5e3, -20e3, -20e3, 0, 0, 0};  // t is 0.73
  EXPECT_EQ(started(pulled_a_little), pulled_a_little);
  const Tensor torn{12.75e3, -11.03e3, -17.18e3, 0, 0, -63.9e3};
  const Tensor back = started(torn);
  const double p = sym6::mean_pressure(torn.data());
  double principal[3];
  sym6::principal_values(back.data(), principal);
  EXPECT_NEAR(sym6::mean_pressure(back.data()), p, 1e-9);
  EXPECT_NEAR(principal[0], 0.0, 1e-9 * p);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR((back[i] + p) / back[5], (torn[i] + p) / torn[5], 1e-12);
  const Tensor pulled = started({2e3, 1e3, 3e3, 0, 0, 5e3});
  EXPECT_NEAR(sym6::mean_pressure(pulled.data()), law.minimum_mean_stress, 1e-9);
}

TEST(Hypoplasticity, VoidRatiosBeyondTheLimitsAreThoseOfTheLimits) {
  const Law law(sand(false));
  for (const double e : {0.3, 1.5}) {  // such void ratios come about on the way
    PointDriver point(law, isotropic_stress(1e5), 0.8);
    const double volume = std::log((1.0 + e) / 1.8);
    Tensor far{};
    for (int i = 0; i < 3; ++i) far[i] = volume / 3.0;
    std::array<double, 6> end;
    std::vector<double> state;
    std::array<double, 36> tangent;
    ASSERT_TRUE(point.evaluate(far, end, state, &tangent)) << e;
    for (const double x : end) EXPECT_TRUE(std::isfinite(x)) << e;
    for (const double x : tangent) EXPECT_TRUE(std::isfinite(x)) << e;
  }
}

std::string refusal(const Hypoplasticity& parameters, const Tensor& stress, double void_ratio) {
  const Law law(parameters);
  std::vector<double> state(law.state_size());
  InitialPoint point{};
  point.stress = stress;
  point.void_ratio = void_ratio;
  return law.initialise(point, state.data());
}

TEST(Hypoplasticity, RefusesStartsItCannotMake) {
  EXPECT_EQ(refusal(sand(), isotropic_stress(1e5), 0.7), "");
  EXPECT_NE(refusal(sand(), isotropic_stress(1e5), 0.4).find("the void ratio 0.4 is outside"), std::string::npos);
  EXPECT_NE(refusal(sand(), isotropic_stress(1e5), 1.0).find("the void ratio 1 is outside"), std::string::npos);
  EXPECT_NE(refusal(sand(), isotropic_stress(5.0), 0.7).find("below the minimum mean stress"), std::string::npos);
  EXPECT_NE(refusal(sand(), {1e3, -1e5, -1e5, 0, 0, 0}, 0.7).find("compression in all directions"), std::string::npos);
  Hypoplasticity shifted = sand();
  shifted.shift = 2e3;
  EXPECT_EQ(refusal(shifted, isotropic_stress(0.0), 0.7), "");
  EXPECT_EQ(refusal(shifted, {1e3, -1e5, -1e5, 0, 0, 0}, 0.7), "");
}

TEST(Hypoplasticity, AShiftActsAsThatMuchMorePressure) {
  Hypoplasticity shifted = sand();
  shifted.shift = 4e4;
  const Law plain_law(sand()), shifted_law(shifted);
  PointDriver plain(plain_law, isotropic_stress(1e5), 0.75), apparent(shifted_law, isotropic_stress(6e4), 0.75);
  compress(plain, Path::drained, 0.02, 50);
  compress(apparent, Path::drained, 0.02, 50);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(apparent.stress()[i], plain.stress()[i] + 4e4, 1e-3);
  const EarthPressures e = shifted_law.earth_pressures(1e5, {}).value();
  const double active = std::pow(std::tan((45.0 - 16.5) * pi / 180.0), 2);
  EXPECT_NEAR(e.active + 4e4, (1e5 + 4e4) * active, 1e-6);
  EXPECT_NEAR(e.passive + 4e4, (1e5 + 4e4) / active, 1e-6);
  EXPECT_NEAR(plain_law.k0({}), 1.0 - std::sin(33.0 * pi / 180.0), 1e-15);
}

TEST(Hypoplasticity, TooFewSubstepsFailThePoint) {
  Hypoplasticity hurried = sand();
  hurried.maximum_substeps = 3;
  const Law law(hurried);
  const PointDriver point(law, isotropic_stress(1e5), 0.75);
  std::array<double, 6> stress;
  std::vector<double> state;
  EXPECT_FALSE(point.evaluate({0, -0.01, 0, 0, 0, 0}, stress, state));
  EXPECT_EQ(stress, isotropic_stress(1e5));
}

Teuchos::ParameterList entries() {
  Teuchos::ParameterList list;
  list.set("type", "hypoplasticity").set("critical friction angle [deg]", 33.0).set("granular hardness", 1e9);
  list.set("compression exponent", 0.25).set("densest void ratio", 0.55).set("critical void ratio", 0.95);
  list.set("loosest void ratio", 1.05).set("peak exponent", 0.25).set("stiffness exponent", 1.5);
  return list;
}

/// The message about a section with one more entry, or "".
std::string message(const std::string& name, double value, bool intergranular) {
  Registry<Skeleton> skeletons("skeleton");
  Registry<Fluid> fluids("fluid");
  Registry<Permeability> permeabilities("permeability");
  register_materials(skeletons, fluids, permeabilities);
  Teuchos::ParameterList list = entries();
  if (intergranular) {
    list.set("intergranular strain range", 1e-4).set("reversal stiffness ratio", 5.0).set("turn stiffness ratio", 2.0);
    list.set("intergranular strain exponent", 0.5).set("stiffness decay exponent", 6.0);
  }
  if (!name.empty()) list.set(name, value);
  try {
    skeletons.create(Section(list, std::make_shared<Sources>(), std::make_shared<FunctionLibrary>(), ""));
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(Hypoplasticity, SaysWhichParameterIsWrong) {
  EXPECT_EQ(message("", 0.0, false), "");
  EXPECT_EQ(message("", 0.0, true), "");
  EXPECT_NE(message("densest void ratio", 0.96, false).find("below the critical void ratio"), std::string::npos);
  EXPECT_NE(message("critical void ratio", 1.06, false).find("below the loosest void ratio"), std::string::npos);
  EXPECT_NE(message("peak exponent", 20.0, false).find("isotropic compression"), std::string::npos);
  EXPECT_NE(message("turn stiffness ratio", 2.0, false).find("plays no role"), std::string::npos);
  EXPECT_NE(message("turn stiffness ratio", 0.5, true).find("at least 1"), std::string::npos);
  EXPECT_NE(message("turn stiffness ratio", 6.0, true).find("at least the turn"), std::string::npos);
  EXPECT_NE(message("intergranular strain range", 1e-4, false).find("must be given"), std::string::npos);
}

}  // namespace
}  // namespace mudline
