#include "core/variables.hpp"

#include <gtest/gtest.h>

#include "core/deck.hpp"
#include "deck_text.hpp"
#include "input_error.hpp"

namespace mudline {
namespace {

std::string parameter(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>\n";
}

/// A deck with these variables and this body, which begins on line 2 + number of variables + 2.
std::string deck_text(const std::string& variables, const std::string& body) {
  return "<ParameterList name=\"deck\">\n" + section_xml("variables", variables) + body + "</ParameterList>\n";
}

/// The value of a parameter of this type in a deck with a few variables.
Teuchos::ParameterList worked_out(const std::string& type, const std::string& value,
                                  const std::vector<std::string>& settings = {}) {
  static const std::string variables = parameter("area", "double", "pi*D^2/4") + parameter("D", "double", "0.5") +
                                       parameter("n", "int", "6") + parameter("soil", "string", "clay") +
                                       parameter("file", "string", "{soil}_{n}.msh") + parameter("wet", "bool", "true");
  static const std::string all = parameter("all", "string", "{area} {D} {n} {soil} {file} {wet}");
  Deck deck;
  deck.overlay(deck_text(variables, parameter("value", type, value) + all), "deck.xml");
  for (const std::string& setting : settings) deck.set(setting);
  deck.root();
  return deck.list();
}

std::string error_of(const std::string& type, const std::string& value) {
  return input_error([&] { worked_out(type, value); });
}

std::string error_of_variables(const std::string& variables, const std::string& body = "") {
  Deck deck;
  return input_error([&] {
    deck.overlay(deck_text(variables, body), "deck.xml");
    deck.root();
  });
}

TEST(Variables, StandInValuesOfEveryType) {
  EXPECT_EQ(worked_out("double", "D").get<double>("value"), 0.5);
  EXPECT_EQ(worked_out("double", " {D} ").get<double>("value"), 0.5);
  EXPECT_EQ(worked_out("double", "{D/2} + 2*D").get<double>("value"), 1.25);
  EXPECT_DOUBLE_EQ(worked_out("double", "1e3*area").get<double>("value"), 1e3 * 3.14159265358979324 * 0.25 / 4);
  EXPECT_EQ(worked_out("double", "sqrt(16)").get<double>("value"), 4) << "an expression without variables";
  EXPECT_EQ(worked_out("double", "1/3").get<double>("value"), 1.0 / 3);
  EXPECT_EQ(worked_out("int", "n/2").get<int>("value"), 3);
  EXPECT_EQ(worked_out("bool", "{wet}").get<bool>("value"), true);
  EXPECT_EQ(worked_out("string", "{soil}").get<std::string>("value"), "clay");
  EXPECT_EQ(worked_out("string", "meshes/{file}").get<std::string>("value"), "meshes/clay_6.msh");
  EXPECT_EQ(worked_out("string", "-{2*D}*sin(t)").get<std::string>("value"), "-1*sin(t)");
  EXPECT_EQ(worked_out("string", "3 - {-D}^2*t").get<std::string>("value"), "3 - (-0.5)^2*t") << "signs stay apart";
  EXPECT_EQ(worked_out("string", "D").get<std::string>("value"), "D") << "texts name variables in braces";
  const auto places = worked_out("Array(double)", "{0, -D, {max(D, n)}}").get<Teuchos::Array<double>>("value");
  EXPECT_EQ(places.toVector(), (std::vector<double>{0, -0.5, 6}));
  EXPECT_EQ(worked_out("Array(int)", "{1, 2*n}").get<Teuchos::Array<int>>("value").toVector(),
            (std::vector<int>{1, 12}));
  EXPECT_EQ(worked_out("Array(string)", "{{soil}, sand, n}").get<Teuchos::Array<std::string>>("value").toVector(),
            (std::vector<std::string>{"clay", "sand", "n"}));
}

TEST(Variables, SettingsChangeThemAndUseThem) {
  EXPECT_EQ(worked_out("double", "D/2", {"variables/D=3"}).get<double>("value"), 1.5);
  EXPECT_EQ(worked_out("double", "D/2", {"variables/D=n"}).get<double>("value"), 3);
  EXPECT_EQ(worked_out("double", "D", {"value=2*D"}).get<double>("value"), 1);
  EXPECT_EQ(worked_out("double", "D", {"value=2*{D}*t"}).get<std::string>("value"), "2*0.5*t")
      << "a function replaces a number";
  EXPECT_EQ(worked_out("string", "D", {"value=the {soil}"}).get<std::string>("value"), "the clay");
  EXPECT_EQ(worked_out("string", "D", {"another={soil}"}).get<std::string>("another"), "clay");
  EXPECT_EQ(worked_out("string", "D", {"another={0, D}"}).get<Teuchos::Array<double>>("another")[1], 0.5);
  EXPECT_EQ(worked_out("string", "D", {"another={tip}"}).get<Teuchos::Array<std::string>>("another")[0], "tip");
}

TEST(Variables, MayStandInAnotherFile) {
  Deck deck;
  deck.overlay(deck_text(parameter("D", "double", "1"), parameter("value", "double", "E*D")), "deck.xml");
  deck.overlay(deck_text(parameter("E", "double", "8"), ""), "clay.xml");
  deck.root();
  EXPECT_EQ(deck.list().get<double>("value"), 8);
  EXPECT_EQ(deck.list().sublist("variables").get<double>("E"), 8);
}

TEST(Variables, MistakesAreNamedWithTheirLine) {
  const auto here = [](const std::string& message) { return "deck.xml:10: value: " + message; };
  EXPECT_EQ(error_of("double", "2*d"), here("there is no variable 'd' (did you mean 'D'?)"));
  EXPECT_EQ(error_of("string", "{sol}"), here("there is no variable 'sol' (did you mean 'soil'?)"));
  EXPECT_EQ(error_of("double", "soil"), here("the variable 'soil' is a text, no number"));
  EXPECT_EQ(error_of("double", "D/0"), here("the value of 'D/0' is not finite"));
  EXPECT_EQ(error_of("int", "n/4"), here("expected an integer (int), given 'n/4', which is 1.5"));
  EXPECT_EQ(error_of("Array(int)", "{n, D}"), here("expected an integer (int), given 'D', which is 0.5"));
  EXPECT_EQ(error_of("string", "{D"), here("a '{' that no '}' follows, in '{D'"));
  EXPECT_EQ(error_of("bool", "{D}"), here("expected true or false (bool), given '0.5'"));
  EXPECT_EQ(error_of("double", "D*t"), here("'t' has no value here: only functions, which are of the type string, know "
                                            "time and place"));
}

TEST(Variables, OwnMistakesToo) {
  EXPECT_EQ(error_of_variables(parameter("a", "double", "2*b") + parameter("b", "double", "a")),
            "deck.xml:3: variables/a: the variable is defined by itself: a, by b, by a");
  EXPECT_EQ(error_of_variables(parameter("sin", "double", "1")),
            "deck.xml:3: variables/sin: a variable cannot be called 'sin', which expressions know already");
  EXPECT_EQ(error_of_variables(parameter("2 a", "double", "1")),
            "deck.xml:3: variables/2 a: a variable's name has letters, digits and '_' only, and begins with no digit");
  EXPECT_EQ(error_of_variables(parameter("a", "Array(double)", "{1, 2}")),
            "deck.xml:3: variables/a: an array; a variable is a number, a text or a bool");
  EXPECT_EQ(error_of_variables(section_xml("a", "")),
            "deck.xml:3: variables/a: a section; a variable is a number, a text or a bool");
  EXPECT_EQ(error_of_variables(parameter("a", "double", "1"), parameter("value", "string", "a*t")),
            "deck.xml:3: variables/a: no value names this variable (texts name it in braces, {a})");
}

TEST(Variables, OverlaysAndSettingsNameThemToo) {
  const std::string base = deck_text(parameter("load", "double", "2"), parameter("value", "double", "3*load"));
  const auto error = [&](const std::vector<std::string>& overlays, const std::vector<std::string>& settings) {
    Deck deck;
    deck.overlay(base, "deck.xml");
    for (const std::string& overlay : overlays) deck.overlay(overlay, "over.xml");
    for (const std::string& setting : settings) deck.set(setting);
    return input_error([&] { deck.root(); });
  };
  const std::string misspelt = "no value names this variable (did you mean 'load'?)";
  EXPECT_EQ(error({}, {"variables/laod=5"}), "--set variables/laod=5: variables/laod: " + misspelt);
  EXPECT_EQ(error({deck_text(parameter("laod", "double", "5"), "")}, {}), "over.xml:3: variables/laod: " + misspelt);
  EXPECT_EQ(error({deck_text(parameter("laod", "double", "5"), "")}, {"other=3"}),
            "over.xml:3: variables/laod: " + misspelt);
  const auto valid = [&](const std::vector<std::string>& overlays, const std::vector<std::string>& settings) {
    Deck deck;
    deck.overlay(base, "deck.xml");
    for (const std::string& overlay : overlays) deck.overlay(overlay, "over.xml");
    for (const std::string& setting : settings) deck.set(setting);
    return deck.root().list().get<double>("value");
  };
  EXPECT_EQ(valid({}, {"variables/load=5"}), 15);
  EXPECT_EQ(valid({}, {"value=7"}), 7) << "its only use is replaced";
  EXPECT_EQ(valid({deck_text("", parameter("value", "double", "7"))}, {}), 7);
  EXPECT_EQ(valid({deck_text(parameter("share", "double", "2"), parameter("value", "double", "load*share"))}, {}), 4);
}

TEST(Variables, AMisspeltSectionIsNamed) {
  Deck misspelt;
  misspelt.overlay("<ParameterList>\n" + section_xml("variable", parameter("a", "double", "1")) +
                       parameter("value", "double", "2*a") + "</ParameterList>\n",
                   "deck.xml");
  EXPECT_EQ(input_error([&] { misspelt.root(); }),
            "deck.xml:5: value: expected a number (double), given '2*a'; is the section 'variable' meant to be "
            "'variables'?");
}

}  // namespace
}  // namespace mudline
