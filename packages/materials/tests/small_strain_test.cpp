// The strings of small-strain stiffness: curve of first loading, Masing's rule, memory, energy, and what the law behind
// them sees. Histories are compared with closed forms in tests/verification/materials.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/errors.hpp"
#include "materials/register_materials.hpp"
#include "materials/small_strain.hpp"
#include "materials/tests/point_driver.hpp"

namespace mudline {
namespace {

constexpr double ratio = 5.0, reference = 1e-4;

Teuchos::ParameterList section(double curvature = 1.0) {
  Teuchos::ParameterList list;
  list.set("ratio", ratio).set("reference strain", reference).set("curvature", curvature);
  return list;
}

Section deck(Teuchos::ParameterList& list) {
  return Section(list, std::make_shared<Sources>(), std::make_shared<FunctionLibrary>(), "");
}

SmallStrainStiffness stiffness(double curvature = 1.0, int bricks = 12) {
  Teuchos::ParameterList list = section(curvature);
  list.set("bricks", bricks);
  Parameters p(deck(list));
  SmallStrainStiffness made;
  made.parameters(p);
  p.finish();
  return made;
}

std::unique_ptr<Skeleton> law(const std::string& type, Teuchos::ParameterList list, bool stiff = true) {
  Registry<Skeleton> skeletons("skeleton");
  Registry<Fluid> fluids("fluid");
  Registry<Permeability> permeabilities("permeability");
  register_materials(skeletons, fluids, permeabilities);
  list.set("type", type);
  if (stiff) list.sublist("small-strain stiffness") = section();
  return skeletons.create(deck(list));
}

Teuchos::ParameterList elastic() {
  Teuchos::ParameterList list;
  list.set("Young's modulus", 2.6e7).set("Poisson's ratio", 0.3);  // G_ur = 10 MPa
  return list;
}

/// The strings of one point and the sum of the strain that its law got.
struct Point {
  explicit Point(const SmallStrainStiffness& of) : stiffness(of) {}
  /// Adds an increment (engineering shear) in equal parts.
  void move(std::array<double, 6> strain, int parts = 1) {
    for (double& c : strain) c /= parts;
    for (int n = 0; n < parts; ++n) {
      std::vector<double> now(strings.size());
      double got[6];
      stiffness.amplify(strain.data(), strings.data(), now.data(), got, nullptr);
      strings = now;
      for (int c = 0; c < 6; ++c) sum[c] += got[c];
    }
  }
  void shear(double strain, int parts = 1) { move({0, 0, 0, 0, 0, strain}, parts); }

