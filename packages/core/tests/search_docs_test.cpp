#include "core/search_docs.hpp"

#include <gtest/gtest.h>

#include "input_error.hpp"

namespace mudline {
namespace {

ParameterDoc parameter(const std::string& name, const std::string& unit, const std::string& doc,
                       const std::vector<std::string>& choices = {}) {
  return {name, "double", unit, "", "", doc, false, choices};
}

const std::vector<EntryDoc>& docs() {
  static const std::vector<EntryDoc> entries{
      {"skeleton", "tresca", "clay without water", {parameter("undrained strength", "Pa", "At the surface")}, {}},
      {"skeleton", "sand law", "grains", {parameter("friction angle [deg]", "deg", "Of the grains")}, {}},
      {"physics",
       "biot",
       "saturated soil",
       {parameter("gravity", "m/s2", "weight of the soil")},
       {{"initial state",
         "the start",
         {parameter("water level", "m", "height of the water"),
          parameter("type", "", "how it starts", {"geostatic", "none"})},
         {},
         false}}},
      {"physics", "dry", "soil without water", {parameter("gravity", "m/s2", "weight of the soil")}, {}},
      {"boundary condition", "fixed", "no displacement", {}, {}}};
  return entries;
}

std::vector<std::string> found(const std::string& words, std::size_t most = 15) {
  return search_docs(docs(), words, most);
}
using Lines = std::vector<std::string>;

TEST(SearchDocs, FindsParametersWithTheirPlaces) {
  EXPECT_EQ(found("Undrained Strength"), Lines{"undrained strength [Pa], in tresca (skeleton): At the surface"});
  EXPECT_EQ(found("gravity"), Lines{"gravity [m/s2], in biot (physics) and 1 more: weight of the soil"});
  EXPECT_EQ(found("friction angle"), Lines{"friction angle [deg], in sand law (skeleton): Of the grains"});
}

TEST(SearchDocs, FindsWhatIsUsuallyCalledOtherwise) {
  EXPECT_EQ(found("water table"), Lines{"water level [m], in biot (physics), initial state: height of the water"});
  EXPECT_EQ(found("su"), Lines{"undrained strength [Pa], in tresca (skeleton): At the surface"});
  EXPECT_EQ(found("Rollers"), Lines{"fixed (boundary condition): no displacement"});
  EXPECT_EQ(found("phi"), Lines{"friction angle [deg], in sand law (skeleton): Of the grains"});
}

TEST(SearchDocs, FindsKindsChoicesAndWordsOfTheTexts) {
  EXPECT_EQ(found("skeleton"), (Lines{"tresca (skeleton): clay without water", "sand law (skeleton): grains"}));
  EXPECT_EQ(found("geostatic"), Lines{"type = geostatic, in biot (physics), initial state: how it starts"});
  EXPECT_EQ(found("grains").size(), 2) << "its summary and a parameter of it";
  EXPECT_EQ(found("the soil weight"), Lines{"gravity [m/s2], in biot (physics) and 1 more: weight of the soil"});
  EXPECT_EQ(input_error([] { found("rains"); }),
            "nothing is called 'rains', and no text of the reference holds it; `mudline list` shows all types")
      << "no part of a word";
}

TEST(SearchDocs, NamesComeBeforeTexts) {
  const Lines water = found("water");
  ASSERT_EQ(water.size(), 3);
  EXPECT_EQ(water.front(), "water level [m], in biot (physics), initial state: height of the water");
  EXPECT_EQ(found("water", 2), (Lines{water.front(), "and 2 more; name it closer"}));
}

TEST(SearchDocs, NothingIsFoundForOtherWords) {
  EXPECT_EQ(input_error([] { found("xyzzy"); }),
            "nothing is called 'xyzzy', and no text of the reference holds it; `mudline list` shows all types");
  EXPECT_EQ(input_error([] { found("fixd"); }),
            "nothing is called 'fixd', and no text of the reference holds it (did you mean 'fixed'?)");
  EXPECT_EQ(input_error([] { found("watr level"); }),
            "nothing is called 'watr level', and no text of the reference holds it (did you mean 'water level'?)");
}

}  // namespace
}  // namespace mudline
