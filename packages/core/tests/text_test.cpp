#include "core/text.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mudline {
namespace {

TEST(Text, Trims) {
  EXPECT_EQ(trim("  a b\n"), "a b");
  EXPECT_EQ(trim(" \t"), "");
}

TEST(Text, NumbersReadBackExactly) {
  for (const double value : {0.1, 1.0 / 3.0, -2.5e-300, 1e7, 0.0, 123456789.123456789})
    EXPECT_EQ(parse_number(number_text(value)), value);
  EXPECT_EQ(number_text(0.5), "0.5");
}

TEST(Text, ParsesOnlyWholeNumbers) {
  EXPECT_EQ(parse_number(" +1.5e3 "), 1500.0);
  EXPECT_FALSE(parse_number("1.5 m"));
  EXPECT_FALSE(parse_number(""));
  EXPECT_FALSE(parse_number("+-1"));
  EXPECT_FALSE(parse_number("1e999"));
  EXPECT_TRUE(std::isnan(*parse_number("nan")));
  EXPECT_EQ(parse_integer("-7"), -7);
  EXPECT_FALSE(parse_integer("1.0"));
  EXPECT_FALSE(parse_integer("99999999999"));
}

TEST(Text, ParsesWordsAndArrays) {
  EXPECT_EQ(parse_bool("true"), true);
  EXPECT_EQ(parse_bool(" false "), false);
  EXPECT_FALSE(parse_bool("yes"));
  EXPECT_EQ(*parse_array("{a, b c ,d}"), (std::vector<std::string>{"a", "b c", "d"}));
  EXPECT_TRUE(parse_array("{}")->empty());
  EXPECT_FALSE(parse_array("a, b"));
  EXPECT_FALSE(parse_array("{a,,b}"));
  EXPECT_FALSE(parse_array("{a,}"));
}

TEST(Text, JoinsPathsAndEscapes) {
  EXPECT_EQ(join_path("", "a"), "a");
  EXPECT_EQ(join_path("a", ""), "a");
  EXPECT_EQ(join_path("a/b", "c"), "a/b/c");
  EXPECT_EQ(xml_escaped("a<\"b\">&"), "a&lt;&quot;b&quot;&gt;&amp;");
}

TEST(Text, TuplesHaveTheShortestNumbers) {
  const double numbers[] = {0.1, -2, 1e-6};
  EXPECT_EQ(tuple_text(numbers, 3), "(0.1, -2, 1e-06)");
  EXPECT_EQ(tuple_text(numbers, 1), "(0.1)");
}

}  // namespace
}  // namespace mudline
