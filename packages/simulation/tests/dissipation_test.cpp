#include "simulation/results/dissipation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mudline {
namespace {

class DissipationTest : public testing::Test {
 protected:
  double found(const char* name) const {
    const Result* const result = table.find("rest", "pile", name);
    return result == nullptr ? NAN : result->value;
  }

  ResultTable table;
  Dissipation wall{"rest", "pile", "pressure", table};
};

TEST_F(DissipationTest, TimesAreBetweenSteps) {
  EXPECT_TRUE(wall.follow(1, 1, 100));
  EXPECT_FALSE(wall.follow(10, 9, 60));
  EXPECT_TRUE(std::isnan(found("pressure half dissipated after")));
  EXPECT_FALSE(wall.follow(100, 90, 40));
  EXPECT_NEAR(found("pressure half dissipated after"), 10 * std::sqrt(10), 1e-9);
  wall.follow(1000, 900, 5);
  EXPECT_NEAR(found("pressure half dissipated after"), 10 * std::sqrt(10), 1e-9);
  EXPECT_NEAR(found("pressure nine tenths dissipated after"), 100 * std::pow(10, 30.0 / 35), 1e-9);
  EXPECT_EQ(found("highest pressure"), 100);
  EXPECT_EQ(found("pressure at the end"), 5);
}

TEST_F(DissipationTest, GrowthStartsAnew) {
  wall.follow(1, 1, 100);
  wall.follow(2, 1, 40);
  EXPECT_FALSE(std::isnan(found("pressure half dissipated after")));
  EXPECT_TRUE(wall.follow(3, 1, 300));
  EXPECT_TRUE(std::isnan(found("pressure half dissipated after")));
  wall.follow(4, 1, 160);  // less than half of it is gone, though it is below the first one
  EXPECT_TRUE(std::isnan(found("pressure half dissipated after")));
}

TEST_F(DissipationTest, SuctionDissipatesLikewise) {
  wall.follow(1, 1, -80, -100);  // -100 at the start
  EXPECT_EQ(found("highest pressure"), -100);
  wall.follow(2, 1, -60, -100);
  EXPECT_TRUE(std::isnan(found("pressure half dissipated after")));
  wall.follow(4, 2, -40, -100);
  EXPECT_NEAR(found("pressure half dissipated after"), 2 * std::sqrt(2), 1e-12);
}

TEST_F(DissipationTest, NothingIsLeftOfWhatIsForgotten) {
  wall.follow(1, 1, 100);
  wall.follow(2, 1, 1);
  EXPECT_FALSE(rested(table, "rest", "pile"));  // that is told by the pressure on a wall
  wall.forget();
  EXPECT_TRUE(table.all().empty());
  Dissipation("rest", "pile", wall_pressure, table).follow(1, 1, 100);
  EXPECT_TRUE(rested(table, "rest", "pile"));
}

}  // namespace
}  // namespace mudline
