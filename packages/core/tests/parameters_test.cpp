#include "core/parameters.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/deck.hpp"
#include "input_error.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

enum class Shape { cone, ball };

struct Control {
  double tolerance = 1e-6;
  int iterations = 0;
  void parameters(Parameters& p) {
    p.add("tolerance", tolerance, "-", positive(), "Relative tolerance of the residual");
    p.required("iterations", iterations, "-", closed(1, 100), "Most iterations of a step");
  }
};

struct Clay {
  double young = 1e7, poisson = 0.3;
  int layers = 2;
  bool drained = true;
  std::string label = "clay";
  std::vector<double> depths{0.0, 1.5};
  std::vector<std::string> sides{"top"};
  Vec<double, 2> origin{0.0, 0.0};
  Function load;
  Shape shape = Shape::ball;
  std::string mesh_file;
  void parameters(Parameters& p) {
    p.required("Young's modulus", young, "Pa", positive(), "Stiffness of the skeleton");
    p.add("Poisson's ratio", poisson, "-", half_open(0.0, 0.5), "Drained ratio");
    p.add("layers", layers, "-", closed(1, 10), "Number of layers");
    p.add("drained", drained, "Whether water may leave");
    p.add("label", label, "Free text");
    p.add("depths", depths, "m", non_negative(), "Depths of the layers");
    p.add("sides", sides, "Names of the sides");
    p.add("origin", origin, "m", "Centre of the layer");
    p.add("load", load, "Pa", "Surface load");
    p.choice("shape", shape, {{"cone", Shape::cone}, {"ball", Shape::ball}}, "Shape of the tip");
    p.file("mesh file", mesh_file, "The mesh to read");
    p.passes_on("raw", "Passed on to the solver");
  }
};

const std::string young = "<Parameter name=\"Young's modulus\" type=\"double\" value=\"2e6\"/>\n";

std::string line(const std::string& name, const std::string& type, const std::string& value) {
  return "<Parameter name=\"" + name + "\" type=\"" + type + "\" value=\"" + value + "\"/>\n";
}

/// Reads a Clay at materials/clay (line 3); the lines of `body` begin at 4.
template <class T = Clay>
T read(const std::string& body, const std::string& folder = "") {
  Deck deck;
  deck.overlay("<ParameterList>\n<ParameterList name=\"materials\">\n<ParameterList name=\"clay\">\n" + body +
                   "</ParameterList>\n</ParameterList>\n</ParameterList>\n",
               folder + "deck.xml");
  Parameters p(deck.root().section("materials").section("clay"));
  T object;
  object.parameters(p);
  p.finish();
  return object;
}

std::string error_of(const std::string& body) {
  return input_error([&] { read(body); });
}

std::string error_with(const std::string& name, const std::string& type, const std::string& value) {
  return error_of(young + line(name, type, value));
}

TEST(Parameters, DefaultsStayWhenNothingIsGiven) {
  const Clay clay = read(young);
  EXPECT_EQ(clay.young, 2e6);
  EXPECT_EQ(clay.poisson, 0.3);
  EXPECT_EQ(clay.depths, (std::vector<double>{0.0, 1.5}));
  EXPECT_EQ(clay.shape, Shape::ball);
  EXPECT_TRUE(clay.load.is_zero());
}