  const SmallStrainStiffness& stiffness;
  std::vector<double> strings = std::vector<double>(stiffness.state_size());
  double sum[6] = {};
};

/// Stress of first loading over G_ur: the curve as far as its tangent is above 1, then a straight line.
double first_loading(double strain, double curvature = 1.0) {
  const double y = 0.385 * std::pow(strain / reference, curvature);
  const double b = 0.5 * ratio * (1 - curvature), end = b - 1 + std::sqrt((b - 1) * (b - 1) - 1 + ratio);
  if (y < end) return ratio * strain / (1 + y);
  const double last = reference * std::pow(end / 0.385, 1 / curvature);
  return ratio * last / (1 + end) + strain - last;
}

TEST(SmallStrain, FollowsTheCurveOfFirstLoading) {
  for (const double curvature : {1.0, 0.919}) {
    const SmallStrainStiffness made = stiffness(curvature);
    Point point(made);
    double strain = 1e-8;
    point.shear(strain);
    EXPECT_NEAR(point.sum[5] / strain, ratio, 1e-9);
    for (; strain < 1e-2; strain *= 1.05) {
      Point there(made);
      there.shear(strain);
      EXPECT_NEAR(there.sum[5] / first_loading(strain, curvature), 1.0, 4e-3) << strain << " at " << curvature;
    }
    Point far(made);
    far.shear(1e-2);
    const double before = far.sum[5];
    far.shear(1e-3);
    EXPECT_NEAR(far.sum[5] - before, 1e-3, 1e-15);
  }
}

/// The largest error of the secant modulus falls with the square of the number of bricks.
TEST(SmallStrain, ConvergesWithTheBricks) {
  std::vector<double> worst;
  for (const int bricks : {10, 20, 40}) {
    const SmallStrainStiffness made = stiffness(1.0, bricks);
    worst.push_back(0);
    for (double strain = 1e-6; strain < 1e-2; strain *= 1.01) {
      Point there(made);
      there.shear(strain);
      worst.back() = std::max(worst.back(), std::abs(there.sum[5] / first_loading(strain) - 1));
    }
  }
  EXPECT_NEAR(worst[0] / worst[1], 4.0, 0.4);
  EXPECT_NEAR(worst[1] / worst[2], 4.0, 0.4);
  EXPECT_LT(worst[2], 2.5e-4);
}

TEST(SmallStrain, DoesNotDependOnTheStepsOfAStraightPath) {
  const SmallStrainStiffness made = stiffness();
  Point one(made), many(made);
  for (const double part : {3e-4, -5e-4, 1e-4}) {
    one.move({part, -0.4 * part, 0, part, -0.3 * part, 0.7 * part});
    many.move({part, -0.4 * part, 0, part, -0.3 * part, 0.7 * part}, 500);
  }
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(one.sum[c], many.sum[c], 1e-15);
  EXPECT_NEAR(sym6::trace(one.sum), -1e-4 * 0.6, 1e-18);  // the volume is that of the strain
}

TEST(SmallStrain, ConvergesOnATurningPath) {
  const SmallStrainStiffness made = stiffness();
  std::vector<double> error;
  double exact[6] = {};
  for (const int parts : {4096, 64, 128}) {
    Point point(made);
    for (int n = 0; n < parts; ++n) {
      const double a = 2 * M_PI * n / parts, b = 2 * M_PI * (n + 1) / parts, radius = 2e-4;
      point.move({0, 0, 0, radius * (std::cos(b) - std::cos(a)), 0, radius * (std::sin(b) - std::sin(a))});
    }
    double squared = 0;
    for (int c = 3; c < 6; ++c) {
      if (parts == 4096) exact[c] = point.sum[c];
      squared += (point.sum[c] - exact[c]) * (point.sum[c] - exact[c]);
    }
    error.push_back(std::sqrt(squared) / (ratio * 2e-4));
  }
  EXPECT_LT(error[1], 0.03);
  EXPECT_LT(error[2], 0.6 * error[1]);
}

/// Masing: from a reversal on, the curve is that of first loading at twice the scale. A loop within a loop closes and
/// leaves no trace.
TEST(SmallStrain, FollowsMasingAndForgetsInnerLoops) {
  const SmallStrainStiffness made = stiffness();
  const double top = 4e-4;
  Point point(made);
  point.shear(top);
  const double highest = point.sum[5];
  for (const double back : {1e-5, 1e-4, 5e-4, 8e-4}) {
    Point other = point, fresh(made);
    other.shear(-back);
    fresh.shear(0.5 * back);
    EXPECT_NEAR(highest - other.sum[5], 2 * fresh.sum[5], 1e-14) << back;
  }
  Point direct = point, around = point;
  direct.shear(-6e-4);
  around.shear(-3e-4);
  const double at = around.sum[5];
  around.shear(1e-4);
  around.shear(-4e-5);
  around.shear(4e-5);
  around.shear(-1e-4);
  EXPECT_NEAR(around.sum[5], at, 1e-15);
  around.shear(-3e-4);
  EXPECT_NEAR(around.sum[5], direct.sum[5], 1e-15);
  for (std::size_t c = 0; c < direct.strings.size(); ++c) EXPECT_NEAR(around.strings[c], direct.strings[c], 1e-18);
}

/// The work on closed paths in all directions, oblique reversals among them, is never given back: with an elastic law
/// the stress is 2 G times the law's deviator, at least that of the end of an increment as it is integrated.
TEST(SmallStrain, GivesNoEnergy) {
  const SmallStrainStiffness made = stiffness();
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  double least = 1e300, largest = 0;
  for (int path = 0; path < 300; ++path) {
    Point point(made);
    for (int before = 0; before < 2; ++before)
      point.move(
          {uniform(engine) * 4e-4, uniform(engine) * 4e-4, 0, 0, uniform(engine) * 4e-4, uniform(engine) * 4e-4});
    // a cycle of strain, gone through until the strings close theirs
    const int corners = 2 + path % 5;
    std::vector<std::array<double, 6>> legs(corners);
    const double size = std::pow(10.0, -4.0 + uniform(engine));
    std::array<double, 6> back{};
    for (auto& leg : legs)
      for (int c = 0; c < 6; ++c) leg[c] = &leg == &legs.back() ? -back[c] : size * uniform(engine);
    for (std::size_t k = 0; k + 1 < legs.size(); ++k)
      for (int c = 0; c < 6; ++c) back[c] += legs[k][c];
    for (int c = 0; c < 6; ++c) legs.back()[c] = -back[c];
    for (int cycle = 0; cycle < 6; ++cycle) {
      double work = 0;
      for (const auto& leg : legs)
        for (int n = 0; n < 20; ++n) {
          std::array<double, 6> part;
          double stress[6];
          for (int c = 0; c < 6; ++c) part[c] = leg[c] / 20;
          const double mean = sym6::trace(part.data()) / 3;
          point.move(part);
          const double volume = sym6::trace(point.sum) / 3;
          for (int c = 0; c < 6; ++c)
            stress[c] = c < 3 ? 2 * (point.sum[c] - volume) : point.sum[c];  // [G], at the end of the increment
          for (int c = 0; c < 3; ++c) part[c] -= mean;
          work += sym6::work(stress, part.data());
        }
      if (cycle < 5) continue;
      least = std::min(least, work / (size * size));
      largest = std::max(largest, work / (size * size));
    }
  }
  EXPECT_GE(least, -1e-12);
  EXPECT_GT(largest, 1.0);
}

TEST(SmallStrain, TheLawGetsTheAmplifiedStrain) {
  Teuchos::ParameterList clay;
  clay.set("critical stress ratio", 1.1).set("compression slope", 0.18).set("swelling slope", 0.03);
  clay.set("Poisson's ratio", 0.25);
  const auto stiff = law("modified cam clay", clay), plain = law("modified cam clay", clay, false);
  PointDriver a(*stiff, {-1e5, -1e5, -1e5, 0, 0, 0}, 1.0, 1.5), b(*plain, {-1e5, -1e5, -1e5, 0, 0, 0}, 1.0, 1.5);
  const SmallStrainStiffness made = stiffness();
  Point strings(made);
  EXPECT_EQ(stiff->state_size(), plain->state_size() + made.state_size());
  const double shear = plain->moduli(a.stress().data(), 1.0, b.state().data()).shear;
  EXPECT_DOUBLE_EQ(stiff->moduli(a.stress().data(), 1.0, a.state().data()).shear, ratio * shear);
  for (int n = 0; n < 40; ++n) {
    const std::array<double, 6> strain{-1e-5 * n, 4e-6, 0, 2e-5, 0, n < 20 ? 3e-5 : -4e-5};
    const std::array<double, 6> before{strings.sum[0], strings.sum[1], strings.sum[2],
                                       strings.sum[3], strings.sum[4], strings.sum[5]};
    strings.move(strain);
    std::array<double, 6> got;
    for (int c = 0; c < 6; ++c) got[c] = strings.sum[c] - before[c];
    a.step(strain);
    b.step(got);
    for (int c = 0; c < 6; ++c) EXPECT_NEAR(a.stress()[c], b.stress()[c], 1e-5);
    EXPECT_NEAR(a.v(), b.v(), 1e-12);
  }
}

/// A string that is too long after a transfer to another mesh changes no stress.
TEST(SmallStrain, AStringThatIsTooLongMovesNothing) {
  const auto stiff = law("linear elastic", elastic());
  PointDriver point(*stiff, {-1e5, -1e5, -1e5, 0, 0, 0}, 1.0);
  for (double& x : point.state()) x = 0.01;
  std::array<double, 6> stress;
  std::vector<double> state;
  ASSERT_TRUE(point.evaluate({}, stress, state));
  for (int c = 0; c < 6; ++c) EXPECT_NEAR(stress[c], point.stress()[c], 1e-9);
}

/// Numbers that are functions of the place: each point has the strings of plain numbers, and keeps them.
TEST(SmallStrain, NumbersMayBeFunctionsOfThePlace) {
  Teuchos::ParameterList varying = elastic(), numbers = elastic();
  varying.sublist("small-strain stiffness").set("ratio", "5 - 2*y").set("reference strain", "1e-4*(1 + y)");
  const auto of_place = law("linear elastic", varying, false);
  for (const double y : {0.0, 0.5, 1.0}) {
    numbers.sublist("small-strain stiffness").set("ratio", 5 - 2 * y).set("reference strain", 1e-4 * (1 + y));
    const auto plain = law("linear elastic", numbers, false);
    InitialPoint start{{0, y, 0}, {-1e5, -1e5, -1e5, 0, 0, 0}, 1.0};
    PointDriver a(*of_place, start.stress, 1.0), b(*plain, start.stress, 1.0);
    ASSERT_EQ(of_place->initialise(start, a.state().data()), "");
    EXPECT_EQ(of_place->state_size(), plain->state_size() + 2);
    EXPECT_EQ(of_place->moduli(start.stress.data(), 1.0, a.state().data()).shear,
              plain->moduli(start.stress.data(), 1.0, b.state().data()).shear);
    for (int n = 0; n < 40; ++n) {
      const std::array<double, 6> strain{-1e-5, 4e-6, 0, 2e-5, 0, n < 20 ? 3e-5 : -4e-5};
      std::array<double, 6> ours, others;
      std::array<double, 36> tangent, other_tangent;
      std::vector<double> state;
      ASSERT_TRUE(a.evaluate(strain, ours, state, &tangent));
      ASSERT_TRUE(b.evaluate(strain, others, state, &other_tangent));
      EXPECT_EQ(ours, others);
      EXPECT_EQ(tangent, other_tangent);
      a.step(strain);
      b.step(strain);
    }
    EXPECT_EQ(a.state().back(), b.state().back());
  }
  InitialPoint outside{{0, 2.5, 0}, {-1e5, -1e5, -1e5, 0, 0, 0}, 1.0};
  std::vector<double> state(of_place->state_size());
  const std::string reason = "its 'small-strain ratio' is 0 here; allowed: (1, 100)";
  EXPECT_EQ(of_place->initialise(outside, state.data()), reason);
  EXPECT_EQ(of_place->number_out_of_range(outside.position), reason);
}

/// The last number of the state: G_0/G_ur after rest and a reversal, then the slope of the curve by bricks, 1 at the
/// end.
TEST(SmallStrain, TellsThePresentStiffness) {
  const auto stiff = law("linear elastic", elastic());
  PointDriver point(*stiff, {-1e5, -1e5, -1e5, 0, 0, 0}, 1.0);
  const auto present = [&] { return point.state().back(); };
  EXPECT_DOUBLE_EQ(present(), ratio);
  const auto shear = [&](double strain) {
    const double before = point.stress()[5];
    point.step({0, 0, 0, 0, 0, strain});
    return (point.stress()[5] - before) / strain / 1e7;  // over G_ur
  };
  double last = ratio;
  for (int n = 1; n < 80; ++n) {
    shear(5e-6);
    PointDriver further = point;
    further.step({0, 0, 0, 0, 0, 1e-10});
    EXPECT_NEAR(present(), (further.stress()[5] - point.stress()[5]) / 1e-3, 1e-5) << n;
    EXPECT_LE(present(), last);
    last = present();
    const double strain = 5e-6 * n, y = 0.385 * strain / reference;  // the slope of the curve
    if (y < std::sqrt(ratio) - 1) EXPECT_NEAR(present(), ratio / ((1 + y) * (1 + y)), 0.7);
  }
  EXPECT_NEAR(present(), 1.0, 1e-12);
  shear(0.0);
  EXPECT_NEAR(present(), 1.0, 1e-12);  // no strain is no reversal
  shear(-1e-7);
  EXPECT_NEAR(present(), ratio, 1e-12);
}

TEST(SmallStrain, StrengthIsThatOfTheLaw) {
  Teuchos::ParameterList clay;
  clay.set("undrained strength", 40e3).set("shear modulus", 6e6).set("Poisson's ratio", 0.45);
  const auto stiff = law("tresca", clay), plain = law("tresca", clay, false);
  PointDriver a(*stiff, {-1e5, -1e5, -1e5, 0, 0, 0}, 1.0), b(*plain, {-1e5, -1e5, -1e5, 0, 0, 0}, 1.0);
  for (int n = 0; n < 20; ++n) {
    a.step({0, 0, 0, 0, 0, 1e-3});
    b.step({0, 0, 0, 0, 0, 1e-3});
  }
  EXPECT_NEAR(a.stress()[5], b.stress()[5], 1.0);
  EXPECT_NEAR(a.stress()[5], 40e3, 40.0);
}

std::string refusal(const std::string& type, Teuchos::ParameterList list, Teuchos::ParameterList small) {
  list.sublist("small-strain stiffness") = small;
  try {
    law(type, list, false);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SmallStrain, RefusesWrongNumbersAndOtherLaws) {
  Teuchos::ParameterList soft = section(), none = section(), wide = section();
  soft.set("ratio", 0.8);
  none.set("reference strain", 0.0);
  EXPECT_NE(refusal("linear elastic", elastic(), soft).find("ratio: 0.8 is out of range; allowed: (1, 100)"),
            std::string::npos);
  EXPECT_NE(refusal("linear elastic", elastic(), none).find("reference strain: 0 is out of range"), std::string::npos);
  EXPECT_EQ(refusal("linear elastic", elastic(), wide), "");
  EXPECT_NE(refusal("neo-hookean", elastic(), section()).find("small-strain stiffness: unknown"), std::string::npos);
}

}  // namespace
}  // namespace mudline
