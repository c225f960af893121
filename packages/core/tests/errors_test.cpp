#include "core/errors.hpp"

#include <gtest/gtest.h>

namespace mudline {
namespace {

const std::vector<std::string> words{"Young's modulus", "Poisson's ratio", "type", "density"};

TEST(Nearest, FindsTypos) {
  EXPECT_EQ(nearest("Poissons ratio", words), "Poisson's ratio");
  EXPECT_EQ(nearest("tpye", words), "type");
  EXPECT_EQ(nearest("densitiy", words), "density");
}

TEST(Nearest, IgnoresCaseAndSeparators) {
  EXPECT_EQ(nearest("Type", words), "type");
  EXPECT_EQ(nearest("POISSON'S RATIO", words), "Poisson's ratio");
  EXPECT_EQ(nearest("time_step", {"time steps", "time step"}), "time step");
}

TEST(Nearest, StaysSilentWhenNothingIsNear) {
  EXPECT_EQ(nearest("cohesion", words), "");
  EXPECT_EQ(nearest("x", {"y"}), "");
  EXPECT_EQ(nearest("", words), "");
  EXPECT_EQ(nearest("abc", {}), "");
}

TEST(Suggestion, NamesTheNearestOrAll) {
  EXPECT_EQ(suggestion("typ", {"type", "value"}), " (did you mean 'type'?)");
  EXPECT_EQ(suggestion("cohesion", {"type", "value"}), "; allowed: type, value");
  EXPECT_EQ(suggestion("cohesion", {}), "; none is allowed here");
}

TEST(Join, SeparatesItems) {
  EXPECT_EQ(join({}), "");
  EXPECT_EQ(join({"a"}), "a");
  EXPECT_EQ(join({"a", "b"}), "a, b");
  EXPECT_EQ(join({"a", "b"}, " | "), "a | b");
}

}  // namespace
}  // namespace mudline
