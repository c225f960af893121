#include "core/deck.hpp"

#include <gtest/gtest.h>

#include "input_error.hpp"

namespace mudline {
namespace {

const std::string header = "<ParameterList name=\"deck\">\n";
const std::string footer = "</ParameterList>\n";

/// The error of a deck whose `body` begins on its second line.
std::string error_of(const std::string& body) {
  Deck deck;
  return input_error([&] {
    deck.overlay(header + body + footer, "deck.xml");
    deck.root();
  });
}

std::string text_error(const std::string& text) {
  Deck deck;
  return input_error([&] { deck.overlay(text, "deck.xml"); });
}

std::string parameter(const std::string& type, const std::string& value) {
  return "<ParameterList name=\"mesh\">\n<Parameter name=\"size\" type=\"" + type + "\" value=\"" + value +
         "\"/>\n</ParameterList>\n";
}

TEST(Deck, ReadsEveryType) {
  Deck deck;
  deck.overlay(header + R"xml(
    <!-- a comment -->
    <Parameter name="d" type="double" value=" 1.5e-3 "/>
    <Parameter name="i" type="int" value="-7"/>
    <Parameter name="b" type="bool" value="true"/>
    <Parameter name="s" type="string" value="a &lt;b&gt; &quot;c&quot;"/>
    <Parameter name="ad" type="Array(double)" value="{1, 2.5}"/>
    <Parameter name="ai" type="Array(int)" value="{1, 2}"/>
    <Parameter name="as" type="Array(string)" value="{top side, bottom}"/>
    <ParameterList name="section"><Parameter name="i" type="int" value="1"/></ParameterList>
    )xml" + footer,
               "deck.xml");
  const auto& list = deck.list();
  EXPECT_EQ(list.get<double>("d"), 1.5e-3);
  EXPECT_EQ(list.get<int>("i"), -7);
  EXPECT_TRUE(list.get<bool>("b"));
  EXPECT_EQ(list.get<std::string>("s"), "a <b> \"c\"");
  EXPECT_EQ(list.get<Teuchos::Array<double>>("ad")[1], 2.5);
  EXPECT_EQ(list.get<Teuchos::Array<int>>("ai")[1], 2);
  EXPECT_EQ(list.get<Teuchos::Array<std::string>>("as")[0], "top side");
  EXPECT_EQ(list.sublist("section").get<int>("i"), 1);
}

TEST(Deck, MalformedXml) {
  EXPECT_EQ(text_error(""), "deck.xml:1: malformed XML: the file is empty");
  EXPECT_EQ(text_error("<!-- nothing -->"), "deck.xml:1: malformed XML: there is no <ParameterList>");
  EXPECT_EQ(text_error("<ParameterList>\n<ParameterList name=\"a\">\n</ParameterList>\n"),
            "deck.xml:1: malformed XML: the file ends inside an element; a closing tag is missing");
  EXPECT_EQ(text_error("<ParameterList>\n<Parameter name=\"a\" type=\"int\" value=\"1\">\n</ParameterList>\n"),
            "deck.xml:2: malformed XML: the element opened here has no matching closing tag");
  EXPECT_EQ(text_error("<ParameterList>\n<Parameter name=a/>\n</ParameterList>\n"),
            "deck.xml:2: malformed XML: an attribute is not written correctly (name=\"value\") or given twice");
  EXPECT_EQ(text_error("<ParameterList>\n<!-- never ends\n</ParameterList>\n"),
            "deck.xml:2: malformed XML: a comment does not end with -->");
  EXPECT_EQ(text_error("plain words"), "deck.xml:1: malformed XML: text that no element closes");
}

TEST(Deck, RootMustBeOneParameterList) {
  EXPECT_EQ(text_error("<Deck/>"), "deck.xml:1: the root element must be <ParameterList>, given <Deck>");
  EXPECT_EQ(text_error("<ParameterList/>\n<ParameterList/>"),
            "deck.xml:2: a second root element; a deck has one <ParameterList>");
}

TEST(Deck, UnknownElementsAttributesAndText) {
  EXPECT_EQ(error_of("<Paramter name=\"a\"/>\n"), "deck.xml:2: unknown element <Paramter> (did you mean 'Parameter'?)");
  EXPECT_EQ(error_of("<ParameterList name=\"mesh\">\n<mesh/></ParameterList>\n"),
            "deck.xml:3: mesh: unknown element <mesh>; allowed: ParameterList, Parameter");
  EXPECT_EQ(error_of("<Parameter name=\"a\" typ=\"int\" value=\"1\"/>\n"),
            "deck.xml:2: a: unknown attribute 'typ' (did you mean 'type'?)");
  EXPECT_EQ(error_of("<ParameterList name=\"mesh\">\n<Parameter name=\"a\" type=\"int\" type=\"int\" value=\"1\"/>\n"
                     "</ParameterList>\n"),
            "deck.xml:3: malformed XML: an attribute is not written correctly (name=\"value\") or given twice");
  EXPECT_EQ(error_of("stray\n"), "deck.xml:2: unexpected text 'stray'");
  EXPECT_EQ(error_of("<Parameter name=\"a\" type=\"int\" value=\"1\">1</Parameter>\n"),
            "deck.xml:2: a: a <Parameter> has no content; its value stands in the attribute 'value'");
}

TEST(Deck, IncompleteEntries) {
  EXPECT_EQ(error_of("<Parameter type=\"int\" value=\"1\"/>\n"), "deck.xml:2: a <Parameter> has no name");
  EXPECT_EQ(error_of("<ParameterList/>\n"), "deck.xml:2: a <ParameterList> has no name");
  EXPECT_EQ(error_of("<Parameter name=\"a\" value=\"1\"/>\n"), "deck.xml:2: a: the parameter has no type");
  EXPECT_EQ(error_of("<Parameter name=\"a\" type=\"int\"/>\n"), "deck.xml:2: a: the parameter has no value");
  EXPECT_EQ(error_of("<ParameterList name=\"a/b\"/>\n"),
            "deck.xml:2: a/b: a name cannot contain '/', which separates sections");
  EXPECT_EQ(error_of("<ParameterList name=\"a \"/>\n"), "deck.xml:2: a : the name begins or ends with a space");
}

TEST(Deck, ValuesMustFitTheDeclaredType) {
  EXPECT_EQ(error_of(parameter("double", "abc")),
            "deck.xml:3: mesh/size: expected a number (double), given 'abc'; the deck has no 'variables' "
            "that define 'abc'");
  EXPECT_EQ(error_of(parameter("double", "1.5 metres")),
            "deck.xml:3: mesh/size: expected a number (double), given '1.5 metres'; 'metres' is no unit (did you mean "
            "'m'?)");
  EXPECT_EQ(error_of(parameter("double", "1.5 ft/day")),
            "deck.xml:3: mesh/size: expected a number (double), given '1.5 ft/day'; 'ft' is no unit: 1 ft is 0.3048 m");
  EXPECT_EQ(error_of(parameter("double", "60 degF")),
            "deck.xml:3: mesh/size: expected a number (double), given '60 degF'; 'degF' is no unit: 1 degF is 5/9 K, "
            "and 32 degF are 0 degC");
  EXPECT_EQ(error_of(parameter("double", "1.5 furlongs")),
            "deck.xml:3: mesh/size: expected a number (double), given '1.5 furlongs'; 'furlongs' is no unit; "
            "allowed: %, GPa, J, K, MJ, MN, MPa, Mg, N, Pa, W, a, bar, cm, d, day, days, deg, degC, g, h, hour, hours, "
            "kJ, kN, kPa, kW, kg, km, m, min, mm, month, months, ms, rad, s, t, um, us, week, weeks, year, years");
  EXPECT_EQ(error_of(parameter("double", "nan")), "deck.xml:3: mesh/size: expected a finite number, given 'nan'");
  EXPECT_EQ(error_of(parameter("double", "-inf")), "deck.xml:3: mesh/size: expected a finite number, given '-inf'");
  EXPECT_EQ(error_of(parameter("int", "1.5")), "deck.xml:3: mesh/size: expected an integer (int), given '1.5'");
  EXPECT_EQ(error_of(parameter("bool", "yes")), "deck.xml:3: mesh/size: expected true or false (bool), given 'yes'");
  EXPECT_EQ(error_of(parameter("Array(double)", "1, 2")),
            "deck.xml:3: mesh/size: expected an array of numbers (Array(double)) such as {1, 2}, given '1, 2'");
  EXPECT_EQ(
      error_of(parameter("Array(double)", "{1, b}")),
      "deck.xml:3: mesh/size: expected a number in the array, given 'b'; the deck has no 'variables' that define 'b'");
  EXPECT_EQ(error_of(parameter("Array(int)", "{1, 2.5}")),
            "deck.xml:3: mesh/size: expected an integer in the array, given '2.5'");
  EXPECT_EQ(error_of(parameter("Array(string)", "a")),
            "deck.xml:3: mesh/size: expected an array of strings (Array(string)) such as {a, b}, given 'a'");
  EXPECT_EQ(error_of(parameter("duble", "1")),
            "deck.xml:3: mesh/size: unknown parameter type 'duble' (did you mean 'double'?)");
}

TEST(Deck, DuplicatesWithinOneFile) {
  const std::string cells = "<Parameter name=\"cells\" type=\"int\" value=\"1\"/>\n";
  EXPECT_EQ(error_of("<ParameterList name=\"mesh\">\n" + cells + "\n" + cells + "</ParameterList>\n"),
            "deck.xml:5: mesh/cells: duplicated parameter (first given at deck.xml:3)");
  EXPECT_EQ(error_of("<ParameterList name=\"mesh\"/>\n<ParameterList name=\"mesh\"/>\n"),
            "deck.xml:3: mesh: duplicated section (first given at deck.xml:2)");
  EXPECT_EQ(error_of("<ParameterList name=\"cells\"/>\n" + cells),
            "deck.xml:3: cells: duplicated parameter (first given at deck.xml:2)");
}

class Overlay : public testing::Test {
 protected:
  Overlay() {
    deck.overlay(header + R"xml(<ParameterList name="stages">
<ParameterList name="push">
<Parameter name="duration" type="double" value="2.0"/>
<Parameter name="steps" type="int" value="10"/>
<Parameter name="title" type="string" value="first"/>
</ParameterList>
</ParameterList>
)xml" + footer,
                 "base.xml");
  }
  const Teuchos::ParameterList& push() const { return deck.list().sublist("stages").sublist("push"); }
  std::string set_error(const std::string& assignment) {
    return input_error([&] { deck.set(assignment); });
  }
  Deck deck;
};

