#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <Tpetra_Core.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "commands.hpp"
#include "contact/laws/slope_check.hpp"
#include "core/foreign_library.hpp"
#include "core/guarded.hpp"
#include "core/log.hpp"
#include "core/text.hpp"
#include "materials/conformance/conformance.hpp"
#include "physics/soil.hpp"
#include "simulation/branch.hpp"
#include "simulation/model.hpp"
#include "simulation/output/history_file.hpp"
#include "simulation/output_settings.hpp"
#include "simulation/plugin.hpp"

namespace mudline::cli {

namespace {

struct NamedTest {
  std::string name;
  std::unique_ptr<PointTest> test;
};

/// The tests of a deck with everything that reading it needs.
struct PointDeck {
  Deck deck;
  Registries registries;
  std::unique_ptr<Section> root;
  OutputSettings output;
  std::vector<PointSoil> soils;
  std::vector<NamedTest> tests;

  std::string path(const NamedTest& test) const {
    std::string file = test.name;
    std::replace(file.begin(), file.end(), ' ', '_');
    return output.stem() + "_" + file + ".csv";
  }
};

/// Reads the materials as a full run would, so that the section serves both.
void read_soils(PointDeck& d) {
  const Section materials = d.root->section("materials");
  materials.allow_parameters({});
  for (const std::string& name : materials.section_names()) {
    const auto soil = SoilMaterial::read(
        materials.section(name),
        {d.registries.skeletons, d.registries.fluids, d.registries.permeabilities, d.registries.properties});
    d.soils.push_back({name, soil->skeleton, [soil](const Point& place) { return soil->void_ratio_at(place); },
                       soil->void_ratio_from_law, soil->biot_coefficient});
  }
  if (d.soils.empty()) d.root->fail("required section 'materials' is missing or empty");
}

const PointSoil& soil_of(const PointDeck& d, const PointTest& test, const Section& section) {
  std::vector<std::string> names;
  for (const PointSoil& soil : d.soils) names.push_back(soil.name);
  if (test.material().empty()) {
    if (d.soils.size() > 1)
      section.fail("required parameter 'material' is missing; the deck has several: " + join(names));
    return d.soils.front();
  }
  for (const PointSoil& soil : d.soils)
    if (soil.name == test.material()) return soil;
  section.fail("unknown material '" + test.material() + "'" + suggestion(test.material(), names), "material");
}

void read_tests(PointDeck& d) {
  const Section tests = d.root->section("tests");
  tests.allow_parameters({});
  for (const std::string& name : tests.section_names()) {
    const Section section = tests.section(name);
    NamedTest test{name, d.registries.point_tests.create(section)};
    for (const NamedTest& other : d.tests)
      if (d.path(other) == d.path(test))
        section.fail("its results would have the name of those of '" + other.name + "': " + d.path(test));
    test.test->begin(soil_of(d, *test.test, section), section);
    d.tests.push_back(std::move(test));
  }
}

void refuse_ranks() {
  if (Tpetra::getDefaultComm()->getSize() > 1)
    throw InputError("a material point cannot be shared: run `mudline point` on one rank");
}

/// The unused parameters of `section` that are not below its sublist `of_a_run`, which joins `idle` where it is given.
std::vector<std::string> unused_beside(const Section& section, const std::string& of_a_run,
                                       std::vector<std::string>& idle) {
  const std::string path = section.section(of_a_run).path();
  if (section.has_section(of_a_run)) idle.push_back(path);
  std::vector<std::string> unused = section.unused();
  const auto below = [&](const std::string& entry) { return entry.compare(0, path.size() + 1, path + "/") == 0; };
  unused.erase(std::remove_if(unused.begin(), unused.end(), below), unused.end());
  return unused;
}

std::unique_ptr<PointDeck> load_point(const Deck& deck, const std::string& name, bool want_tests) {
  auto d = std::make_unique<PointDeck>();
  d->deck = deck;
  const bool branches = !Branch::take(d->deck).empty();
  register_all(d->registries);
  d->root = std::make_unique<Section>(d->deck.root());
  d->root->allow_parameters({});
  std::vector<std::string> known = deck_sections();  // sections of a full run may stand beside the tests
  known.push_back("tests");
  d->root->allow_sections(known);
  load_plugins(d->root->section("plugins"), d->registries);
  d->output = OutputSettings::read(d->root->section("output"), name, d->root->section("bodies").section_names());
  read_soils(*d);
  if (want_tests && !d->root->has_section("tests"))
    d->root->fail("required section 'tests' is missing; see `mudline list test`");
  read_tests(*d);
  if (want_tests && d->tests.empty()) d->root->section("tests").fail("no test is given; see `mudline list test`");
  std::vector<std::string> idle;
  if (branches) idle.emplace_back("branches");
  const std::vector<std::string> read{"variables", "functions", "materials", "tests", "output", "plugins"};
  for (const std::string& name : d->root->section_names()) {
    const std::vector<std::string> unused =
        name == "output" ? unused_beside(d->root->section(name), "observers", idle) : d->root->section(name).unused();
    if (std::find(read.begin(), read.end(), name) == read.end())
      idle.push_back(name);
    else if (!unused.empty())
      d->root->fail("unknown parameter", unused.front());
  }
  if (idle.empty()) refuse_unused_functions(d->deck, *d->root);
  if (!idle.empty()) log::info("not needed here and not read: " + join(idle));
  return d;
}

double value_of(const std::vector<PointValue>& values, const std::string& name) {
  for (const PointValue& v : values)
    if (v.name == name) return v.value;
  return std::nan("");
}

std::string summary(const std::string& name, const PointOutcome& o, const std::string& path) {
  char line[400];
  const auto kpa = [&](const char* column) { return 1e-3 * value_of(o.last, column); };
  std::snprintf(line, sizeof line,
                "%-20s axial strain %8.3f %%  volumetric %8.3f %%  p' %10.3f kPa  q %10.3f kPa  e %.4f", name.c_str(),
                100 * value_of(o.last, "axial strain"), 100 * value_of(o.last, "volumetric strain"),
                kpa("mean effective stress"), kpa("deviatoric stress"), value_of(o.last, "void ratio"));
  std::string text = line;
  if (!std::isnan(value_of(o.last, "excess pore pressure"))) {
    std::snprintf(line, sizeof line, "  u %.3f kPa", kpa("excess pore pressure"));
    text += line;
  }
  text += "  (" + std::to_string(o.steps) + " steps";
  if (o.cuts > 0) text += ", " + std::to_string(o.cuts) + " cuts";
  return text + ", " + path + ")";
}

/// Prints one line per check; true when all pass.
bool conforms(const PointDeck& d, const PointSoil& soil) {
  const std::string type = d.root->section("materials").section(soil.name).section("skeleton").text("type");
  ConformanceLimits limits;
  limits.may_fail = true;  // a law may refuse a large increment: the step is cut
  bool good = true;
  for (const EntryDoc& entry : d.registries.skeletons.document()) {
    if (entry.name != type) continue;
    for (const ConformanceCheck& check : check_conformance(*soil.skeleton, entry, limits)) {
      char line[600];
      std::snprintf(line, sizeof line, "%s: %-15s %-6s %s", soil.name.c_str(), check.name.c_str(),
                    check.passed ? "ok" : "FAILED", check.figures.c_str());
      std::cout << line << std::endl;
      good = good && check.passed;
    }
  }
  return good;
}

/// Checks the laws of the deck's contacts in the same way; true when all pass.
bool contacts_conform(const PointDeck& d) {
  bool good = true;
  const auto tell = [&](const std::string& contact, const char* law, const std::string& problem) {
    std::cout << contact << ": " << law << " slopes " << (problem.empty() ? "ok" : "FAILED " + problem) << std::endl;
    good = good && problem.empty();
  };
  const Section contacts = d.root->section("contacts");
  for (const std::string& name : contacts.section_names()) {
    const Section contact = contacts.section(name);
    if (contact.has_section("friction"))
      tell(name, "friction", slope_problem(*d.registries.frictions.create(contact.section("friction"))));
    if (contact.has_section("normal law"))
      tell(name, "normal law", slope_problem(*d.registries.normal_laws.create(contact.section("normal law"))));
  }
  return good;
}

}  // namespace

void draw(const std::string& kind, const std::string& png, const std::vector<std::string>& files) {
  std::vector<std::string> arguments{kind, png};
  arguments.insert(arguments.end(), files.begin(), files.end());
  std::vector<std::string> command = script_command("report", arguments);
  const std::vector<char*> argv = argv_of(command);
  pid_t child = 0;
  int status = 0;
  if (posix_spawnp(&child, argv[0], nullptr, nullptr, argv.data(), environ) != 0 ||
      waitpid(child, &status, 0) != child || status != 0)
    throw std::runtime_error("the picture could not be drawn; it needs python3 and python3-matplotlib");
}

int point(const PointCommand& command) {
  refuse_ranks();
  if (command.profile && command.conformance) throw InputError("give --profile or --conformance, not both");
  if (!command.profile && !command.at.empty()) throw InputError("--at is the place of a --profile; there is none");
  if (command.profile) return profile(command);
  const auto d = load_point(read_deck(command.deck), result_name(command.deck), !command.conformance);
  check_foreign_code();
  if (command.conformance) {
    if (!command.png.empty()) throw InputError("--conformance draws nothing; give --png without it");
    bool good = true;
    for (const PointSoil& soil : d->soils) good = conforms(*d, soil) && good;
    good = contacts_conform(*d) && good;
    return good ? 0 : 1;
  }
  d->output.make_folder(d->root->section("output"));
  bool complete = true;
  std::vector<std::string> files;
  for (const NamedTest& test : d->tests) {
    HistoryFile file(Tpetra::getDefaultComm(), d->path(test));
    const OpenDescriptors before;
    const PointOutcome outcome = test.test->run([&](double time, const std::vector<PointValue>& values) {
      std::vector<HistoryValue> row;
      for (const PointValue& v : values) row.push_back({v.name, v.unit, v.value});
      file.write(time, row);
    });
    check_foreign_code(&before);
    files.push_back(file.path());
    log::info(summary(test.name, outcome, file.path()));
    if (!outcome.complete) {
      log::warn("test '" + test.name + "' ends early, at t = " + number_text(outcome.time) +
                " s: the law finds no state that follows, however small the increment" +
                (outcome.failure.empty() ? "" : "; " + outcome.failure));
      complete = false;
    }
  }
  warn_of_reported_errors();
  if (!command.png.empty()) draw("--point", command.png, files);
  return complete ? 0 : 3;
}

int check_point(const Deck& deck, const std::string& name) {
  refuse_ranks();
  const auto d = load_point(deck, name, true);
  std::string tests;
  for (const NamedTest& test : d->tests) tests += (tests.empty() ? "" : ", ") + test.name;
  log::info("tests of material points: " + tests);
  log::info("the deck is valid");
  return 0;
}

}  // namespace mudline::cli
