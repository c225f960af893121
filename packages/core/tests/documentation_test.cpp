#include "core/documentation.hpp"

#include <gtest/gtest.h>

#include "core/deck.hpp"
#include "core/function_types.hpp"
#include "input_error.hpp"

namespace mudline {
namespace {

class Law {
 public:
  virtual ~Law() = default;
};

struct Control {
  double tolerance = 1e-6;
  void parameters(Parameters& p) { p.add("tolerance", tolerance, "-", positive(), "Relative tolerance"); }
};

enum class Kind { first, second };

struct Elastic : Law {
  double young = 0.0, angle = 30.0;
  Function load;
  Kind kind = Kind::first;
  std::string file;
  Control control;
  void parameters(Parameters& p) {
    p.required("Young's modulus", young, "Pa", positive(), "Stiffness");
    p.add("angle", angle, "deg", half_open(0.0, 90.0), "Friction -- in degrees");
    p.add("load", load, "Pa", "Surface load");
    p.choice("kind", kind, {{"first", Kind::first}, {"second", Kind::second}}, "Which one");
    p.file("mesh file", file, "Mesh");
    p.section("control", control, "Step control");
    p.passes_on("raw", "Raw list");
  }
  void check(const Section& section) const {
    if (angle > 80.0) section.fail("is too steep for this law", "angle");
  }
};

struct OnSite : Law {
  explicit OnSite(int) {}
  static void document(Parameters& p) {
    double depth = 0.0;
    p.required("depth", depth, "m", positive(), "Depth of the site");
  }
  void parameters(Parameters& p) { document(p); }
};

EntryDoc elastic() {
  Registry<Law> laws("law");
  laws.add<Elastic>("elastic", "Hooke's law.");
  return laws.document().at(0);
}

Section parse(Deck& deck, const std::string& xml) {
  deck.overlay("<ParameterList>\n" + xml + "</ParameterList>\n", "deck.xml");
  return deck.root();
}

TEST(Documentation, ExplainAlignsTheTable) {
  EXPECT_EQ(explain(elastic()),
            "elastic (law)\n"
            "  Hooke's law.\n"
            "\n"
            "  parameter        type      unit  range           default   meaning\n"
            "  Young's modulus  double    Pa    (0, inf)        required  Stiffness\n"
            "  angle            double    deg   [0, 90)         30        Friction -- in degrees\n"
            "  load             function  Pa                    0         Surface load\n"
            "  kind             choice          first | second  first     Which one\n"
            "  mesh file        file                                      Mesh\n"
            "\n"
            "  section 'control': Step control\n"
            "    parameter  type    unit  range     default  meaning\n"
            "    tolerance  double  -     (0, inf)  1e-06    Relative tolerance\n"
            "\n"
            "  section 'raw': Raw list (its entries are documented where they are read)\n");
}

TEST(Documentation, MarkdownChapter) {
  const std::string text = markdown(elastic());
  EXPECT_EQ(text.substr(0, text.find("| angle")),
            "## elastic (law)\n\nHooke's law.\n\n"
            "| parameter | type | unit | range | default | meaning |\n|---|---|---|---|---|---|\n"
            "| Young's modulus | double | Pa | (0, inf) | required | Stiffness |\n");
  EXPECT_NE(text.find("first \\| second"), std::string::npos);
  EXPECT_NE(text.find("### Section control\n\nStep control\n\n| parameter"), std::string::npos);
}

TEST(Documentation, TemplateMarksWhatIsRequired) {
  Deck deck;
  EXPECT_EQ(input_error([&] { parse(deck, xml_template(elastic(), 2, "rock")); }),
            "deck.xml:6: rock/Young's modulus: expected a number (double), given ''");
}

TEST(Documentation, FilledTemplateIsADeck) {
  std::string xml = xml_template(elastic(), 2);
  EXPECT_NE(xml.find("<!-- REQUIRED. Stiffness [Pa]; (0, inf) -->"), std::string::npos);
  EXPECT_NE(xml.find("    <!-- <Parameter name=\"mesh file\" type=\"string\" value=\"\"/> -->\n"), std::string::npos);
  const std::string open = "type=\"double\" value=\"\"";
  xml.replace(xml.find(open), open.size(), "type=\"double\" value=\"1e7\"");
  Deck deck;
  Registry<Law> laws("law");
  laws.add<Elastic>("elastic", "Hooke's law.");
  const auto law = laws.create(parse(deck, xml).section("law"));
  EXPECT_EQ(dynamic_cast<const Elastic&>(*law).young, 1e7);
  EXPECT_EQ(dynamic_cast<const Elastic&>(*law).angle, 30.0);
}

TEST(Documentation, SchemaIsWellFormedAndOffersTheNames) {
  const std::string schema = xsd({elastic()});
  Deck deck;  // it gets as far as the root element only when the whole text is well-formed
  EXPECT_EQ(input_error([&] { deck.overlay(schema, "deck.xsd"); }),
            "deck.xsd:2: the root element must be <ParameterList>, given <xs:schema>");
  for (const char* word : {"Array(double)", "Young's modulus", "control", "elastic", "second"})
    EXPECT_NE(schema.find("<xs:enumeration value=\"" + std::string(word) + "\"/>"), std::string::npos) << word;
}

TEST(Documentation, RelaxNgHasTheParametersOfEachType) {
  const std::string schema = relax_ng({elastic()});
  Deck deck;  // as above: well-formed
  EXPECT_EQ(input_error([&] { deck.overlay(schema, "deck.rng"); }),
            "deck.rng:2: the root element must be <ParameterList>, given <grammar>");
  for (const char* word : {"Young's modulus", "control", "elastic", "second", "tolerance", "raw"})
    EXPECT_NE(schema.find("<value type=\"string\">" + std::string(word) + "</value>"), std::string::npos) << word;
}

TEST(Documentation, EveryFunctionTypeIsDescribed) {
  Registry<FunctionDefinition> types("function");
  register_functions(types);
  for (const EntryDoc& entry : types.document()) {
    EXPECT_FALSE(entry.summary.empty());
    for (const ParameterDoc& parameter : entry.parameters) EXPECT_FALSE(parameter.doc.empty()) << parameter.name;
  }
}

TEST(Registry, ReportsUnknownAndMissingTypes) {
  Registry<Law> laws("law");
  laws.add<Elastic>("elastic", "Hooke's law.");
  const auto error = [&](const std::string& type) {
    Deck deck;
    const Section root = parse(deck, "<ParameterList name=\"rock\">\n" + type + "</ParameterList>\n");
    return input_error([&] { laws.create(root.section("rock")); });
  };
  const std::string head = "<Parameter name=\"type\" type=\"string\" value=\"";
  EXPECT_EQ(error(""), "deck.xml:2: rock: required parameter 'type' is missing; known law types: elastic");
  EXPECT_EQ(error(head + "elastik\"/>\n"),
            "deck.xml:3: rock/type: unknown law type 'elastik' (did you mean 'elastic'?); known types: elastic");
  EXPECT_EQ(error(head + "plastic flow\"/>\n"),
            "deck.xml:3: rock/type: unknown law type 'plastic flow'; known types: elastic");
  EXPECT_EQ(error(head + "elastic\"/>\n<Parameter name=\"Young's modulus\" type=\"int\" value=\"1\"/>\n"
                         "<Parameter name=\"angle\" type=\"int\" value=\"85\"/>\n"),
            "deck.xml:5: rock/angle: is too steep for this law");
  EXPECT_THROW(laws.add<Elastic>("elastic", "Again."), std::logic_error);
}

TEST(Registry, PassesContextAndDocumentsWithoutIt) {
  Registry<Law, int> laws("law");
  laws.add<OnSite>("on site", "Needs a context.");
  EXPECT_EQ(laws.document().at(0).parameters.at(0).name, "depth");
  Deck deck;
  const Section root = parse(deck,
                             "<ParameterList name=\"a\"><Parameter name=\"type\" type=\"string\" value=\"on site\"/>"
                             "<Parameter name=\"depth\" type=\"int\" value=\"3\"/></ParameterList>\n");
  EXPECT_NE(laws.create(root.section("a"), 1), nullptr);
}

}  // namespace
}  // namespace mudline