TEST(DeckXml, MessagesStayOneLine) {
  Deck deck;
  EXPECT_EQ(input_error([&] { deck.overlay("<ParameterList>\nlost\n  text\n</ParameterList>", "deck.xml"); }),
            "deck.xml:2: unexpected text 'lost text'");
  EXPECT_EQ(
      input_error([&] {
        deck.overlay("<ParameterList><Parameter name=\"two\nlines\" type=\"int\" value=\"a\nb\"/></ParameterList>",
                     "deck.xml");
        deck.root();
      }),
      "deck.xml:1: two lines: expected an integer (int), given 'a b'; the deck has no 'variables' that define 'a'");
}

TEST_F(Overlay, ReplacesSingleParametersAndMergesSections) {
  deck.overlay(header + R"xml(<ParameterList name="stages">
<ParameterList name="push"><Parameter name="duration" type="double" value="3.0"/></ParameterList>
<ParameterList name="pull"><Parameter name="duration" type="double" value="4.0"/></ParameterList>
</ParameterList>
)xml" + footer,
               "fine.xml");
  EXPECT_EQ(push().get<double>("duration"), 3.0);
  EXPECT_EQ(push().get<int>("steps"), 10);
  const Section stages = deck.root().section("stages");
  EXPECT_EQ(stages.section_names(), (std::vector<std::string>{"push", "pull"}));
  EXPECT_EQ(stages.section("push").source("duration"), "fine.xml:3");
  EXPECT_EQ(stages.section("push").source("steps"), "base.xml:5");
  EXPECT_EQ(stages.section("push").source(), "base.xml:3");
  EXPECT_EQ(stages.section("pull").source(), "fine.xml:4");
}

