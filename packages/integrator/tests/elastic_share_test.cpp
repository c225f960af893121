#include "integrator/elastic_share.hpp"

#include <gtest/gtest.h>

namespace mudline {
namespace {

double weight(double share) { return share / (1 - share); }

TEST(ElasticShare, FollowsTheResidual) {
  ElasticShare share;
  share.enabled = true;
  share.start();
  EXPECT_DOUBLE_EQ(share.next(1e6), 0.5);
  EXPECT_NEAR(weight(share.next(5e5)), 0.5, 1e-12);    // it falls with the residual
  EXPECT_NEAR(weight(share.next(4.9e5)), 0.3, 1e-12);  // the iterate creeps: longer pseudo time steps
  EXPECT_NEAR(weight(share.next(9.8e5)), 1.2, 1e-12);  // doubled residual: four times as stiff
  EXPECT_NEAR(weight(share.next(9.8e6)), 12, 1e-12);   // at most ten times
  EXPECT_NEAR(weight(share.next(10)), 1.2, 1e-12);     // at least a tenth
}

TEST(ElasticShare, EndsWithNewtonsMethod) {
  ElasticShare share;
  share.enabled = true;
  share.start();
  for (const double ratio : {1e6, 1e5, 1e4, 1e3}) EXPECT_GT(share.next(ratio), 0);
  share.next(1e2);
  EXPECT_EQ(share.next(1e1), 0);
  EXPECT_EQ(share.next(1e4), 0);
}

TEST(ElasticShare, StartsAnewAndCanBeOff) {
  ElasticShare share;
  EXPECT_EQ(share.next(1e6), 0);
  share.enabled = true;
  share.start();
  share.next(1e6);
  share.next(1e3);
  share.start();
  EXPECT_DOUBLE_EQ(share.next(1e3), 0.5);
}

}  // namespace
}  // namespace mudline
