#include "core/section.hpp"

#include <gtest/gtest.h>

#include "core/deck.hpp"
#include "input_error.hpp"

namespace mudline {
namespace {

class SectionTest : public testing::Test {
 protected:
  SectionTest() {
    deck.overlay(R"xml(<ParameterList name="deck">
<ParameterList name="materials">
<ParameterList name="clay">
<Parameter name="type" type="string" value="cam clay"/>
<Parameter name="density" type="double" value="1800"/>
<ParameterList name="fluid"/>
</ParameterList>
<ParameterList name="sand"/>
</ParameterList>
<Parameter name="title" type="string" value="a test"/>
</ParameterList>
)xml",
                 "some/folder/deck.xml");
  }
  Deck deck;
};

TEST_F(SectionTest, KnowsItsPathAndContent) {
  const Section root = deck.root();
  const Section clay = root.section("materials").section("clay");
  EXPECT_EQ(root.path(), "");
  EXPECT_EQ(clay.path(), "materials/clay");
  EXPECT_EQ(clay.name(), "clay");
  EXPECT_EQ(root.section("materials").name(), "materials");
  EXPECT_EQ(root.section("materials").section_names(), (std::vector<std::string>{"clay", "sand"}));
  EXPECT_EQ(clay.parameter_names(), (std::vector<std::string>{"type", "density"}));
  EXPECT_TRUE(clay.has_section("fluid"));
  EXPECT_FALSE(clay.has_parameter("fluid"));
  EXPECT_TRUE(clay.has_parameter("type"));
  EXPECT_FALSE(clay.has_section("type"));
  EXPECT_EQ(clay.text("type"), "cam clay");
  EXPECT_EQ(clay.folder().substr(clay.folder().size() - 11), "some/folder");
  EXPECT_EQ(clay.folder().front(), '/');
}

TEST_F(SectionTest, AbsentSectionsAreEmptyAndKeepTheirPath) {
  const Section steps = deck.root().section("stages").section("push");
  EXPECT_EQ(steps.path(), "stages/push");
  EXPECT_TRUE(steps.parameter_names().empty());
  EXPECT_FALSE(deck.root().has_section("stages"));
  EXPECT_EQ(input_error([&] { steps.text("type"); }),
            "some/folder/deck.xml:1: stages/push: required parameter 'type' is missing");
}

TEST_F(SectionTest, FailNamesTheNearestKnownLine) {
  const Section clay = deck.root().section("materials").section("clay");
  EXPECT_EQ(input_error([&] { clay.fail("is wrong"); }), "some/folder/deck.xml:3: materials/clay: is wrong");
  EXPECT_EQ(input_error([&] { clay.fail("is wrong", "density"); }),
            "some/folder/deck.xml:5: materials/clay/density: is wrong");
  EXPECT_EQ(input_error([&] { clay.fail("is wrong", "colour"); }),
            "some/folder/deck.xml:3: materials/clay/colour: is wrong");
  EXPECT_EQ(input_error([&] { deck.root().fail("is wrong"); }), "some/folder/deck.xml:1: is wrong");
}

TEST_F(SectionTest, FailWithoutSources) {
  Teuchos::ParameterList list;
  const Section section(list, nullptr, nullptr, "");
  EXPECT_EQ(input_error([&] { section.section("a").fail("is wrong", "b"); }), "a/b: is wrong");
  EXPECT_EQ(input_error([&] { section.fail("is wrong"); }), "is wrong");
}

TEST_F(SectionTest, RefusesWhatIsNotAllowed) {
  const Section materials = deck.root().section("materials");
  materials.allow_sections({"clay", "sand"});
  materials.allow_parameters({});
  EXPECT_EQ(input_error([&] {
              materials.allow_sections({"clay", "sands"});
            }),
            "some/folder/deck.xml:8: materials/sand: unknown section (did you mean 'sands'?)");
  EXPECT_EQ(input_error([&] {
              materials.section("clay").allow_parameters({"type", "Density"});
            }),
            "some/folder/deck.xml:5: materials/clay/density: unknown parameter (did you mean 'Density'?)");
  EXPECT_EQ(input_error([&] {
              materials.section("clay").allow_parameters({"type", "cohesion"});
            }),
            "some/folder/deck.xml:5: materials/clay/density: unknown parameter; allowed: type, cohesion");
}

TEST_F(SectionTest, ParametersAreNoSectionsAndNumbersNoText) {
  EXPECT_EQ(input_error([&] { deck.root().section("title"); }),
            "some/folder/deck.xml:10: title: expected a section (ParameterList), given the string 'a test'");
  const Section clay = deck.root().section("materials").section("clay");
  EXPECT_EQ(input_error([&] { clay.text("density"); }),
            "some/folder/deck.xml:5: materials/clay/density: expected a string, given the number 1800");
  EXPECT_EQ(input_error([&] { clay.text("fluid"); }),
            "some/folder/deck.xml:6: materials/clay/fluid: expected a string, given a section");
}

TEST_F(SectionTest, UnusedFindsWhatNobodyRead) {
  const Section root = deck.root();
  EXPECT_EQ(root.unused(), (std::vector<std::string>{"materials/clay/type", "materials/clay/density", "title"}));
  root.text("title");
  root.section("materials").section("clay").text("type");
  EXPECT_EQ(root.unused(), std::vector<std::string>{"materials/clay/density"});
}

}  // namespace
}  // namespace mudline
