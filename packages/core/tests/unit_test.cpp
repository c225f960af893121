#include "core/unit.hpp"

#include <gtest/gtest.h>

#include "core/deck.hpp"
#include "core/parameters.hpp"
#include "deck_text.hpp"
#include "input_error.hpp"

namespace mudline {
namespace {

/// "2 kPa" as a number in the unit `declared`.
double number(const std::string& text, const std::string& declared) {
  const auto quantity = parse_quantity(text);
  EXPECT_TRUE(quantity) << text;
  return quantity ? number_in(declared, *quantity) : 0;
}

TEST(Unit, QuantitiesBecomeNumbersInTheDeclaredUnit) {
  EXPECT_EQ(number("2 kPa", "Pa"), 2000);
  EXPECT_EQ(number("-1.5e3kN/m2", "Pa"), -1.5e6);
  EXPECT_EQ(number("75 t", "kg"), 75000);
  EXPECT_EQ(number("1.3 kPa/m", "Pa/m"), 1300);
  EXPECT_DOUBLE_EQ(number("10 cm2", "m2"), 1e-3);
  EXPECT_DOUBLE_EQ(number("20 mm/s", "m/s"), 0.02);
  EXPECT_DOUBLE_EQ(number("18 kN/m^3", "N/m3"), 18e3);
  EXPECT_EQ(number("1 day", "s"), 86400);
  EXPECT_EQ(number("2 years", "s"), 2 * 365.25 * 86400);
  EXPECT_DOUBLE_EQ(number("10 m/year", "m/s"), 10 / (365.25 * 86400));
  EXPECT_DOUBLE_EQ(number("40 %", "-"), 0.4);
  EXPECT_EQ(number("2.7 t/m3", "kg/m3"), 2700);
  EXPECT_DOUBLE_EQ(number("4.2 kJ/(kg K)", "J/(kg K)"), 4200);
  EXPECT_EQ(number("1 1/min", "1/s"), 1.0 / 60);
  EXPECT_DOUBLE_EQ(number("5 mm2/(kPa s)", "m2/(Pa s)"), 5e-9);
  EXPECT_EQ(number("20 degC", "degC"), 20);
  EXPECT_EQ(number("3 kPa", "of the use"), 3000);
}

TEST(Unit, AnglesAreThoseThatAreDeclared) {
  EXPECT_EQ(number("30 deg", "deg"), 30);
  EXPECT_DOUBLE_EQ(number("1 rad", "deg"), 57.29577951308232);
  EXPECT_DOUBLE_EQ(number("180 deg/s", "rad/s"), 3.14159265358979324);
  EXPECT_EQ(parse_quantity("30 deg")->plain(), 30) << "in expressions angles are in degrees, as in decks";
  EXPECT_EQ(parse_quantity("2 rad/s")->plain(), 2);
}

TEST(Unit, WhatIsNoQuantity) {
  for (const char* text :
       {"2", "kPa", "2 kpa", "2 D", "2*m", "2 m +1", "2 m/", "2 (m", "2 m)", "x m", "1 - 2", "3-", ""})
    EXPECT_FALSE(parse_quantity(text)) << text;
}

TEST(Unit, OthersAreRefused) {
  EXPECT_EQ(input_error([] { number("75 t", "Pa"); }), "'75 t' is no value in Pa");
  EXPECT_EQ(input_error([] { number("2 kPa", "Pa/m"); }), "'2 kPa' is no value in Pa/m");
  EXPECT_EQ(input_error([] { number("2 kPa", "-"); }), "'2 kPa' is no pure number");
  EXPECT_EQ(input_error([] { number("300 K", "degC"); }), "'300 K' is no value in degC");
}

std::string parameter(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>\n";
}

struct Soil {
  double strength = 0, angle = 0;
  std::vector<double> tops;
  Function load;
  void parameters(Parameters& p) {
    p.add("strength", strength, "Pa", closed(0, 1e6), "");
    p.add("angle", angle, "deg", any(), "");
    p.add("tops", tops, "m", any(), "");
    p.add("load", load, "Pa", "");
  }
};

Soil read(const std::string& type, const std::string& name, const std::string& value,
          const std::vector<std::string>& settings = {}) {
  Deck deck;
  deck.overlay("<ParameterList>\n" +
                   section_xml("variables", parameter("s_u", "double", "4 kPa") + parameter("phi", "double", "30 deg") +
                                                parameter("d", "double", "2 d") +
                                                parameter("use", "string", "{s_u} {phi} {d}")) +
                   parameter("use", "string", "{use}") + section_xml("soil", parameter(name, type, value)) +
                   "</ParameterList>\n",
               "deck.xml");
  for (const std::string& setting : settings) deck.set(setting);
  const Section root = deck.root();
  Soil soil;
  Parameters p(root.section("soil"));
  soil.parameters(p);
  p.finish();
  EXPECT_TRUE(root.section("soil").unused().empty());
  return soil;
}

TEST(Unit, ValuesOfADeckMayHaveUnits) {
  EXPECT_EQ(read("double", "strength", "2 kPa").strength, 2000);
  EXPECT_EQ(read("double", "strength", "s_u").strength, 4000);
  EXPECT_EQ(read("double", "strength", "2*s_u + 1").strength, 8001) << "expressions are in SI units";
  EXPECT_EQ(read("double", "angle", "{phi}").angle, 30);
  EXPECT_EQ(read("double", "angle", "phi/2").angle, 15);
  EXPECT_EQ(read("Array(double)", "tops", "{0, 50 cm, -2}").tops, (std::vector<double>{0, 0.5, -2}));
  EXPECT_EQ(read("double", "load", "3 kPa").load(0, {}), 3000);
  EXPECT_EQ(read("string", "load", "3 kPa").load(0, {}), 3000);
  EXPECT_EQ(read("double", "strength", "1", {"soil/strength=5 kPa"}).strength, 5000);
  EXPECT_EQ(read("double", "strength", "1", {"soil/angle=2 rad"}).angle, 2 * 180 / 3.14159265358979324);
}

TEST(Unit, ValuesOfOtherUnitsAreRefusedWithTheirLine) {
  const auto error = [](const std::string& type, const std::string& name, const std::string& value) {
    return input_error([&] { read(type, name, value); });
  };
  EXPECT_EQ(error("double", "strength", "2 m"), "deck.xml:10: soil/strength: '2 m' is no value in Pa");
  EXPECT_EQ(error("double", "strength", "phi"), "deck.xml:10: soil/strength: '30 deg' is no value in Pa");
  EXPECT_EQ(error("double", "strength", "2 MPa"),
            "deck.xml:10: soil/strength: 2e+06 is out of range; allowed: [0, 1e+06]");
  EXPECT_EQ(error("Array(double)", "tops", "{1 m, 2 s}"), "deck.xml:10: soil/tops: '2 s' is no value in m");
  EXPECT_EQ(error("string", "load", "3 m"), "deck.xml:10: soil/load: '3 m' is no value in Pa");
  EXPECT_EQ(error("double", "strength", "3 kpa"),
            "deck.xml:10: soil/strength: expected a number, given '3 kpa'; 'kpa' is no unit (did you mean 'kPa'?)");
  EXPECT_EQ(error("int", "strength", "3 kPa"), "deck.xml:10: soil/strength: expected an integer (int), given '3 kPa'");
}

}  // namespace
}  // namespace mudline