TEST_F(Overlay, SectionsAndParametersDoNotReplaceEachOther) {
  EXPECT_EQ(input_error([&] {
              deck.overlay(header + "<Parameter name=\"stages\" type=\"int\" value=\"1\"/>" + footer, "fine.xml");
            }),
            "fine.xml:2: stages: a parameter cannot replace the section given at base.xml:2");
  EXPECT_EQ(input_error([&] {
              deck.overlay(header +
                               "<ParameterList name=\"stages\"><ParameterList name=\"push\">\n"
                               "<ParameterList name=\"steps\"/></ParameterList></ParameterList>" +
                               footer,
                           "fine.xml");
            }),
            "fine.xml:3: stages/push/steps: a section cannot replace the parameter given at base.xml:5");
}

TEST_F(Overlay, SetKeepsTheTypeOfWhatItReplaces) {
  deck.set("stages/push/duration=5");
  deck.set(" stages/push/steps = 20 ");
  deck.set("stages/push/title=7");
  EXPECT_EQ(push().get<double>("duration"), 5.0);
  EXPECT_EQ(push().get<int>("steps"), 20);
  EXPECT_EQ(push().get<std::string>("title"), "7");
  deck.set("stages/push/duration=10*t");
  deck.root();
  EXPECT_EQ(push().get<std::string>("duration"), "10*t");
}