TEST(Parameters, ReadsEveryKind) {
  const Clay clay = read(
      line("Young's modulus", "int", "5") + line("Poisson's ratio", "double", "0.25") + line("layers", "int", "3") +
      line("drained", "bool", "false") + line("label", "string", "soft") + line("depths", "Array(int)", "{1, 2, 3}") +
      line("sides", "Array(string)", "{left, right}") + line("origin", "Array(double)", "{1.5, 2.5}") +
      line("load", "string", "2*t") + line("shape", "string", "cone") + "<ParameterList name=\"raw\">" +
      line("anything", "int", "1") + "</ParameterList>\n");
  EXPECT_EQ(clay.young, 5.0);
  EXPECT_EQ(clay.poisson, 0.25);
  EXPECT_EQ(clay.layers, 3);
  EXPECT_FALSE(clay.drained);
  EXPECT_EQ(clay.label, "soft");
  EXPECT_EQ(clay.depths, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(clay.sides, (std::vector<std::string>{"left", "right"}));
  EXPECT_EQ(clay.origin, (Vec<double, 2>{1.5, 2.5}));
  EXPECT_EQ(clay.load(2.0, {}), 4.0);
  EXPECT_EQ(clay.shape, Shape::cone);
}

TEST(Parameters, FunctionsMayBeNumbers) {
  EXPECT_EQ(read(young + line("load", "int", "3")).load(0.0, {}), 3.0);
  EXPECT_EQ(read(young + line("load", "double", "3.5")).load(0.0, {}), 3.5);
  EXPECT_EQ(read(young + line("load", "string", "4.5")).load(0.0, {}), 4.5);
}

TEST(Parameters, UnknownAndMissingOnes) {
  EXPECT_EQ(error_of(young + line("Poissons ratio", "double", "0.3")),
            "deck.xml:5: materials/clay/Poissons ratio: unknown parameter (did you mean 'Poisson's ratio'?)");
  EXPECT_EQ(error_of(young + line("Label", "string", "x")),
            "deck.xml:5: materials/clay/Label: unknown parameter (did you mean 'label'?)");
  EXPECT_EQ(error_of(young + "<ParameterList name=\"rwa\"/>\n"),
            "deck.xml:5: materials/clay/rwa: unknown section (did you mean 'raw'?)");
  EXPECT_EQ(error_of(""), "deck.xml:3: materials/clay: required parameter 'Young's modulus' is missing");
}

TEST(Parameters, MisspeltRequiredOnesAreNamedAtTheirLine) {
  EXPECT_EQ(error_of(line("label", "string", "x") + line("Yuong's modulus", "double", "2e6")),
            "deck.xml:5: materials/clay/Yuong's modulus: unknown parameter (did you mean 'Young's modulus'?)");
  // nothing like it: the unknown one first, it may be what is missing
  EXPECT_EQ(
      error_of(line("stiff", "double", "2e6")).find("deck.xml:4: materials/clay/stiff: unknown parameter; allowed: "),
      0u);
}

TEST(Parameters, OutOfRange) {
  EXPECT_EQ(error_with("Poisson's ratio", "double", "0.6"),
            "deck.xml:5: materials/clay/Poisson's ratio: 0.6 is out of range; allowed: [0, 0.5)");
  EXPECT_EQ(error_with("Poisson's ratio", "double", "0.5"),
            "deck.xml:5: materials/clay/Poisson's ratio: 0.5 is out of range; allowed: [0, 0.5)");
  EXPECT_EQ(error_with("layers", "int", "11"),
            "deck.xml:5: materials/clay/layers: 11 is out of range; allowed: [1, 10]");
  EXPECT_EQ(error_with("depths", "Array(double)", "{1, -2}"),
            "deck.xml:5: materials/clay/depths: -2 (entry 2) is out of range; allowed: [0, inf)");
  EXPECT_EQ(error_of(line("Young's modulus", "double", "0")),
            "deck.xml:4: materials/clay/Young's modulus: 0 is out of range; allowed: (0, inf)");
}

TEST(Parameters, WrongType) {
  const std::string where = "deck.xml:5: materials/clay/";
  EXPECT_EQ(error_with("Poisson's ratio", "string", "abc"),
            where + "Poisson's ratio: expected a number (double), given the string 'abc'");
  EXPECT_EQ(error_with("layers", "double", "2"), where + "layers: expected an integer (int), given the number 2");
  EXPECT_EQ(error_with("drained", "int", "1"), where + "drained: expected true or false (bool), given the integer 1");
  EXPECT_EQ(error_with("label", "bool", "true"), where + "label: expected a string, given the bool true");
  EXPECT_EQ(error_with("depths", "double", "1"),
            where + "depths: expected an array of numbers (Array(double)), given the number 1");
  EXPECT_EQ(error_with("sides", "Array(int)", "{1, 2}"),
            where + "sides: expected an array of strings (Array(string)), given the Array(int) {1, 2}");
  EXPECT_EQ(error_with("origin", "Array(double)", "{1, 2, 3}"), where + "origin: expected 2 numbers, given 3");
  EXPECT_EQ(error_with("load", "bool", "true"),
            where + "load: expected a number, an expression or the name of a function, given the bool true");
  EXPECT_EQ(error_with("load", "string", "2*"),
            where + "load: invalid expression '2*': unexpected end of expression at position 3");
  EXPECT_EQ(error_of(young + "<ParameterList name=\"layers\"/>\n"),
            where + "layers: expected an integer (int), given a section");
  EXPECT_EQ(error_with("raw", "int", "1"), where + "raw: expected a section (ParameterList), given the integer 1");
}

TEST(Parameters, ChoicesNameTheWords) {
  EXPECT_EQ(error_with("shape", "string", "Cone"),
            "deck.xml:5: materials/clay/shape: 'Cone' is not a choice (did you mean 'cone'?)");
  EXPECT_EQ(error_with("shape", "string", "square"),
            "deck.xml:5: materials/clay/shape: 'square' is not a choice; allowed: cone, ball");
  EXPECT_EQ(error_with("shape", "int", "1"),
            "deck.xml:5: materials/clay/shape: expected a string, given the integer 1");
}

TEST(Parameters, FilesStartAtTheDecksFolder) {
  const std::string name = "mudline core test " + std::to_string(getpid());
  const auto folder = std::filesystem::temp_directory_path() / name;
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "box.msh") << "mesh";
  const Clay clay = read(young + line("mesh file", "string", "../" + name + "/box.msh"), folder.string() + "/");
  EXPECT_EQ(clay.mesh_file, (folder / "box.msh").string());
  const std::string error = error_with("mesh file", "string", "absent.msh");
  EXPECT_EQ(error.substr(0, error.find(" (looked")),
            "deck.xml:5: materials/clay/mesh file: the file 'absent.msh' does not exist");
  std::filesystem::remove_all(folder);
}

