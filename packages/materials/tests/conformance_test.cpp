// What every skeleton law of the registry must keep to: purity, tangent, isotropy, finite numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <sstream>

#include "materials/register_materials.hpp"
#include "point_driver.hpp"

namespace mudline {
namespace {

std::vector<Teuchos::ParameterList> frictional_variants(Teuchos::ParameterList base) {
  base.set("cohesion", 15e3);
  base.set("friction angle [deg]", 28.0);
  Teuchos::ParameterList dilating(base), associated(base), brittle(base), euler(base), fifth_order(base);
  dilating.set("dilation angle [deg]", 8.0);
  associated.set("dilation angle [deg]", 28.0);
  brittle.set("tensile strength", 1e3);
  // Explicit substeps are stiff, and their number chancy, at a sharp tip: less of it is met with more cohesion.
  for (auto* list : {&euler, &fifth_order}) {
    list->set("cohesion", 300e3);
    list->set("apex rounding", 0.25);
    list->set("stress tolerance", 1e-6);
  }
  euler.set("integration", "modified euler");
  euler.set("maximum substeps", 5000);
  fifth_order.set("dilation angle [deg]", 8.0);
  fifth_order.set("integration", "runge-kutta-dormand-prince");
  fifth_order.set("maximum substeps", 5000);
  return {base, dilating, associated, brittle, euler, fifth_order};
}

std::vector<Teuchos::ParameterList> cone_variants(const Teuchos::ParameterList& elastic) {
  auto all = frictional_variants(elastic);
  Teuchos::ParameterList direct(elastic);
  direct.set("match", "direct");
  direct.set("cone slope", 0.5);
  direct.set("cone intercept", 12e3);
  direct.set("dilation slope", 0.2);
  all[1].set("match", "compression");
  all[2].set("match", "extension");
  all.push_back(direct);
  return all;
}

std::vector<Teuchos::ParameterList> tresca_variants() {
  Teuchos::ParameterList base;
  base.set("undrained strength", 40e3);
  base.set("shear modulus", 6e6);
  base.set("Poisson's ratio", 0.45);
  Teuchos::ParameterList rated(base), power(base), euler(base), fifth_order(base);
  rated.remove("shear modulus");
  rated.set("rigidity index", 150.0);
  rated.set("rate law", "logarithmic");
  rated.set("sensitivity", 4.0);
  power.set("rate law", "power");
  euler.set("integration", "modified euler");
  euler.set("sensitivity", 3.0);
  fifth_order.set("integration", "runge-kutta-dormand-prince");
  fifth_order.set("stress tolerance", 1e-6);
  return {base, rated, power, euler, fifth_order};
}

std::vector<Teuchos::ParameterList> von_mises_variants(Teuchos::ParameterList base) {
  base.set("yield stress", 80e3);
  Teuchos::ParameterList hardening(base), euler(base);
  hardening.set("hardening modulus", 2e5);
  hardening.set("saturation stress", 3e4);
  hardening.set("saturation rate", 40.0);
  euler = hardening;
  euler.set("integration", "modified euler");
  return {base, hardening, euler};
}

/// Deck entries of the variants under which a type is tested.
std::map<std::string, std::vector<Teuchos::ParameterList>> variants() {
  Teuchos::ParameterList elastic, clay;
  elastic.set("Young's modulus", 2e7);
  elastic.set("Poisson's ratio", 0.3);
  clay.set("critical stress ratio", 1.1);
  clay.set("compression slope", 0.18);
  clay.set("swelling slope", 0.03);
  Teuchos::ParameterList plain(clay), sheng(clay), constant_shear(clay);
  plain.set("Poisson's ratio", 0.25);
  sheng.set("Poisson's ratio", 0.25);
  sheng.set("lode dependence", "sheng");
  constant_shear.set("shear modulus", 4e6);
  constant_shear.set("specific volume", "initial");
  Teuchos::ParameterList implicit(sheng), fifth_order(plain);
  implicit.set("integration", "implicit");
  fifth_order.set("integration", "runge-kutta-dormand-prince");
  return {{"linear elastic", {elastic}},
          {"modified cam clay", {plain, sheng, constant_shear, implicit, fifth_order}},
          {"neo-hookean", {elastic}},
          {"mohr-coulomb", frictional_variants(elastic)},
          {"drucker-prager", cone_variants(elastic)},
          {"tresca", tresca_variants()},
          {"von mises", von_mises_variants(elastic)}};
}

/// Random states that a law may start from and random strain increments, repeatable.
class Sampler {
 public:
  explicit Sampler(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  InitialPoint point() {
    InitialPoint r;
    const double p = std::pow(10.0, uniform(3.0, 6.0)), size = uniform(0.0, 0.5) * p;
    for (int c = 0; c < 6; ++c) r.stress[c] = size * uniform(-1.0, 1.0) - (c < 3 ? p : 0.0);
    r.void_ratio = uniform(0.4, 2.5);
    r.overconsolidation_ratio = uniform(0.0, 1.0) < 0.4 ? 1.0 : uniform(1.0, 6.0);
    return r;
  }
  std::array<double, 6> increment(double smallest, double largest) {
    const double size = smallest * std::pow(largest / smallest, uniform(0.0, 1.0));
    std::array<double, 6> r;
    for (double& c : r) c = size * uniform(-1.0, 1.0);
    return r;
  }
  std::array<double, 9> rotation() {
    double q[4], norm = 0.0;
    for (double& x : q) {
      x = std::normal_distribution<double>()(engine_);
      norm += x * x;
    }
    for (double& x : q) x /= std::sqrt(norm);
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    return {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
            2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
            2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
  }

 private:
  std::mt19937_64 engine_;
};

double norm(const std::array<double, 6>& a) {
  double sum = 0.0;
  for (const double x : a) sum += x * x;
  return std::sqrt(sum);
}

/// Runs `test(law)` for every variant of every registered type.
template <class Test>
void for_every_law(Test test) {
  Registry<Skeleton> skeletons("skeleton");
  Registry<Fluid> fluids("fluid");
  Registry<Permeability> permeabilities("permeability");
  register_materials(skeletons, fluids, permeabilities);
  auto all = variants();
  for (const std::string& type : skeletons.names()) {
    ASSERT_TRUE(all.count(type)) << "give '" << type << "' a variant in this test";
    for (Teuchos::ParameterList& list : all[type]) {
      list.set("type", type);
      const auto law =
          skeletons.create(Section(list, std::make_shared<Sources>(), std::make_shared<FunctionLibrary>(), ""));
      std::ostringstream text;
      list.print(text, 0, false, false);
      SCOPED_TRACE(text.str());
      test(*law);
    }
  }
}

TEST(SkeletonConformance, EvaluatingTwiceGivesTheSameBitsWithAndWithoutTangent) {
  for_every_law([](const Skeleton& law) {
    Sampler sample(1);
    for (int n = 0; n < 500; ++n) {
      const InitialPoint start = sample.point();
      const PointDriver point(law, start.stress, start.void_ratio, start.overconsolidation_ratio);
      const auto increment = sample.increment(1e-6, 2e-2);
      std::array<double, 6> a, b, c;
      std::array<double, 36> ta, tb;
      std::vector<double> sa, sb, sc;
      point.evaluate(increment, a, sa, &ta);
      point.evaluate(increment, b, sb, &tb);
      point.evaluate(increment, c, sc);
      ASSERT_TRUE(a == b && ta == tb && sa == sb);
      ASSERT_TRUE(a == c && sa == sc) << "the tangent changes the stress";
    }
  });
}

/// Largest error of the tangent, relative to its largest entry.
double tangent_error(const PointDriver& point, const std::array<double, 6>& increment) {
  std::array<double, 36> tangent;
  std::array<double, 6> stress, low, high;
  std::vector<double> state;
  EXPECT_TRUE(point.evaluate(increment, stress, state, &tangent));
  double error = 0.0, size = 0.0;
  const double step = std::max(1e-9, 1e-5 * norm(increment));
  for (int j = 0; j < 6; ++j) {
    auto shifted = increment;
    shifted[j] = increment[j] + step;
    point.evaluate(shifted, high, state);
    shifted[j] = increment[j] - step;
    point.evaluate(shifted, low, state);
    for (int i = 0; i < 6; ++i) {
      error = std::max(error, std::abs(tangent[6 * i + j] - (high[i] - low[i]) / (2 * step)));
      size = std::max(size, std::abs(tangent[6 * i + j]));
    }
  }
  return error / size;
}

TEST(SkeletonConformance, TangentAgreesWithCentralDifferences) {
  for_every_law([](const Skeleton& law) {
    Sampler sample(2);
    std::vector<double> errors;
    for (int n = 0; n < 2000; ++n) {
      const InitialPoint start = sample.point();
      const PointDriver point(law, start.stress, start.void_ratio, start.overconsolidation_ratio);
      errors.push_back(tangent_error(point, sample.increment(1e-5, 1e-2)));
    }
    std::sort(errors.begin(), errors.end());
    // Once in a while the two sides of a difference have different numbers of substeps, or straddle first yield.
    EXPECT_LT(errors[1000], 1e-8);
    EXPECT_LT(errors[1980], 1e-7);
    EXPECT_LT(errors[1999], 1e-3);
  });
}

TEST(SkeletonConformance, RotatedInputGivesRotatedOutput) {
  for_every_law([](const Skeleton& law) {
    Sampler sample(3);
    double worst = 0.0;
    for (int n = 0; n < 1000; ++n) {
      const InitialPoint start = sample.point();
      const auto increment = sample.increment(1e-5, 1e-2);
      const auto r = sample.rotation();
      std::array<double, 6> turned, tensor = increment, turned_increment, a, b, expected;
      sym6::rotate(r.data(), start.stress.data(), turned.data());
      for (int c = 3; c < 6; ++c) tensor[c] *= 0.5;
      sym6::rotate(r.data(), tensor.data(), turned_increment.data());
      for (int c = 3; c < 6; ++c) turned_increment[c] *= 2.0;
      const PointDriver one(law, start.stress, start.void_ratio, start.overconsolidation_ratio);
      const PointDriver other(law, turned, start.void_ratio, start.overconsolidation_ratio);
      std::vector<double> sa, sb;
      ASSERT_TRUE(one.evaluate(increment, a, sa));
      ASSERT_TRUE(other.evaluate(turned_increment, b, sb));
      sym6::rotate(r.data(), a.data(), expected.data());
      for (int c = 0; c < 6; ++c) worst = std::max(worst, std::abs(b[c] - expected[c]) / norm(a));
      std::size_t first = 0;
      for (const StateVariable& variable : law.state_variables()) {
        if (variable.components == 6) {
          sym6::rotate(r.data(), &sa[first], expected.data());
          std::copy(expected.begin(), expected.end(), &sa[first]);
        }
        first += variable.components;
      }
      for (std::size_t c = 0; c < sa.size(); ++c)
        worst = std::max(worst, std::abs(sa[c] - sb[c]) / std::max(1.0, std::abs(sa[c])));
    }
    EXPECT_LT(worst, 1e-8);
  });
}

TEST(SkeletonConformance, NoStrainChangesNothing) {
  for_every_law([](const Skeleton& law) {
    Sampler sample(6);
    for (int n = 0; n < 200; ++n) {
      const InitialPoint start = sample.point();
      PointDriver point(law, start.stress, start.void_ratio, start.overconsolidation_ratio);
      point.step(sample.increment(1e-4, 1e-2));
      std::array<double, 6> stress;
      std::vector<double> state;
      ASSERT_TRUE(point.evaluate({}, stress, state));
      for (int c = 0; c < 6; ++c) EXPECT_NEAR(stress[c], point.stress()[c], 1e-8 * norm(point.stress()));
      for (std::size_t c = 0; c < state.size(); ++c)
        EXPECT_NEAR(state[c], point.state()[c], 1e-8 * std::abs(point.state()[c]));
    }
  });
}

TEST(SkeletonConformance, NoNotANumberAtTenThousandRandomInputs) {
  for_every_law([](const Skeleton& law) {
    Sampler sample(4);
    for (int n = 0; n < 10000; ++n) {
      const InitialPoint start = sample.point();
      const PointDriver point(law, start.stress, start.void_ratio, start.overconsolidation_ratio);
      std::array<double, 6> stress;
      std::array<double, 36> tangent;
      std::vector<double> state;
      const bool absurd = n % 100 == 0;  // such an increment may fail, but only cleanly
      const bool ok = point.evaluate(sample.increment(1e-8, absurd ? 1e3 : 5e-2), stress, state, &tangent);
      ASSERT_TRUE(ok || absurd) << n;
      double sum = 0.0;
      for (const double x : stress) sum += x;
      for (const double x : tangent) sum += x;
      for (const double x : state) sum += x;
      ASSERT_TRUE(std::isfinite(sum));
    }
  });
}

TEST(SkeletonConformance, StateIsDescribedAndStartsWithinItsBounds) {
  for_every_law([](const Skeleton& law) {
    Sampler sample(5);
    const InitialPoint start = sample.point();
    PointDriver point(law, start.stress, start.void_ratio, start.overconsolidation_ratio);
    int slot = 0;
    for (const StateVariable& variable : law.state_variables()) {
      EXPECT_FALSE(variable.name.empty() || variable.unit.empty());
      for (int c = 0; c < variable.components; ++c, ++slot) {
        EXPECT_GE(point.state()[slot], variable.low);
        EXPECT_LE(point.state()[slot], variable.high);
      }
    }
    const ElasticModuli m = law.moduli(start.stress.data(), start.void_ratio, point.state().data());
    EXPECT_GT(m.bulk, 0.0);
    EXPECT_GT(m.shear, 0.0);
  });
}

}  // namespace
}  // namespace mudline