TEST_F(Overlay, SetInfersTheTypeOfWhatIsNew) {
  for (const char* assignment : {"b=true", "i=3", "d=3.5", "ai={1, 2}", "ad={1, 2.5}", "as={a, b}", "s=some = words"})
    deck.set(assignment);
  deck.root();
  const auto& list = deck.list();
  EXPECT_TRUE(list.get<bool>("b"));
  EXPECT_EQ(list.get<int>("i"), 3);
  EXPECT_EQ(list.get<double>("d"), 3.5);
  EXPECT_EQ(list.get<Teuchos::Array<int>>("ai").size(), 2);
  EXPECT_EQ(list.get<Teuchos::Array<double>>("ad")[1], 2.5);
  EXPECT_EQ(list.get<Teuchos::Array<std::string>>("as")[1], "b");
  EXPECT_EQ(list.get<std::string>("s"), "some = words");
}

TEST_F(Overlay, SetBringsInAWholeSection) {
  deck.set("solver/newton/maximum iterations=7");
  EXPECT_EQ(deck.list().sublist("solver").sublist("newton").get<int>("maximum iterations"), 7);
}

TEST_F(Overlay, SetBringsInSectionsInAnyOrder) {
  deck.set("stages/push/time step/growth=2");
  deck.set("stages/push/integrator/spectral radius=0.5");
  deck.set("stages/push/integrator/type=newmark");
  EXPECT_EQ(push().sublist("time step").get<int>("growth"), 2);
  EXPECT_EQ(push().sublist("integrator").get<std::string>("type"), "newmark");
  EXPECT_EQ(
      input_error([&] { deck.root().section("stages").section("push").allow_sections({"time steps"}); }),
      "--set stages/push/time step/growth=2: stages/push/time step: unknown section (did you mean 'time steps'?)");
}

TEST_F(Overlay, MisspeltSectionsOfSettings) {
  deck.set("stages/hold/duration=2");
  EXPECT_EQ(input_error([&] { deck.root().section("stages").section("hold").text("type"); }),
            "--set stages/hold/duration=2: stages/hold: required parameter 'type' is missing");
  deck.set("stages/psh/duration=2");
  EXPECT_EQ(input_error([&] { deck.root(); }),
            "--set stages/psh/duration=2: stages/psh: the deck has no such section (did you mean 'push'?)");
  deck.set("stages/psh/type=dynamic");  // then it is a new stage
  EXPECT_EQ(deck.root().section("stages").section("psh").text("type"), "dynamic");
}

TEST_F(Overlay, SetErrors) {
  EXPECT_EQ(set_error("stages/push/steps/more=2"),
            "--set stages/push/steps/more=2: stages/push/steps: a parameter; it has no entries of its own");
  EXPECT_EQ(set_error("stages/push=2"), "--set stages/push=2: stages/push: a section; only parameters can be set");
  EXPECT_EQ(set_error("stages"), "--set stages: expected section/parameter=value, such as stages/push/duration=2.0");
  EXPECT_EQ(set_error("stages//duration=2"), "--set stages//duration=2: a name of the path before '=' is empty");
  EXPECT_EQ(set_error("=2"), "--set =2: a name of the path before '=' is empty");
  EXPECT_EQ(set_error("stages/push/duration=nan"),
            "--set stages/push/duration=nan: stages/push/duration: expected a finite number, given 'nan'");
  deck.set("stages/push/duraton=2");
  EXPECT_EQ(input_error([&] {
              deck.root().section("stages").section("push").allow_parameters({"duration", "steps", "title"});
            }),
            "--set stages/push/duraton=2: stages/push/duraton: unknown parameter (did you mean 'duration'?)");
}

