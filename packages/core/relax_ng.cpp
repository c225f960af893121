#include <cmath>
#include <map>
#include <set>

#include "core/documentation.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "core/written_number.hpp"

namespace mudline {

namespace {

// A number that is written otherwise: a name, or a number with an operator behind it, and what follows; or a number
// with a unit that is a product. A plain number is none, so that its range is not passed by, and one with a single unit
// is none, so that its dimension is not. Kept short, because libraries translate a pattern anew wherever it is used.
const std::string follows = R"([A-Za-z0-9_.°%µ\s)(*/^,<>=?:&|!+\-]*)";
const std::string sign = R"([\s(+\-!]*)", number = R"([0-9.]+([eE][\-+]?[0-9]+)?)";
const std::string formula = sign + R"(([A-Za-z_][A-Za-z0-9_]*([\s)(*/^,<>=?:&|+\-])" + follows + ")?|" + number +
                            R"((\s*[)(*/^<>=?:&|+\-]|\s+[A-Za-z%]+[0-9^*/(\s]))" + follows + ")";
const std::string array = R"(\s*\{[^{}]*\}\s*)";
const std::string with_braces = R"(.*\{.*\}.*)";

/// A section that somebody else reads: what stands in it.
struct Passed {
  enum class As {
    type,
    types,
    section,
    sections
  } as;  // a type of a kind, several by name; a documented section, likewise
  std::string kind;
};
const std::map<std::string, Passed>& passed_on() {
  using As = Passed::As;
  static const std::map<std::string, Passed> all{
      {"skeleton", {As::type, "skeleton"}},
      {"fluid", {As::type, "fluid"}},
      {"permeability", {As::type, "permeability"}},
      {"contour", {As::type, "contour"}},
      {"pieces", {As::types, "contour piece"}},
      {"surface", {As::type, "surface"}},
      {"parts", {As::types, "surface"}},
      {"motion", {As::type, "motion"}},
      {"motions", {As::types, "motion"}},
      {"friction", {As::type, "friction"}},
      {"normal law", {As::type, "normal law"}},
      {"interior", {As::type, "mesh motion"}},
      {"remap", {As::type, "remap"}},
      {"plane", {As::type, "mesh"}},
      {"integrator", {As::type, "integrator"}},
      {"time step", {As::section, "time step"}},
      {"strength reduction", {As::section, "strength reduction"}},
      {"ends when", {As::types, "stage end"}},
      {"linear solver", {As::type, "linear solver"}},
      {"filters", {As::sections, "filter"}},
      {"observers", {As::types, "observer"}},
      // sections of the root
      {"mesh", {As::type, "mesh"}},
      {"functions", {As::types, "function"}},
      {"materials", {As::sections, "materials"}},
      {"physics", {As::types, "physics"}},
      {"bodies", {As::sections, "bodies"}},
      {"boundary conditions", {As::types, "boundary condition"}},
      {"contacts", {As::types, "contact"}},
      {"mesh motion", {As::section, "mesh motion"}},
      {"stages", {As::sections, "stages"}},
      {"start", {As::section, "start"}},
      {"solver", {As::section, "solver"}},
      {"output", {As::section, "output"}},
      {"plugins", {As::section, "plugins"}},
      {"plausibility", {As::section, "plausibility"}},
      {"tests", {As::types, "test"}},
  };
  return all;
}
const std::vector<std::string> of_the_root{
    "mesh",   "functions", "materials", "physics", "bodies",  "boundary conditions", "contacts", "mesh motion",
    "stages", "start",     "solver",    "output",  "plugins", "plausibility",        "tests"};

std::string value(const std::string& text) { return "<value type=\"string\">" + xml_escaped(text) + "</value>"; }
std::string data(const std::string& pattern) {
  return "<data type=\"string\"><param name=\"pattern\">" + xml_escaped(pattern) + "</param></data>";
}
/// A plain number within a range as the reference writes it, such as "(0, 0.5]"; any other text is no bound.
std::string number_within(const std::string& range) {
  const std::size_t comma = range.find(", ");
  std::string bounds;
  if (comma != std::string::npos && (range[0] == '(' || range[0] == '[')) {
    const std::string low = range.substr(1, comma - 1), high = range.substr(comma + 2, range.size() - comma - 3);
    const auto bound = [&](const std::string& facet, bool open, const std::string& value) {
      if (std::isfinite(parse_number(value).value_or(HUGE_VAL)))
        bounds += "<param name=\"" + facet + (open ? "Ex" : "In") + "clusive\">" + value + "</param>";
    };
    bound("min", range.front() == '(', low);
    bound("max", range.back() == ')', high);
  }
  return bounds.empty() ? "<data type=\"double\"/>" : "<data type=\"double\">" + bounds + "</data>";
}
/// A number with a single unit that measures what `declared` measures; any unit, where that is no unit but words.
std::string number_with_unit(const std::string& declared) {
  const std::vector<std::string> names = units_like(declared);
  return data(sign + number + (names.empty() ? R"(\s+[A-Za-z%]+)" : R"(\s*()" + join(names, "|") + ")") + R"(\s*)");
}
std::string reference(const std::string& name) { return "<ref name=\"" + name + "\"/>"; }
std::string choice(const std::string& patterns) {
  return patterns.empty() ? "<notAllowed/>" : "<choice>" + patterns + "</choice>";
}
std::string any_number(const std::string& pattern) { return "<zeroOrMore>" + pattern + "</zeroOrMore>"; }
std::string attribute(const std::string& name, const std::string& pattern) {
  return "<attribute name=\"" + name + "\">" + pattern + "</attribute>";
}
std::string section(const std::string& name, const std::string& content) {
  return "<element name=\"ParameterList\">" + attribute("name", name) + content + "</element>";
}

/// One way to write a parameter: types that it may declare, and values of them.
std::string written(const std::string& types, const std::string& values) {
  return "<group>" + attribute("type", types) + attribute("value", values) + "</group>";
}

/// All ways to write a parameter.
std::string parameter(const ParameterDoc& doc) {
  const std::string text = written(value("string"), "<text/>");
  std::string ways = text;
  if (doc.type == "double" || doc.type == "function" || doc.type == "int") {
    ways = written(choice(value("double") + value("int")),
                   choice(number_within(doc.range) + number_with_unit(doc.unit) + data(formula)));
    if (doc.type == "function" || doc.may_vary) ways = choice(ways + text);  // the name of a function
  } else if (doc.type == "bool") {
    ways = written(value("bool"), choice(value("true") + value("false") + data(with_braces)));
  } else if (doc.type == "array of doubles") {
    ways = written(choice(value("Array(double)") + value("Array(int)")), data(array));
  } else if (doc.type == "array of strings") {
    ways = written(value("Array(string)"), data(array));
  } else if (doc.type == "choice") {
    std::string words;
    for (const std::string& word : doc.choices) words += value(word);
    ways = written(value("string"), choice(words + data(with_braces)));
  }
  return "<element name=\"Parameter\">" + attribute("name", value(doc.name)) + ways + "</element>";
}

std::string type_of(const std::string& name) {
  return "<element name=\"Parameter\">" + attribute("name", value("type")) + attribute("type", value("string")) +
         attribute("value", value(name)) + "</element>";
}

/// The names of the patterns, which XML does not allow to be like those of the types.
class Patterns {
 public:
  /// What stands in a section of an entry, in any order.
  std::string entry(const std::string& kind, const std::string& name) { return of("entry", kind + "/" + name); }
  std::string kind(const std::string& kind) { return of("kind", kind); }

