#include "integrator/forcing.hpp"

#include <gtest/gtest.h>

namespace mudline {
namespace {

TEST(Forcing, FollowsTheContraction) {
  Forcing forcing;
  forcing.start_step();
  EXPECT_DOUBLE_EQ(forcing.next(1e6), 0.1);
  EXPECT_DOUBLE_EQ(forcing.next(4e5), 0.1);              // contraction 0.4: 0.9 0.4^2 exceeds the largest share
  EXPECT_DOUBLE_EQ(forcing.next(8e4), 0.9 * 0.2 * 0.2);  // contraction 0.2
  EXPECT_DOUBLE_EQ(forcing.next(800), 0.3 / 800);        // 0.9 0.01^2 is less than convergence needs
  EXPECT_DOUBLE_EQ(forcing.next(8), 0.3 / 8);
  EXPECT_DOUBLE_EQ(forcing.next(0.5), 0.1);
}

TEST(Forcing, SolvesNoFurtherWhereTheResidualReturnsToWhatItWas) {
  Forcing forcing;
  forcing.start_step();
  for (const double ratio : {860.0, 4600.0, 570.0, 6400.0, 580.0}) EXPECT_DOUBLE_EQ(forcing.next(ratio), 0.1);
  EXPECT_DOUBLE_EQ(forcing.next(57), 0.9 * 0.1 * 0.1);  // a tenth of the least one
}

TEST(Forcing, SolvesFurtherAtOnceWhereTheStepBeforeHadNoCurvature) {
  Forcing forcing;
  for (const double share : {0.1, 0.9 * 0.1 * 0.1, 0.9 * 0.009 * 0.009}) {
    forcing.start_step();
    EXPECT_NEAR(forcing.next(1e6), share, 1e-12);
    forcing.next(1e6 * share);  // the residual is just what the linear solve left
  }
  forcing.start_step();
  forcing.next(1e6);
  forcing.next(5e5);  // the residual is dominated by curvature
  forcing.start_step();
  EXPECT_DOUBLE_EQ(forcing.next(1e6), 0.1);
}

TEST(Forcing, ForgetsAndCanBeOff) {
  Forcing forcing;
  forcing.start_step();
  forcing.next(1e6);
  forcing.next(1e5);
  forcing.forget();
  forcing.start_step();
  EXPECT_DOUBLE_EQ(forcing.next(1e6), 0.1);
  forcing.largest = 0;
  EXPECT_EQ(forcing.next(1e6), 0);
}

}  // namespace
}  // namespace mudline