TEST_F(Overlay, ADeckOnABase) {
  Deck base;
  base.overlay(header + "<Parameter name=\"b\" type=\"int\" value=\"1\"/>\n" +
                   "<ParameterList name=\"s\">\n<Parameter name=\"x\" type=\"int\" value=\"1\"/>\n"
                   "<Parameter name=\"y\" type=\"int\" value=\"1\"/>\n</ParameterList>\n" +
                   footer,
               "/far/base.xml");
  Deck own;
  own.overlay(header + "<Parameter name=\"based on\" type=\"string\" value=\"base\"/>\n" +
                  "<ParameterList name=\"s\">\n<Parameter name=\"x\" type=\"int\" value=\"2\"/>\n</ParameterList>\n" +
                  footer,
              "/here/own.xml");
  EXPECT_EQ(own.take_text("based on"), "base");
  EXPECT_EQ(own.take_text("based on"), "");
  own.base_on(base);
  EXPECT_EQ(own.list().sublist("s").get<int>("x"), 2);
  EXPECT_EQ(own.list().sublist("s").get<int>("y"), 1);
  EXPECT_EQ(own.list().get<int>("b"), 1);
  EXPECT_EQ(own.position("s/x"), "/here/own.xml:4");
  EXPECT_EQ(own.position("s/y"), "/far/base.xml:5");
  EXPECT_EQ(own.position("s/z"), own.position("s")) << "of the section around what is not given";
  EXPECT_EQ(own.root().folder(), "/here");
  // the base stays as it was
  EXPECT_EQ(base.list().sublist("s").get<int>("x"), 1);
}

TEST_F(Overlay, ASectionIsTakenOut) {
  Deck deck;
  deck.overlay(header + "<Parameter name=\"p\" type=\"int\" value=\"1\"/>\n<ParameterList name=\"s\">\n" +
                   "<Parameter name=\"x\" type=\"int\" value=\"1\"/>\n</ParameterList>\n" + footer,
               "deck.xml");
  const Deck taken = deck.take_section("s");
  EXPECT_EQ(taken.list().get<int>("x"), 1);
  EXPECT_EQ(taken.position("x"), "deck.xml:4");
  EXPECT_FALSE(deck.list().isParameter("s"));
  EXPECT_EQ(deck.take_section("s").list().numParams(), 0);
  EXPECT_EQ(input_error([&] { deck.take_section("p"); }), "deck.xml:2: p: expected a section (ParameterList)");
  EXPECT_EQ(input_error([&] { deck.take_text("p"); }), "deck.xml:2: p: expected a plain text (type string)");
}

TEST_F(Overlay, AVariableKeepsWhatItMeasures) {
  const auto variables = [](const std::string& value) {
    return header + "<ParameterList name=\"variables\">\n<Parameter name=\"D\" type=\"double\" value=\"" + value +
           "\"/>\n</ParameterList>\n" + footer;
  };
  for (const std::string value : {"50 cm", "0.5", "2*0.25"}) {
    Deck deck;
    deck.overlay(variables("0.4 m"), "base.xml");
    deck.overlay(variables(value), "own.xml");
    deck.set("variables/D=" + value);
  }
  Deck deck;
  deck.overlay(variables("0.4 m"), "base.xml");
  const std::string wrong =
      "variables/D: given '4 kg', which measures something else than '0.4 m', the value that it replaces";
  EXPECT_EQ(input_error([&] { deck.overlay(variables("4 kg"), "own.xml"); }), "own.xml:3: " + wrong);
  EXPECT_EQ(input_error([&] { deck.set("variables/D=4 kg"); }), "--set variables/D=4 kg: " + wrong);
}

TEST(Deck, RoundTripThroughXml) {
  Deck deck;
  deck.overlay(header + R"xml(
    <Parameter name="d" type="double" value="0.1"/>
    <Parameter name="whole" type="double" value="3"/>
    <Parameter name="Young's modulus" type="double" value="1e-300"/>
    <Parameter name="b" type="bool" value="false"/>
    <Parameter name="s" type="string" value="a &lt;b&gt; &amp; &quot;c&quot; 'd'"/>
    <Parameter name="ad" type="Array(double)" value="{0.1, 2}"/>
    <ParameterList name="empty"/>
    <ParameterList name="a">
      <ParameterList name="b"><Parameter name="as" type="Array(string)" value="{}"/></ParameterList>
    </ParameterList>
    )xml" + footer,
               "deck.xml");
  deck.set("a/b/i=5");
  Deck copy;
  copy.overlay(deck.to_xml(), "copy.xml");
  EXPECT_EQ(copy.to_xml(), deck.to_xml());
  EXPECT_TRUE(Teuchos::haveSameValues(copy.list(), deck.list()));
  EXPECT_EQ(copy.list().get<double>("whole"), 3.0);
  EXPECT_EQ(copy.list().get<std::string>("s"), "a <b> & \"c\" 'd'");
}

