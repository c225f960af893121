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

TEST(Text, SaysWhatIsNoText) {
  EXPECT_EQ(unfit("clay \xc3\xa4 \xe2\x82\xac \xf0\x9f\x99\x82"), "");
  EXPECT_EQ(unfit("a\nb", true), "");
  EXPECT_EQ(unfit("a\nb"), "the control character 0x0a");
  EXPECT_EQ(unfit("\xc2\x9b"), "the control character 0x9b");
  std::size_t place = 0;
  EXPECT_EQ(unfit("caf\xe9", false, &place), "the byte 0xe9, which is not UTF-8");
  EXPECT_EQ(place, 3u);
  for (const char* bad : {"\xc0\xaf", "\xed\xa0\x80", "\xf5\x80\x80\x80", "\xe2\x82", "\x80", "\xef\xbf\xbf"})
    EXPECT_NE(unfit(bad), "") << bad;
}

TEST(Text, MessagesAreShortAndPrintable) {
  EXPECT_EQ(printable("a \x1b[31m\xe9 \xc3\xa4"), "a \\x1b[31m\\xe9 \xc3\xa4");
  EXPECT_EQ(printable("a\xc2\x9b"), "a\\xc2\\x9b");
  const std::string all = "begin " + std::string(10000, 'x') + " end", shown = printable(all);
  EXPECT_LT(shown.size(), 2200u);
  EXPECT_EQ(shown.substr(0, 7), "begin x");
  EXPECT_EQ(shown.substr(shown.size() - 5), "x end");
  EXPECT_EQ(beginning("\xc3\xa4\xc3\xa4", 3), "\xc3\xa4 ...");
}

TEST(Text, TuplesHaveTheShortestNumbers) {
  const double numbers[] = {0.1, -2, 1e-6};
  EXPECT_EQ(tuple_text(numbers, 3), "(0.1, -2, 1e-06)");
  EXPECT_EQ(tuple_text(numbers, 1), "(0.1)");
}

}  // namespace
}  // namespace mudline