 private:
  std::string of(const std::string& what, const std::string& name) {
    return what + std::to_string(numbers_.emplace(what + "/" + name, numbers_.size()).first->second);
  }
  std::map<std::string, std::size_t> numbers_;
};

class Grammar {
 public:
  explicit Grammar(const std::vector<EntryDoc>& entries) : entries_(entries) {
    for (const EntryDoc& entry : entries) kinds_[entry.kind].push_back(&entry);
  }

  std::string text() {
    std::string sections;
    for (const std::string& name : of_the_root) sections += passed(name);
    std::string all = R"(<?xml version="1.0" encoding="UTF-8"?>
<grammar xmlns="http://relaxng.org/ns/structure/1.0" datatypeLibrary="http://www.w3.org/2001/XMLSchema-datatypes">
<start><element name="ParameterList"><optional><attribute name="name"/></optional><ref name="deck"/></element></start>
)";
    all += define("anything", any_number(choice(free_parameter() + section("<text/>", reference("anything")))));
    all += define("variables", any_number(free_parameter()));
    const std::string branch = section("<text/>", any_number(choice(items_of("branches") + reference("deck item"))));
    all +=
        define("deck item", choice(items_of("deck") + sections + section(value("variables"), reference("variables"))));
    all += define("deck", any_number(choice(reference("deck item") + section(value("branches"), any_number(branch)))));
    for (const EntryDoc& entry : entries_) all += define(names_.entry(entry.kind, entry.name), items(entry));
    for (const auto& [kind, members] : kinds_)
      if (kind != "section") all += define(names_.kind(kind), of_kind(members));
    return all + "</grammar>\n";
  }