std::string functions_error(const std::string& body) {
  Deck deck;
  deck.overlay(header + "<ParameterList name=\"functions\">\n" + body + "</ParameterList>\n" + footer, "deck.xml");
  return input_error([&] { deck.root(); });
}

std::string function(const std::string& name, const std::string& type, const std::string& body) {
  return "<ParameterList name=\"" + name + "\">\n<Parameter name=\"type\" type=\"string\" value=\"" + type + "\"/>\n" +
         body + "</ParameterList>\n";
}

TEST(DeckFunctions, ReadsTablesExpressionsAndConstants) {
  Deck deck;
  const std::string times =
      "<Parameter name=\"times\" type=\"Array(double)\" value=\"{0, 2}\"/>\n"
      "<Parameter name=\"values\" type=\"Array(int)\" value=\"{0, 8}\"/>\n";
  deck.overlay(header + "<ParameterList name=\"functions\">\n" + function("linear ramp", "table", times) +
                   function("smooth ramp", "table",
                            times + "<Parameter name=\"interpolation\" type=\"string\" value=\"smooth\"/>\n") +
                   function("wave", "expression", "<Parameter name=\"value\" type=\"string\" value=\"3*t + r\"/>\n") +
                   function("weight", "constant", "<Parameter name=\"value\" type=\"double\" value=\"9.81\"/>\n") +
                   "</ParameterList>\n" + footer,
               "deck.xml");
  const Section root = deck.root();
  const auto value = [&](const std::string& name) { return root.functions().resolve(name)(0.5, {1.0, 0.0, 0.0}); };
  EXPECT_DOUBLE_EQ(value("linear ramp"), 2.0);
  EXPECT_DOUBLE_EQ(value("smooth ramp"), 8.0 * 0.15625);
  EXPECT_DOUBLE_EQ(value("wave"), 2.5);
  EXPECT_DOUBLE_EQ(value("weight"), 9.81);
  EXPECT_TRUE(root.unused().empty());
}

TEST(DeckFunctions, ErrorsNamePathAndLine) {
  EXPECT_EQ(
      functions_error(function("wave", "expression", "<Parameter name=\"value\" type=\"string\" value=\"3*\"/>\n")),
      "deck.xml:5: functions/wave/value: invalid expression '3*': unexpected end of expression at position 3");
  EXPECT_EQ(
      functions_error(function("ramp", "tabel", "")),
      "deck.xml:4: functions/ramp/type: unknown function type 'tabel' (did you mean 'table'?); known types: table, "
      "profile, expression, constant");
  EXPECT_EQ(functions_error(function("t", "constant", "")),
            "deck.xml:3: functions/t: a function cannot be called 't', which is a number or an expression");
  EXPECT_EQ(functions_error("<ParameterList name=\"ramp\"/>\n"),
            "deck.xml:3: functions/ramp: required parameter 'type' is missing; known function types: table, profile, "
            "expression, constant");
  EXPECT_EQ(functions_error("<Parameter name=\"ramp\" type=\"string\" value=\"t\"/>\n"),
            "deck.xml:3: functions/ramp: unknown parameter; none is allowed here");
  const std::string times = "<Parameter name=\"times\" type=\"Array(double)\" value=\"{0, 0}\"/>\n";
  EXPECT_EQ(functions_error(function("ramp", "table",
                                     times + "<Parameter name=\"values\" type=\"Array(double)\" value=\"{1, 2}\"/>\n")),
            "deck.xml:5: functions/ramp/times: 'times' must increase strictly, but 0 follows 0");
  EXPECT_EQ(functions_error(function("ramp", "table",
                                     times + "<Parameter name=\"values\" type=\"Array(double)\" value=\"{1}\"/>\n")),
            "deck.xml:6: functions/ramp/values: 'times' and 'values' must be of the same length, given 2 and 1");
}

}  // namespace
}  // namespace mudline