struct Stage {
  double duration = 0.0;
  Control control;
  void parameters(Parameters& p) {
    p.required("duration", duration, "s", positive(), "Length of the stage");
    p.section("control", control, "When to stop iterating");
  }
};

TEST(Parameters, FixedSectionsAreReadAndChecked) {
  const std::string duration = line("duration", "double", "2");
  const Stage stage = read<Stage>(duration + "<ParameterList name=\"control\">" + line("iterations", "int", "9") +
                                  "</ParameterList>\n");
  EXPECT_EQ(stage.control.iterations, 9);
  EXPECT_EQ(stage.control.tolerance, 1e-6);
  EXPECT_EQ(input_error([&] { read<Stage>(duration); }),
            "deck.xml:3: materials/clay/control: required parameter 'iterations' is missing");
  EXPECT_EQ(input_error([&] {
              read<Stage>(duration + "<ParameterList name=\"control\">\n" + line("iterations", "int", "9") +
                          line("tolerence", "double", "1") + "</ParameterList>\n");
            }),
            "deck.xml:7: materials/clay/control/tolerence: unknown parameter (did you mean 'tolerance'?)");
}

TEST(Parameters, GivenAndDocumenting) {
  Deck deck;
  deck.overlay("<ParameterList>" + line("a", "int", "1") + "</ParameterList>", "deck.xml");
  const Parameters reading(deck.root());
  EXPECT_FALSE(reading.documenting());
  EXPECT_TRUE(reading.given("a"));
  EXPECT_FALSE(reading.given("b"));
  const Parameters documenting;
  EXPECT_TRUE(documenting.documenting());
  EXPECT_FALSE(documenting.given("a"));
  documenting.finish();
}

TEST(Parameters, DocumentWhatTheyDeclare) {
  Parameters p;
  Clay clay;
  clay.parameters(p);
  ASSERT_EQ(p.docs().size(), 11U);
  const auto& stiffness = p.docs()[0];
  EXPECT_EQ(stiffness.name, "Young's modulus");
  EXPECT_EQ(stiffness.type, "double");
  EXPECT_EQ(stiffness.unit, "Pa");
  EXPECT_EQ(stiffness.range, "(0, inf)");
  EXPECT_TRUE(stiffness.required);
  EXPECT_EQ(stiffness.default_text, "");
  std::vector<std::string> types, defaults;
  for (const auto& doc : p.docs()) {
    types.push_back(doc.type);
    defaults.push_back(doc.default_text);
  }
  EXPECT_EQ(types, (std::vector<std::string>{"double", "double", "int", "bool", "string", "array of doubles",
                                             "array of strings", "array of doubles", "function", "choice", "file"}));
  EXPECT_EQ(defaults,
            (std::vector<std::string>{"", "0.3", "2", "true", "clay", "{0, 1.5}", "{top}", "{0, 0}", "0", "ball", ""}));
  EXPECT_EQ(p.docs()[9].choices, (std::vector<std::string>{"cone", "ball"}));
  ASSERT_EQ(p.sections().size(), 1U);
  EXPECT_TRUE(p.sections()[0].passed_on);
  double twice = 0.0;
  EXPECT_THROW(p.add("layers", twice, "-", any(), "Again"), std::logic_error);
}

TEST(Range, DescribesAndContains) {
  EXPECT_EQ(any().describe(), "any");
  EXPECT_EQ(positive().describe(), "(0, inf)");
  EXPECT_EQ(non_negative().describe(), "[0, inf)");
  EXPECT_EQ(closed(-1.0, 2.5).describe(), "[-1, 2.5]");
  EXPECT_EQ(open(0.0, 1.0).describe(), "(0, 1)");
  EXPECT_EQ(half_open(0.0, 0.5).describe(), "[0, 0.5)");
  EXPECT_TRUE(closed(0.0, 1.0).contains(1.0));
  EXPECT_FALSE(open(0.0, 1.0).contains(1.0));
  EXPECT_TRUE(half_open(0.0, 1.0).contains(0.0));
  EXPECT_FALSE(half_open(0.0, 1.0).contains(1.0));
  EXPECT_FALSE(positive().contains(0.0));
  EXPECT_TRUE(non_negative().contains(0.0));
}

}  // namespace
}  // namespace mudline
