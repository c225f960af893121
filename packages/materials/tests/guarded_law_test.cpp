// Laws with errors that guarded_law.hpp must catch.
#include "materials/guarded_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "materials/point/material_point.hpp"

namespace mudline {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

/// Linear elasticity with one modulus, and errors that a test can switch on.
struct Law : Skeleton {
  std::vector<StateVariable> variables{{"first", 1, "-"}, {"second", 6, "-"}};
  ElasticModuli own{1e6, 5e5};
  double stress = -1e5, state = 0, tangent = 1e6, start = 0, rest = 0.5;
  int failing = -1;  // number of the failing point
  bool throws = false;

  const std::vector<StateVariable>& state_variables() const override { return variables; }
  std::string initialise(const InitialPoint&, double* s) const override {
    if (throws) throw 1;
    for (int i = 0; i < state_size(); ++i) s[i] = start;
    return "";
  }
  int evaluate(const SkeletonWorkset& w) const override {
    if (throws) throw std::runtime_error("no such soil");
    for (int i = 0; i < w.points; ++i) {
      for (int c = 0; c < 6; ++c) w.stress(i, c) = i == 1 ? stress : -1e5;
      for (int c = 0; c < 7; ++c) w.state(i, c) = i == 1 ? state : 0;
      if (w.want_tangent)
        for (int c = 0; c < 36; ++c) w.tangent(i, c) = i == 1 ? tangent : 1e6;
      w.failed(i) = i == failing ? 1 : 0;
    }
    return failing >= 0 ? 1 : 0;
  }
  ElasticModuli moduli(const double*, double, const double*) const override { return own; }
  double k0(const InitialPoint&) const override {
    if (throws) throw 1;
    return rest;
  }
  bool gives_stress() const override { return true; }
  std::string find_stress(InitialPoint& point) const override {
    if (throws) throw 1;
    point.stress[4] = stress;
    return failing >= 0 ? "a table is missing:\nno such file" : "";
  }
};

struct Batch {
  PointView stress_old{"", 3, 6}, strain{"", 3, 6}, void_ratio{"", 3, 1}, state_old{"", 3, 7}, stress{"", 3, 6},
      state{"", 3, 7}, tangent{"", 3, 36};
  Kokkos::View<int*> failed{"", 3};
  LawFailure failure;
  int count;
  explicit Batch(const Law& law, bool want_tangent = true) {
    Kokkos::deep_copy(stress_old, -7.0);
    Kokkos::deep_copy(state_old, 9.0);
    count = evaluate_guarded(law,
                             {3, 1, 1, want_tangent, stress_old, strain, void_ratio, state_old, stress, state,
                              want_tangent ? tangent : PointView("", 0, 36), failed},
                             failure);
  }
  bool shows_old(int i) const { return stress(i, 2) == -7 && state(i, 6) == 9 && tangent(i, 35) == 0; }
};

TEST(GuardedLaw, SoundAnswersPass) {
  const Batch batch{Law()};
  EXPECT_EQ(batch.count, 0);
  EXPECT_EQ(batch.failure.point, -1);
  EXPECT_EQ(batch.stress(1, 2), -1e5);
}

TEST(GuardedLaw, WhatIsNotFiniteFailsItsPointAndShowsTheOldState) {
  for (const double bad : {nan, infinity, -infinity})
    for (double Law::*member : {&Law::stress, &Law::state, &Law::tangent}) {
      Law law;
      law.*member = bad;
      const Batch batch(law);
      EXPECT_EQ(batch.count, 1);
      EXPECT_EQ(batch.failure.point, 1);
      EXPECT_FALSE(batch.failure.refused);
      EXPECT_NE(batch.failure.reason.find("not finite"), std::string::npos);
      EXPECT_TRUE(batch.shows_old(1));
      EXPECT_FALSE(batch.shows_old(0));
      EXPECT_EQ(batch.failed(1), 1);
      EXPECT_EQ(batch.failed(2), 0);
    }
  Law law;
  law.tangent = nan;
  EXPECT_EQ(Batch(law, false).count, 0);  // the tangent is not wanted
}

TEST(GuardedLaw, ItsOwnRefusalIsItsRight) {
  Law law;
  law.failing = 2;
  const Batch batch(law);
  EXPECT_EQ(batch.count, 1);
  EXPECT_EQ(batch.failure.point, 2);
  EXPECT_TRUE(batch.failure.refused);
}

TEST(GuardedLaw, AnExceptionFailsAllPoints) {
  Law law;
  law.throws = true;
  const Batch batch(law);
  EXPECT_EQ(batch.count, 3);
  EXPECT_EQ(batch.failure.reason, "it throws: no such soil");
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(batch.shows_old(i));
}

TEST(GuardedLaw, StartsOnlyWithAFiniteStateAndPositiveModuli) {
  const InitialPoint point{{0, 0, 0}, {-1e5, -1e5, -1e5, 0, 0, 0}, 0.8, 1};
  double state[7];
  EXPECT_EQ(start_guarded(Law(), point, state), "");
  Law law;
  law.start = nan;
  EXPECT_NE(start_guarded(law, point, state).find("not finite"), std::string::npos);
  for (const ElasticModuli m : {ElasticModuli{nan, 1}, {1, nan}, {0, 1}, {1, 0}, {-1, 1}, {1, -1}, {infinity, 1}}) {
    Law other;
    other.own = m;
    EXPECT_NE(start_guarded(other, point, state).find("must be positive and finite"), std::string::npos);
    EXPECT_FALSE(MaterialPoint(other, point).refusal().empty());
  }
  law.throws = true;
  EXPECT_EQ(start_guarded(law, point, state), "its law throws: something that is no std::exception");
}

TEST(GuardedLaw, K0IsFinite) {
  double k0 = 0;
  Law law;
  EXPECT_EQ(guarded_k0(law, {}, k0), "");
  EXPECT_EQ(k0, 0.5);
  law.rest = nan;
  EXPECT_NE(guarded_k0(law, {}, k0), "");
  law.throws = true;
  EXPECT_NE(guarded_k0(law, {}, k0), "");
}

TEST(GuardedLaw, TheInitialStressIsFinite) {
  InitialPoint point{};
  Law law;
  EXPECT_EQ(guarded_stress(law, point), "");
  EXPECT_EQ(point.stress[4], -1e5);
  law.stress = nan;
  EXPECT_EQ(guarded_stress(law, point), "the initial stress of its law is not finite");
  law.failing = 0;
  EXPECT_EQ(guarded_stress(law, point), "no such file");
  law.throws = true;
  EXPECT_NE(guarded_stress(law, point), "");
}

TEST(GuardedLaw, DescriptionsOfTheStateAreChecked) {
  Law law;
  EXPECT_EQ(state_problem(law), "");
  law.variables = {{"first", 3, "-"}};
  EXPECT_NE(state_problem(law).find("has 3 components"), std::string::npos);
  law.variables = {{"first", 1, "-"}, {"first", 1, "-"}};
  EXPECT_NE(state_problem(law).find("called 'first'"), std::string::npos);
  law.variables = {{"", 1, "-"}};
  EXPECT_NE(state_problem(law), "");
}

TEST(GuardedLaw, AMaterialPointSaysWhatFailed) {
  const InitialPoint start{{0, 0, 0}, {-1e5, -1e5, -1e5, 0, 0, 0}, 0.8, 1};
  Law law;
  const MaterialPoint point(law, start);
  law.throws = true;
  PointMotion motion;
  motion.strain = {1e-3, 0, 0, 0, 0, 0};
  const PointTrial trial = point.evaluate(motion, 1, true);
  EXPECT_FALSE(trial.ok);
  EXPECT_EQ(trial.failure,
            "it throws: no such soil (effective stress xx yy zz yz xz xy = -1e+05 -1e+05 -1e+05 0 0 0 Pa, strain "
            "increment 0.001 0 0 0 0 0)");
}

}  // namespace
}  // namespace mudline
