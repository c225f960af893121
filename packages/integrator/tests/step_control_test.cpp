// Size of the next step: after easy, hard and failed steps, and after the time error of a step.
#include <gtest/gtest.h>

#include <cmath>

#include "core/section.hpp"
#include "integrator/step_control.hpp"

namespace mudline {
namespace {

StepControl control() {
  StepControl c;
  c.initial = 1;
  c.growth = 1.5;
  c.complete(100);
  return c;
}

LocalError error(double ratio, int order) {
  LocalError e;
  e.add(ratio, order);
  return e;
}

TEST(StepControl, DefaultsFollowTheStage) {
  const StepControl c = control();
  EXPECT_DOUBLE_EQ(c.minimum, 1e-6);
  EXPECT_DOUBLE_EQ(c.maximum, 100);
}

TEST(StepControl, GrowsAfterEasyStepsAndShrinksAfterHardOnes) {
  const StepControl c = control();
  EXPECT_DOUBLE_EQ(c.after_success(2, c.easy_iterations, {}), 3);
  EXPECT_DOUBLE_EQ(c.after_success(2, c.easy_iterations + 1, {}), 2);
  EXPECT_DOUBLE_EQ(c.after_success(2, c.hard_iterations, {}), 2);
  EXPECT_DOUBLE_EQ(c.after_success(2, c.hard_iterations + 1, {}), 1);
  EXPECT_DOUBLE_EQ(c.after_success(2, c.hard_iterations + 1, {}, true), 2) << "full steps had failed";
  EXPECT_DOUBLE_EQ(c.after_success(90, 1, {}), 100) << "the maximum";
}

TEST(StepControl, ConstantStepsReturnToTheirSizeSlowly) {
  StepControl c = control();
  c.growth = 1;
  EXPECT_DOUBLE_EQ(c.after_success(1, 1, {}), 1);
  EXPECT_DOUBLE_EQ(c.after_success(0.5, 1, {}), 0.625);
  EXPECT_DOUBLE_EQ(c.after_success(0.9, 1, {}), 1);
}

TEST(StepControl, CountsTheStepsOfADuration) {
  StepControl control;
  control.growth = 2;
  control.maximum = 8;
  EXPECT_EQ(control.steps_for(7, 1), 3);     // 1 + 2 + 4
  EXPECT_EQ(control.steps_for(15.5, 1), 5);  // 1 + 2 + 4 + 8, and a part
  EXPECT_EQ(control.steps_for(80, 8), 10);
  EXPECT_EQ(control.steps_for(0, 1), 0);
  control.growth = 1;
  EXPECT_EQ(control.steps_for(5, 2), 3);
}

TEST(StepControl, CutsUntilTheMinimum) {
  StepControl c = control();
  c.minimum = 0.3;
  EXPECT_DOUBLE_EQ(c.after_failure(1), 0.5);
  EXPECT_LT(c.after_failure(0.5), 0);
}

TEST(LocalError, AsksForTheStepOfTheFieldInGreatestNeed) {
  LocalError e;
  EXPECT_LT(e.ratio, 0) << "not measured";
  e.add(8, 2);
  EXPECT_NEAR(e.factor, 0.9 / 2, 1e-14) << "dt^3";
  e.add(5, 1);
  EXPECT_NEAR(e.factor, 0.9 / std::sqrt(5.0), 1e-14) << "dt^2";
  EXPECT_DOUBLE_EQ(e.ratio, 8);
  e.add(0, 1);
  EXPECT_DOUBLE_EQ(e.ratio, 8);
}

TEST(StepControl, RefusesMoreThanTwiceTheToleratedError) {
  StepControl c = control();
  EXPECT_LT(c.after_error(1, error(1e6, 1)), 0) << "off";
  c.error_tolerance = 1e-3;
  EXPECT_LT(c.after_error(1, {}), 0) << "not measured";
  EXPECT_LT(c.after_error(1, error(2, 1)), 0) << "allowed";
  EXPECT_NEAR(c.after_error(1, error(4, 1)), 0.45, 1e-14);
  EXPECT_NEAR(c.after_error(1, error(8, 2)), 0.45, 1e-14);
  EXPECT_NEAR(c.after_error(1, error(1e9, 1)), 0.1, 1e-14) << "no more than that at once";
  EXPECT_NEAR(c.after_error(1.5 * c.minimum, error(1e9, 1)), c.minimum, 1e-20);
  EXPECT_LT(c.after_error(c.minimum, error(1e9, 1)), 0) << "taken as it is";
}

TEST(StepControl, ChoosesTheStepOfTheToleratedError) {
  StepControl c = control();
  c.error_tolerance = 1e-3;
  EXPECT_NEAR(c.after_success(1, 1, error(1, 1)), 0.9, 1e-14);
  EXPECT_NEAR(c.after_success(1, 1, error(1 / 1.44, 1)), 1.08, 1e-14);
  EXPECT_NEAR(c.after_success(1, 1, error(1 / 1.331, 2)), 0.99, 1e-14);
  EXPECT_DOUBLE_EQ(c.after_success(1, 1, error(1e-9, 1)), 1.5) << "no more than the growth";
  EXPECT_DOUBLE_EQ(c.after_success(1, 1, error(0, 1)), 1.5) << "nothing happens";
  EXPECT_DOUBLE_EQ(c.after_success(1, 1, {}), 1) << "not measured";
  EXPECT_DOUBLE_EQ(c.after_success(1, c.hard_iterations + 1, error(1e-9, 1)), 0.5) << "Newton found it hard";
  c.growth = 1;
  EXPECT_DOUBLE_EQ(c.after_success(1, 1, error(1e-9, 1)), 2) << "without a growth the error alone decides";
}

}  // namespace
}  // namespace mudline