 private:
  static std::string define(std::string name, const std::string& pattern) {
    return "<define name=\"" + dashed(name) + "\">" + pattern + "</define>\n";
  }
  static std::string dashed(std::string name) {
    for (char& c : name)
      if (c == ' ') c = '-';
    return name;
  }
  static std::string reference(const std::string& name) { return mudline::reference(dashed(name)); }
  static std::string free_parameter() {
    return "<element name=\"Parameter\"><attribute name=\"name\"/><attribute name=\"type\"/><attribute name=\"value\"/>"
           "</element>";
  }

  std::string items_of(const std::string& section) {
    for (const EntryDoc* entry : kinds_["section"])
      if (entry->name == section) return reference(names_.entry("section", section));
    return "";
  }

  /// The section `name` that somebody else reads; where nothing is known of that, it may have anything in it.
  std::string passed(const std::string& name) {
    const auto found = passed_on().find(name);
    if (found == passed_on().end()) return section(value(name), reference("anything"));
    const auto& [as, kind] = found->second;
    const bool typed = as == Passed::As::type || as == Passed::As::types;
    std::string content = typed ? (kinds_.count(kind) ? reference(names_.kind(kind)) : reference("anything"))
                                : any_number(choice(items_of(kind)));
    if (as == Passed::As::types || as == Passed::As::sections) content = any_number(section("<text/>", content));
    return section(value(name), content);
  }

  std::string items(const std::vector<ParameterDoc>& parameters,
                    const std::vector<Parameters::SubsectionDoc>& sections) {
    std::string patterns;
    for (const ParameterDoc& doc : parameters) patterns += parameter(doc);
    for (const auto& own : sections)
      patterns += own.passed_on ? passed(own.name)
                                : section(value(own.name), any_number(choice(items(own.parameters, own.sections))));
    return patterns;
  }
  std::string items(const EntryDoc& entry) {
    std::string patterns = items(entry.parameters, entry.sections);
    // what the readers of these sections take besides
    if (entry.kind == "section" && entry.name == "materials")
      for (const EntryDoc* group : kinds_["property group"])
        patterns += section(value(group->name), any_number(reference(names_.entry("property group", group->name))));
    if (entry.kind == "section" && entry.name == "solver") patterns += passed("linear solver");
    return choice(patterns);
  }

  /// A section whose parameter `type` names one of the entries; in an overlay, which may leave that out, all of their
  /// parameters may stand.
  std::string of_kind(const std::vector<const EntryDoc*>& members) {
    std::string typed, untyped;
    for (const EntryDoc* entry : members) {
      const std::string own = reference(names_.entry(entry->kind, entry->name));
      typed += "<group>" + any_number(own) + type_of(entry->name) + any_number(own) + "</group>";
      untyped += own;
    }
    return choice(typed + any_number(choice(untyped)));
  }

  const std::vector<EntryDoc>& entries_;
  std::map<std::string, std::vector<const EntryDoc*>> kinds_;
  Patterns names_;
};

}  // namespace

std::string relax_ng(const std::vector<EntryDoc>& entries) { return Grammar(entries).text(); }

}  // namespace mudline
