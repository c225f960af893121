#include "core/told.hpp"

#include <gtest/gtest.h>

namespace mudline {
namespace {

TEST(Told, NumbersInUnitsThatAReaderLikes) {
  EXPECT_EQ(readable(42130, "N"), "42.13 kN");
  EXPECT_EQ(readable(-1.5e6, "Pa"), "-1.5 MPa");
  EXPECT_EQ(readable(999, "Pa"), "999 Pa");
  EXPECT_EQ(readable(0, "s"), "0 s");
  EXPECT_EQ(readable(0.01, "s"), "10 ms");
  EXPECT_EQ(readable(150, "s"), "2.5 min");
  EXPECT_EQ(readable(11500, "s"), "3.194 h");
  EXPECT_EQ(readable(31557600, "s"), "365.2 days");
  EXPECT_EQ(readable(10 * 31557600.0, "s"), "10 years");
  EXPECT_EQ(readable(245, "s", 2), "4.1 min");
  EXPECT_EQ(readable(0.06, "m"), "60 mm");
  EXPECT_EQ(readable(-12.5, "m"), "-12.5 m");
  EXPECT_EQ(readable(1.23456e-9, "-"), "1.23e-09");
  EXPECT_EQ(readable(7.4251, "m/s"), "7.425 m/s");
}

}  // namespace
}  // namespace mudline
