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
  EXPECT_EQ(readable(1.234e-6, "s", 2), "1.2 us");
  EXPECT_EQ(readable(75e3, "kg"), "75 t");
  EXPECT_EQ(readable(2000, "kg"), "2000 kg");
  EXPECT_EQ(readable(23456, "kg/m3"), "23460 kg/m3");
  EXPECT_EQ(readable(486.3, "-"), "486");
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

TEST(Told, RangesInUnitsThatAReaderLikes) {
  EXPECT_EQ(readable_range(2e3, 15.63e3, "Pa", 3), "2 to 15.6 kPa");
  EXPECT_EQ(readable_range(900, 2e6, "Pa"), "900 Pa to 2 MPa");
  EXPECT_EQ(readable_range(0, 2e4, "Pa"), "0 to 20 kPa");
  EXPECT_EQ(readable_range(0.0793, 17, "m"), "79.3 mm to 17 m");
  EXPECT_EQ(readable_range(1, 1.0001, "-"), "1");
  EXPECT_EQ(readable_range(1, 2.24, "-"), "1 to 2.24");
  EXPECT_EQ(readable_range(1e-9, 2e-9, "m/s"), "1e-09 to 2e-09 m/s");
}

}  // namespace
}  // namespace mudline
