// Laws of contact asked at many points at once: each answer is that of one point, and who does not ask gets none.
#include <gtest/gtest.h>

#include <stdexcept>

#include "contact/laws/friction.hpp"
#include "contact/laws/normal_law.hpp"
#include "core/deck.hpp"
#include "core/tests/deck_text.hpp"

namespace mudline {
namespace {

constexpr double untouched = -7;

struct FrictionList {
  Kokkos::View<char*> asked{"asked", 12};
  Kokkos::View<FrictionPoint*> questions{"questions", 12};
  Kokkos::View<ShearStrength*> answers{"answers", 12};
  FrictionList() {
    for (int i = 0; i < 12; ++i) {
      asked(i) = i % 3 != 1;
      questions(i) = {1e3 * (i - 2), {0.1 * i, 0.2, 0}, 1e-3 * i, 5, 0.01 * i, {}};
      answers(i) = {untouched, untouched};
    }
  }
};

FrictionPoint pressed(double normal, double slip = 0, double time = 0, double x = 0) {
  FrictionPoint at;
  at.normal = normal;
  at.slip = slip;
  at.time = time;
  at.position[0] = x;
  return at;
}

void expect_answers(const Friction& law) {
  const FrictionList list;
  law.strengths({list.asked, list.questions, list.answers});
  for (int i = 0; i < 12; ++i) {
    const ShearStrength one = law.strength(list.questions(i));
    EXPECT_EQ(list.answers(i).value, list.asked(i) ? one.value : untouched);
    EXPECT_EQ(list.answers(i).slope, list.asked(i) ? one.slope : untouched);
    if (list.asked(i)) {
      EXPECT_EQ(list.answers(i).rate_slope, one.rate_slope);
    }
  }
}

std::unique_ptr<Friction> made(const Registry<Friction>& registry, const std::string& parameters) {
  Deck deck;
  deck.overlay(section_xml("deck", section_xml("friction", parameters)), "deck.xml");
  return registry.create(deck.root().section("friction"));
}

TEST(PointwiseLaw, CoulombAnswersListsAsItAnswersPoints) {
  Registry<Friction> registry("friction");
  register_friction(registry);
  const std::string type = text_parameter("type", "coulomb") + number_parameter("coefficient", 0.4);
  expect_answers(*made(registry, type));
  expect_answers(*made(registry, type + number_parameter("kinetic coefficient", 0.1) +
                                     number_parameter("decay speed", 0.02) + number_parameter("adhesion", 30)));
  expect_answers(*made(registry, type + number_parameter("cap", 1500)));
  const auto capped = made(registry, type + text_parameter("cap", "1000*x + 100*t"));
  expect_answers(*capped);
  EXPECT_EQ(capped->strength(pressed(1e6, 0, 3, 2)).value, 2300);
  EXPECT_EQ(made(registry, type + number_parameter("cap", 1500))->strength(pressed(1e6)).value, 1500);
}

struct Weakening {
  double first = 0, length = 1;
  static constexpr bool reads_slip = true;
  static constexpr SoilQuantities reads{false, true, false};
  void parameters(Parameters& p) {
    p.required("first", first, "-", non_negative(), "test");
    p.required("length", length, "m", positive(), "test");
  }
  void check(const Section& section) const {
    if (first > 1) section.fail("must not be above 1", "first");
  }
  KOKKOS_FUNCTION ShearStrength operator()(const FrictionPoint& at) const {
    const double coefficient = first / (1 + at.slip / length);
    return {coefficient * at.normal, coefficient};
  }
};

struct Thrower {
  void parameters(Parameters&) {}
  ShearStrength operator()(const FrictionPoint& at) const {
    if (at.normal > 5e3) throw std::runtime_error("too much");
    return {0, 0};
  }
};

TEST(PointwiseLaw, ATriviallyCopyableLawIsAFriction) {
  Registry<Friction> registry("friction");
  registry.add<PointwiseFriction<Weakening>>("weakening", "test");
  registry.add<PointwiseFriction<Thrower>>("thrower", "test");
  const std::string type =
      text_parameter("type", "weakening") + number_parameter("first", 0.5) + number_parameter("length", 2e-3);
  const auto law =
      made(registry, type + number_parameter("tangential penalty factor", 3) + text_parameter("on", "total"));
  expect_answers(*law);
  EXPECT_EQ(law->strength(pressed(1e3, 2e-3)).value, 250);
  EXPECT_EQ(law->tangential_factor(), 3);
  EXPECT_FALSE(law->effective());
  EXPECT_TRUE(law->reads_slip());
  EXPECT_TRUE(law->reads().temperature);
  EXPECT_FALSE(law->reads().pore_pressure);
  EXPECT_ANY_THROW(made(
      registry, text_parameter("type", "weakening") + number_parameter("first", 2) + number_parameter("length", 1)));
  const auto thrower = made(registry, text_parameter("type", "thrower"));
  EXPECT_FALSE(thrower->reads_slip());
  const FrictionList list;
  EXPECT_THROW(thrower->strengths({list.asked, list.questions, list.answers}), std::runtime_error);
}

TEST(PointwiseLaw, NormalLawsAnswerListsAsTheyAnswerPoints) {
  Registry<NormalLaw> registry("normal law");
  register_normal_laws(registry);
  Deck deck;
  deck.overlay(
      section_xml("deck", section_xml("a", text_parameter("type", "linear")) +
                              section_xml("b", text_parameter("type", "smoothed") + number_parameter("depth", 2e-3))),
      "deck.xml");
  for (const std::string name : {"a", "b"}) {
    const auto law = registry.create(deck.root().section(name));
    Kokkos::View<char*> asked("asked", 6);
    Kokkos::View<NormalPoint*> questions("questions", 6);
    Kokkos::View<NormalPressure*> answers("answers", 6);
    for (int i = 0; i < 6; ++i) {
      asked(i) = i != 3;
      questions(i) = {1e-3 * i, 1e6, {}};
      answers(i) = {untouched, untouched};
    }
    law->pressures({asked, questions, answers});
    for (int i = 0; i < 6; ++i) {
      const NormalPressure one = law->at(1e-3 * i, 1e6, {});
      EXPECT_EQ(answers(i).value, i != 3 ? one.value : untouched) << name << i;
      EXPECT_EQ(answers(i).slope, i != 3 ? one.slope : untouched);
    }
  }
}

}  // namespace
}  // namespace mudline
