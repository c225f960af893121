// Modified Cam Clay against element tests integrated independently (Dormand-Prince 8(5,3), relative tolerance 1e-12, in
// principal axes with analytical rates) and against closed forms: Wood 1990, ch. 5; Peric & Ayari 2002, Geotechnique
// 52:681. Reference case: M 1.2, lambda 0.15, kappa 0.03, nu 0.3, v0 2, p'0 100 kPa. Tables are in kPa.
#include "materials/skeleton/modified_cam_clay.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "point_driver.hpp"

namespace mudline {
namespace {

constexpr double kpa = 1000.0;
using Law = PointwiseSkeleton<ModifiedCamClay>;

ModifiedCamClay clay(double ratio = 1.2, double compression = 0.15, double swelling = 0.03, double poisson = 0.3) {
  ModifiedCamClay law;
  law.ratio = ratio;
  law.compression = compression;
  law.swelling = swelling;
  law.poisson = poisson;
  law.integration.stress_tolerance = 1e-7;
  law.integration.maximum_substeps = 20000;
  return law;
}

// Lateral strain is linear within an increment, but not on the exact drained path, so the driver's increments must be
// small.
int steps_for(Path path, double axial) {
  return static_cast<int>(std::ceil(axial * (path == Path::drained ? 40000 : 2000)));
}

void expect_relative(double actual, double expected, double tolerance, const char* what) {
  EXPECT_NEAR(actual, expected, tolerance * std::abs(expected)) << what;
}

struct Row {
  double ocr, axial, drained_p, drained_q, drained_volume, undrained_p, undrained_q;
};

void expect_rows(const ModifiedCamClay& parameters, const Row* rows, int count) {
  const Law law(parameters);
  for (int i = 0; i < count; ++i) {
    const Row& r = rows[i];
    SCOPED_TRACE("OCR " + std::to_string(r.ocr) + ", axial strain " + std::to_string(r.axial));
    PointDriver drained(law, isotropic_stress(100 * kpa), 1.0, r.ocr),
        undrained(law, isotropic_stress(100 * kpa), 1.0, r.ocr);
    compress(drained, Path::drained, r.axial, steps_for(Path::drained, r.axial));
    compress(undrained, Path::undrained, r.axial, steps_for(Path::undrained, r.axial));
    expect_relative(drained.p(), r.drained_p * kpa, 1e-5, "drained p'");
    expect_relative(drained.q(), r.drained_q * kpa, 1e-5, "drained q");
    EXPECT_NEAR(-sym6::trace(drained.strain().data()), r.drained_volume, 1e-5 * std::abs(r.drained_volume))
        << "volumetric strain";
    expect_relative(undrained.p(), r.undrained_p * kpa, 1e-5, "undrained p'");
    expect_relative(undrained.q(), r.undrained_q * kpa, 1e-5, "undrained q");
  }
}

TEST(ModifiedCamClay, TriaxialCompression) {
  const Row rows[] = {
      {1, 0.01, 111.3095, 33.9285, 0.01185736, 77.32633, 57.13161},
      {1, 0.05, 131.917, 95.75087, 0.04028306, 57.73844, 68.82964},
      {1, 0.1, 145.9596, 137.8789, 0.05900265, 57.43695, 68.92129},
      {1, 0.2, 159.4484, 178.3452, 0.07527226, 57.43492, 68.9219},
      {2, 0.01, 130.491, 91.47299, 0.004, 100, 92.30769},
      {2, 0.05, 147.0917, 141.2752, 0.01720381, 100, 120},
      {2, 0.1, 155.3336, 166.0007, 0.02683505, 100, 120},
      {2, 0.2, 162.9782, 188.9346, 0.03520967, 100, 120},
      {5, 0.01, 130.491, 91.47299, 0.004, 100, 92.30769},
      {5, 0.05, 188.8744, 266.6232, 0.003255294, 188.4471, 254.2962},
      {5, 0.1, 178.1484, 234.4453, -0.005859574, 207.9941, 249.8091},
      {5, 0.2, 169.9318, 209.7955, -0.01339125, 208.1383, 249.766},
  };
  expect_rows(clay(), rows, 12);
}

TEST(ModifiedCamClay, ConstantShearModulus) {
  ModifiedCamClay law = clay();
  law.poisson = 0.0;
  law.shear_modulus = 2000 * kpa;
  const Row rows[] = {{1, 0.01, 109.7505, 29.25159, 0.009916169, 83.84147, 49.94688},
                      {1, 0.05, 129.5508, 88.65238, 0.03698675, 57.84331, 68.7972},
                      {1, 0.1, 143.7573, 131.2719, 0.05618035, 57.43765, 68.92108}};
  expect_rows(law, rows, 3);
}

TEST(ModifiedCamClay, SpecificVolumeOfTheStart) {
  ModifiedCamClay law = clay();
  law.volume = ModifiedCamClay::Volume::initial;
  const Row rows[] = {{1, 0.01, 111.3602, 34.08061, 0.01185083, 77.32633, 57.13161},
                      {1, 0.05, 132.3531, 97.05943, 0.04006276, 57.73844, 68.82964},
                      {1, 0.1, 146.767, 140.3011, 0.05825974, 57.43695, 68.92129}};
  expect_rows(law, rows, 3);
}

TEST(ModifiedCamClay, CriticalStates) {
  const Law law(clay());
  const struct {
    double ocr, p, q, volume;
  } states[] = {
      {1, 57.434918, 68.921901, 1.840198}, {2, 100.0, 120.0, 1.923376}, {5, 208.138302, 249.765962, 2.033331}};
  for (const auto& s : states) {
    SCOPED_TRACE("OCR " + std::to_string(s.ocr));
    PointDriver undrained(law, isotropic_stress(100 * kpa), 1.0, s.ocr),
        drained(law, isotropic_stress(100 * kpa), 1.0, s.ocr);
    compress(undrained, Path::undrained, 0.8, 800);
    expect_relative(undrained.p(), s.p * kpa, 1e-5, "undrained p'");
    expect_relative(undrained.q(), s.q * kpa, 1e-5, "undrained q");
    compress(drained, Path::drained, 1.6, 6400);  // exponential approach: a distance of 1e-5 remains after about 1.2
    expect_relative(drained.p(), 500.0 / 3.0 * kpa, 1e-5, "drained p'");
    expect_relative(drained.q(), 200 * kpa, 1e-5, "drained q");
    expect_relative(drained.v(), s.volume, 1e-5, "drained v");
  }
}

TEST(ModifiedCamClay, FirstYield) {
  const struct {
    Path path;
    double ocr, axial, q;
  } cases[] = {{Path::drained, 2, 0.0118715918, 111.4172029},
               {Path::drained, 5, 0.0257091103, 293.3863425},
               {Path::undrained, 2, 0.013, 120.0},
               {Path::undrained, 5, 0.026, 240.0}};
  for (const auto& c : cases) {
    SCOPED_TRACE("OCR " + std::to_string(c.ocr));
    const Law law(clay());
    PointDriver point(law, isotropic_stress(100 * kpa), 1.0, c.ocr);
    compress(point, c.path, c.axial * (1 - 1e-5), 400);
    EXPECT_EQ(point.state()[ModifiedCamClay::plastic_shear_strain], 0.0);
    expect_relative(point.q(), c.q * kpa, 2e-5, "q at first yield");
    compress(point, c.path, c.axial * 2e-5, 1);
    EXPECT_GT(point.state()[ModifiedCamClay::plastic_shear_strain], 0.0);
  }
}

TEST(ModifiedCamClay, OedometricCompression) {
  const Law law(clay());
  const struct {
    double axial, vertical, radial;
  } rows[] = {
      {0.01, 131.7962, 94.8580}, {0.05, 224.3586, 145.3689}, {0.10, 416.4802, 269.7250}, {0.20, 1312.8137, 850.2165}};
  for (const auto& r : rows) {
    PointDriver point(law, isotropic_stress(100 * kpa), 1.0);
    compress(point, Path::oedometric, r.axial, steps_for(Path::oedometric, r.axial));
    expect_relative(-point.stress()[1], r.vertical * kpa, 1e-5, "vertical");
    expect_relative(-point.stress()[0], r.radial * kpa, 1e-5, "radial");
    if (r.axial == 0.20) expect_relative(point.stress()[0] / point.stress()[1], law.k0({}), 1e-4, "K0");
  }
}

TEST(ModifiedCamClay, IsotropicCompressionTakesLargeIncrements) {
  const Law law(clay());
  const struct {
    double volume, p, v;
  } rows[] = {{0.015, 212.34141, 1.970224}, {0.030, 258.20336, 1.940891}, {0.060, 378.47909, 1.883529}};
  for (const auto& r : rows)
    for (const int steps : {1, 20}) {
      PointDriver point(law, isotropic_stress(100 * kpa), 1.0, 2.0);
      compress(point, Path::isotropic, r.volume / 3.0, steps);
      expect_relative(point.p(), r.p * kpa, 1e-6, "p'");
      expect_relative(point.v(), r.v, 1e-6, "v");
    }
}

TEST(ModifiedCamClay, EarthPressureAtRest) {
  EXPECT_NEAR(Law(clay()).k0({}), 0.647629, 1e-6);
  EXPECT_NEAR(Law(clay(0.9, 0.205, 0.044, 0.2)).k0({}), 0.754080657, 1e-8);
  EXPECT_NEAR(Law(clay(1.35, 0.09, 0.01, 0.25)).k0({}), 0.600922482, 1e-8);
  EXPECT_NEAR(Law(clay()).k0({{}, {}, 1.0, 4.0}) / Law(clay()).k0({}), 2.0, 1e-12);  // M = 1.2 is 30 degrees
  ModifiedCamClay constant_shear = clay(1.2, 0.20, 0.05);
  constant_shear.shear_modulus = 5e6;  // closed form without elastic shear strain: eta 0.5199, K0 0.6139
  EXPECT_NEAR(Law(constant_shear).k0({}), 0.6139, 5e-5);
}

// Further parameter sets, from the same independent integration.
TEST(ModifiedCamClay, OtherParameters) {
  ModifiedCamClay soft = clay(0.9, 0.205, 0.044, 0.2), stiff_shear = clay(1.0, 0.2, 0.05, 0.0),
                  dense = clay(1.35, 0.09, 0.01, 0.25);
  stiff_shear.shear_modulus = 3000 * kpa;
  dense.volume = ModifiedCamClay::Volume::initial;
  const Path cd = Path::drained, cu = Path::undrained, k0 = Path::oedometric;
  const struct {
    const ModifiedCamClay& law;
    double p0, v0, ocr;
    Path path;
    double axial, p, q, v, pc;
  } rows[] = {
      {soft, 50, 2.6, 1.3, cd, 0.02, 59.2992991, 27.8978974, 2.56837978, 75.5027817},
      {soft, 50, 2.6, 1.3, cd, 0.15, 68.0946902, 54.2840705, 2.48567318, 121.519938},
      {soft, 50, 2.6, 1.3, cu, 0.02, 39.3561394, 30.9446643, 2.6, 69.394349},
      {soft, 50, 2.6, 1.3, cu, 0.15, 35.6487806, 32.0833253, 2.6, 71.2962786},
      {soft, 50, 2.6, 1.3, k0, 0.15, 331.955687, 97.6424332, 2.23784074, 367.413509},
      {stiff_shear, 80, 2.2, 3, cd, 0.06, 120, 120, 2.17972674, 240},
      {stiff_shear, 80, 2.2, 3, cu, 0.02, 88.2308213, 112.741501, 2.2, 232.292112},
      {stiff_shear, 80, 2.2, 3, cu, 0.15, 108.420261, 108.436233, 2.2, 216.872467},
      {stiff_shear, 80, 2.2, 3, k0, 0.06, 318.311392, 109.267441, 2.07188197, 355.819863},
      {dense, 200, 1.7, 6, cd, 0.02, 445.709364, 737.128091, 1.69789261, 1114.61773},
      {dense, 200, 1.7, 6, cd, 0.15, 372.875203, 518.625609, 1.72965905, 768.676192},
      {dense, 200, 1.7, 6, cu, 0.02, 462.727715, 721.818184, 1.7, 1080.5486},
      {dense, 200, 1.7, 6, cu, 0.15, 531.052891, 716.921403, 1.7, 1062.10578},
      {dense, 200, 1.7, 6, k0, 0.06, 2672.29797, 1453.03697, 1.60099971, 3105.80976},
  };
  for (const auto& r : rows) {
    SCOPED_TRACE("M " + std::to_string(r.law.ratio) + ", axial strain " + std::to_string(r.axial) + ", path " +
                 std::to_string(static_cast<int>(r.path)));
    const Law law(r.law);
    PointDriver point(law, isotropic_stress(r.p0 * kpa), r.v0 - 1.0, r.ocr);
    compress(point, r.path, r.axial, steps_for(r.path, r.axial));
    expect_relative(point.p(), r.p * kpa, 1e-5, "p'");
    expect_relative(point.q(), r.q * kpa, 1e-5, "q");
    expect_relative(point.v(), r.v, 1e-6, "v");
    expect_relative(point.state()[ModifiedCamClay::preconsolidation], r.pc * kpa, 1e-5, "pc");
  }
}

// In extension the Lode-dependent law equals the circular one with the M of extension, in compression the circular one.
TEST(ModifiedCamClay, LodeDependenceMatchesTheMeridians) {
  ModifiedCamClay lode = clay();
  lode.lode = ModifiedCamClay::Lode::sheng;
  const double sine = 0.5, extension = 1.2 * (3.0 - sine) / (3.0 + sine);
  const Law sheng(lode), round(clay()), weak(clay(extension));
  for (const bool compressing : {true, false}) {
    PointDriver a(sheng, isotropic_stress(100 * kpa), 1.0, 1.5),
        b(compressing ? round : weak, isotropic_stress(100 * kpa), 1.0, 1.5);
    for (PointDriver* point : {&a, &b}) compress(*point, Path::undrained, compressing ? 0.15 : -0.15, 300);
    expect_relative(a.p(), b.p(), 1e-7, "p'");
    expect_relative(a.q(), b.q(), 1e-7, "q");
    expect_relative(a.q() / a.p(), compressing ? 1.2 : extension, 1e-3, "critical state ratio");
  }
}

// After unloading and reloading beyond the old preconsolidation pressure in one increment, the virgin line is met
// again.
TEST(ModifiedCamClay, UnloadingAndReloadingWithinOneIncrement) {
  const Law law(clay());
  PointDriver point(law, isotropic_stress(100 * kpa), 1.0);
  compress(point, Path::isotropic, 0.01, 5);
  compress(point, Path::isotropic, -0.004, 1);
  EXPECT_NEAR(point.p(),
              1000 * 100.0 * std::exp((2.0 - 2.0 * std::exp(-0.03)) / 0.15) *
                  std::exp((2.0 * std::exp(-0.03) - 2.0 * std::exp(-0.018)) / 0.03),
              1e-2);
  compress(point, Path::isotropic, 0.014, 1);
  expect_relative(point.p(), 1000 * 100.0 * std::exp((2.0 - 2.0 * std::exp(-0.06)) / 0.15), 1e-6, "virgin line");
}

// After shear on the wet side, the elastic path of the increment first dips into the ellipse and then leaves it again.
TEST(ModifiedCamClay, DippingIncrementAgreesWithManySmallOnes) {
  const Law law(clay());
  std::array<double, 6> end[2];
  for (const int steps : {1, 400}) {
    PointDriver point(law, isotropic_stress(100 * kpa), 1.0);
    compress(point, Path::undrained, 0.03, 60);
    const double before = point.state()[ModifiedCamClay::plastic_shear_strain];
    for (int i = 0; i < steps; ++i) point.step({-0.008 / steps, 0.048 / steps, -0.02 / steps, 0.0, 0.0, 0.016 / steps});
    EXPECT_GT(point.state()[ModifiedCamClay::plastic_shear_strain], before + 1e-3) << "it left the ellipse again";
    end[steps == 1 ? 0 : 1] = point.stress();
  }
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(end[0][c], end[1][c], 2e-6 * 100 * kpa);
}

// The state of `from` with a disturbance of 1e-15 to 1e-12, like rounding: it may lie on either side of the surface,
// with or without a deviator.
PointDriver disturbed(const Law& law, PointDriver& from, int variant) {
  const double size = std::pow(10.0, -12 - variant % 4);
  const auto noise = [&](int i) { return size * std::sin(1.0 + 7.0 * variant + 3.0 * i); };
  std::array<double, 6> stress = from.stress();
  for (int c = 0; c < 6; ++c) stress[c] += noise(c) * from.p();
  PointDriver point(law, stress, from.v() - 1.0);
  point.state() = from.state();
  point.state()[ModifiedCamClay::preconsolidation] *= 1.0 + noise(6);
  return point;
}

// Paths from the virgin line back to it, every second one with unloading first.
TEST(ModifiedCamClay, RoundingOfTheStartCostsNoAccuracy) {
  const Law law(clay());
  PointDriver start(law, isotropic_stress(100 * kpa), 1.0);
  compress(start, Path::isotropic, 0.01, 5);
  for (int variant = 0; variant < 160; ++variant) {
    SCOPED_TRACE("variant " + std::to_string(variant));
    PointDriver point = disturbed(law, start, variant);
    const double unloading = variant % 2 ? 0.0 : 5e-4 * (1 + variant % 8);
    if (unloading > 0.0) compress(point, Path::isotropic, -unloading, 1);
    const double axial = unloading + 0.001 + 1e-4 * variant * (1.0 + 1e-13 * variant);
    std::array<double, 6> with, without;
    std::array<double, 36> tangent;
    std::vector<double> state;
    ASSERT_TRUE(point.evaluate({-axial, -axial, -axial, 0.0, 0.0, 0.0}, with, state, &tangent));
    ASSERT_TRUE(point.evaluate({-axial, -axial, -axial, 0.0, 0.0, 0.0}, without, state));
    EXPECT_EQ(with, without);
    compress(point, Path::isotropic, axial, 1);
    expect_relative(point.p(), 100 * kpa * std::exp((2.0 - point.v()) / 0.15), 1e-7, "virgin line");
    EXPECT_LT(point.q(), 1e-9 * point.p());
  }
}

// Swelling with increasing extension: elastic paths that leave the ellipse at once or after an increasingly long chord.
TEST(ModifiedCamClay, RoundingOfTheStartCostsNoAccuracyOnChords) {
  const Law law(clay());
  PointDriver start(law, isotropic_stress(100 * kpa), 1.0);
  compress(start, Path::undrained, 0.03, 60);
  for (const double extension : {0.0, 1e-5, 1e-4, 5e-4, 2e-3}) {
    const auto increment = [&](int steps) {
      const double radial = (0.004 - 0.5 * extension) / steps;
      return std::array<double, 6>{radial, (0.004 + extension) / steps, radial, 0.0, 0.0, 0.0};
    };
    PointDriver reference = start;
    for (int i = 0; i < 400; ++i) reference.step(increment(400));
    for (int variant = 0; variant < 20; ++variant) {
      SCOPED_TRACE("extension " + std::to_string(extension) + ", variant " + std::to_string(variant));
      PointDriver point = disturbed(law, start, variant);
      point.step(increment(1));
      EXPECT_GT(point.state()[ModifiedCamClay::plastic_shear_strain],
                start.state()[ModifiedCamClay::plastic_shear_strain] + 5e-4);
      for (int c = 0; c < 6; ++c) EXPECT_NEAR(point.stress()[c], reference.stress()[c], 1e-8 * 100 * kpa);
    }
  }
}

// With the default tolerance and engineering increments, mixed control converges as Newton's method should.
TEST(ModifiedCamClay, NewtonNeedsFewIterationsAtTheDefaultTolerance) {
  ModifiedCamClay parameters = clay();
  parameters.integration = IntegrationOptions();
  const Law law(parameters);
  PointDriver point(law, isotropic_stress(100 * kpa), 1.0, 1.2);
  for (int i = 0; i < 100; ++i) {
    compress(point, Path::drained, 0.002, 1);
    EXPECT_LE(point.iterations(), 5) << i;
  }
  expect_relative(point.q(), 180.310775 * kpa, 1e-3, "q");
}

TEST(ModifiedCamClay, InitialState) {
  const Law law(clay());
  double state[ModifiedCamClay::state_size];
  InitialPoint point{{}, {-60 * kpa, -100 * kpa, -60 * kpa, 0, 0, 0}, 0.9, 1.5};
  ASSERT_EQ(law.initialise(point, state), "");
  const double p = 220.0 / 3.0, q = 40.0;
  EXPECT_NEAR(state[ModifiedCamClay::preconsolidation], 1.5 * (p + q * q / (1.44 * p)) * kpa, 1e-6);
  EXPECT_DOUBLE_EQ(state[ModifiedCamClay::initial_specific_volume], 1.9);
  point.stress = {0, 0, 0, 0, 0, 0};
  EXPECT_NE(law.initialise(point, state).find("mean effective stress"), std::string::npos);
  point.stress = {-50, -50, -50, 0, 0, 0};
  EXPECT_NE(law.initialise(point, state).find("minimum mean stress"), std::string::npos);
}

// Unlimited dilation: the mean stress stays at its minimum, nothing fails, and reloading starts from there.
TEST(ModifiedCamClay, LooseningStopsAtTheMinimumMeanStress) {
  const Law law(clay());
  PointDriver point(law, isotropic_stress(2 * kpa), 1.0, 1.2);
  for (int i = 0; i < 40; ++i) point.step({0.004, 0.002, 0.003, 0.001, 0.0, 0.005});
  EXPECT_NEAR(point.p(), 100.0, 1e-9);
  EXPECT_GE(point.state()[ModifiedCamClay::preconsolidation], 200.0);
  compress(point, Path::isotropic, 0.05, 10);
  EXPECT_GT(point.p(), 1000.0);
}

ModifiedCamClay casm(double ratio = 1.2) {
  ModifiedCamClay law = clay(ratio);
  law.spacing = 2.5;
  law.exponent = 3.0;
  return law;
}

TEST(CasmSurface, InExtensionIsThatOfTheSameFrictionAngle) {
  ModifiedCamClay lode = casm();
  lode.lode = ModifiedCamClay::Lode::sheng;
  const double sine = 0.5, extension = 1.2 * (3.0 - sine) / (3.0 + sine);
  const Law sheng(lode), round(casm()), weak(casm(extension));
  for (const bool compressing : {true, false}) {
    PointDriver a(sheng, isotropic_stress(100 * kpa), 1.0, 4.0),
        b(compressing ? round : weak, isotropic_stress(100 * kpa), 1.0, 4.0);
    for (PointDriver* point : {&a, &b}) compress(*point, Path::undrained, compressing ? 0.15 : -0.15, 300);
    expect_relative(a.p(), b.p(), 1e-7, "p'");
    expect_relative(a.q(), b.q(), 1e-7, "q");
  }
}

// The initial stress is on the surface for OCR 1; the critical state volume is where pc = r p'.
TEST(CasmSurface, InitialState) {
  ModifiedCamClay parameters = casm();
  const double p = 220.0 / 3.0, q = 40.0, eta = q / (1.2 * p), through = p * std::pow(2.5, eta * eta * eta);
  double state[ModifiedCamClay::state_size];
  InitialPoint point{{}, {-60 * kpa, -100 * kpa, -60 * kpa, 0, 0, 0}, 0.9, 1.5};
  ASSERT_EQ(parameters.initialise(point, state), "");
  expect_relative(state[ModifiedCamClay::preconsolidation], 1.5 * through * kpa, 1e-12, "pc");
  const SoilState soil = parameters.soil_state(point.stress.data(), 0.9, state);
  expect_relative(*soil.overconsolidation_ratio, 1.5, 1e-12, "overconsolidation ratio");
  expect_relative(*soil.undrained_strength, 0.6 * p * kpa * std::pow(1.5 * through / (2.5 * p), 0.8), 1e-12, "s_u");
  parameters.critical_volume = 2.5;
  parameters.reference_pressure = 100 * kpa;
  const double normal = 2.5 + 0.12 * std::log(2.5), pc = 1.5 * through;
  expect_relative(parameters.void_ratio(point) + 1.0, normal - 0.15 * std::log(pc / 100.0) + 0.03 * std::log(pc / p),
                  1e-12, "v");
}

// Plastic flow dissipates at every stress, though it is not normal to the surface.
TEST(CasmSurface, PlasticWorkIsPositive) {
  ModifiedCamClay law = casm();
  law.lode = ModifiedCamClay::Lode::sheng;
  const CasmModel<SixComponents> model(law, {}, 2.0, 100 * kpa);
  for (int i = 0; i < 2000; ++i) {
    const auto random = [&](int c) { return std::sin(12.9898 * i + 78.233 * c + 0.1 * i * c); };
    double stress[6];
    const double size = std::pow(10.0, 3.0 * random(6));  // of the deviator over the mean stress
    for (int c = 0; c < 6; ++c) stress[c] = 10 * kpa * (size * random(c) - (c < 3 ? 1.0 : 0.0));
    if (!(sym6::mean_pressure(stress) > 0.0)) continue;
    const double h[2] = {100 * kpa, 0.0};  // the flow direction does not depend on it
    PlasticFlow<double, 2> flow;
    model.flow(stress, h, 0.0, flow);
    EXPECT_GE(sym6::work(stress, flow.flow_direction), 0.0);
  }
}

}  // namespace
}  // namespace mudline
