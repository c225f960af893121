// Laws of contact by themselves: what they answer, and what a law of one's own says of itself.
#include <gtest/gtest.h>

#include "contact/laws/friction.hpp"
#include "contact/laws/normal_law.hpp"
#include "core/deck.hpp"
#include "core/tests/deck_text.hpp"

namespace mudline {
namespace {

FrictionPoint pressed(double normal, double slip = 0, double time = 0, double x = 0) {
  FrictionPoint at;
  at.normal = normal;
  at.slip = slip;
  at.time = time;
  at.position[0] = x;
  return at;
}

std::unique_ptr<Friction> made(const Registry<Friction>& registry, const std::string& parameters) {
  Deck deck;
  deck.overlay(section_xml("deck", section_xml("friction", parameters)), "deck.xml");
  return registry.create(deck.root().section("friction"));
}

TEST(ContactLaw, CapMayDependOnTimeAndPlace) {
  Registry<Friction> registry("friction");
  register_friction(registry);
  const std::string type = text_parameter("type", "coulomb") + number_parameter("coefficient", 0.4);
  const auto capped = made(registry, type + text_parameter("cap", "1000*x + 100*t"));
  EXPECT_EQ(capped->strength(pressed(1e6, 0, 3, 2)).value, 2300);
  EXPECT_EQ(capped->strength(pressed(1e6, 0, 3, 2)).slope, 0);
  EXPECT_EQ(capped->strength(pressed(1e3, 0, 3, 2)).value, 400);
  EXPECT_EQ(made(registry, type + number_parameter("cap", 1500))->strength(pressed(1e6)).value, 1500);
}

/// A coefficient that falls with the path slid.
class Weakening : public Friction {
 public:
  void parameters(Parameters& p) {
    p.required("first", first_, "-", non_negative(), "test");
    p.required("length", length_, "m", positive(), "test");
    interface_parameters(p);
  }
  void check(const Section& section) const {
    if (first_ > 1) section.fail("must not be above 1", "first");
  }
  ShearStrength strength(const FrictionPoint& at) const override {
    const double coefficient = first_ / (1 + at.slip / length_);
    return {coefficient * at.normal, coefficient};
  }
  SoilQuantities reads() const override { return {false, true, false}; }
  bool reads_slip() const override { return true; }

 private:
  double first_ = 0, length_ = 1;
};

TEST(ContactLaw, ALawOfOnesOwnHasTheParametersOfAll) {
  Registry<Friction> registry("friction");
  registry.add<Weakening>("weakening", "test");
  const std::string type =
      text_parameter("type", "weakening") + number_parameter("first", 0.5) + number_parameter("length", 2e-3);
  const auto law =
      made(registry, type + number_parameter("tangential penalty factor", 3) + text_parameter("on", "total"));
  EXPECT_EQ(law->strength(pressed(1e3, 2e-3)).value, 250);
  EXPECT_EQ(law->tangential_factor(), 3);
  EXPECT_FALSE(law->effective());
  EXPECT_TRUE(made(registry, type)->effective());
  EXPECT_ANY_THROW(made(
      registry, text_parameter("type", "weakening") + number_parameter("first", 2) + number_parameter("length", 1)));
}

TEST(ContactLaw, SmoothedPressureIsTheLinearOneHalfItsDepthFurtherIn) {
  Registry<NormalLaw> registry("normal law");
  register_normal_laws(registry);
  Deck deck;
  deck.overlay(
      section_xml("deck", section_xml("a", text_parameter("type", "linear")) +
                              section_xml("b", text_parameter("type", "smoothed") + number_parameter("depth", 2e-3))),
      "deck.xml");
  const auto linear = registry.create(deck.root().section("a")), smoothed = registry.create(deck.root().section("b"));
  EXPECT_EQ(linear->at(3e-3, 1e6, {}).value, 3e3);
  EXPECT_EQ(linear->at(3e-3, 1e6, {}).slope, 1e6);
  EXPECT_NEAR(smoothed->at(3e-3, 1e6, {}).value, 2e3, 1e-9);
  EXPECT_EQ(smoothed->at(3e-3, 1e6, {}).slope, 1e6);
  EXPECT_NEAR(smoothed->at(1e-3, 1e6, {}).value, 250, 1e-9);
  EXPECT_NEAR(smoothed->at(1e-3, 1e6, {}).slope, 5e5, 1e-6);
  EXPECT_EQ(smoothed->at(0, 1e6, {}).value, 0);
}

}  // namespace
}  // namespace mudline
