#include "core/deck_changes.hpp"

#include <gtest/gtest.h>

#include "core/deck.hpp"

namespace mudline {
namespace {

Deck deck(const std::string& entries) {
  Deck result;
  result.overlay("<ParameterList name=\"d\">" + entries + "</ParameterList>", "d.xml");
  return result;
}

std::string parameter(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>";
}

std::string section(const std::string& name, const std::string& entries) {
  return "<ParameterList name=\"" + name + "\">" + entries + "</ParameterList>";
}

TEST(DeckChanges, NamesEveryParameterThatDiffers) {
  const Deck was = deck(section("mesh", parameter("cells", "Array(int)", "{3, 3}")) +
                        section("clay", parameter("E", "double", "1e3") + parameter("nu", "double", "0.3")));
  const Deck now = deck(section("mesh", parameter("cells", "Array(int)", "{3, 4}")) +
                        section("clay", parameter("E", "int", "1000") + parameter("K0", "double", "0.5")) +
                        section("load", parameter("y", "string", "-1\n+t")));
  EXPECT_TRUE(deck_changes(was.list(), was.list()).empty());
  EXPECT_EQ(one_line(deck_changes(was.list(), now.list())),
            "mesh/cells: {3, 4}, was {3, 3}; clay/nu: not given, was 0.3; clay/K0: 0.5, was not given; "
            "load/y: -1 +t, was not given");
}

TEST(DeckChanges, SectionsByPath) {
  EXPECT_TRUE(lies_in("stages/push/duration", "stages"));
  EXPECT_TRUE(lies_in("stages/push/duration", "stages/push"));
  EXPECT_FALSE(lies_in("stages/push in/duration", "stages/push"));
}

}  // namespace
}  // namespace mudline
