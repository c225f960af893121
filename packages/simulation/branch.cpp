#include "simulation/branch.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "core/deck_changes.hpp"
#include "core/entry.hpp"
#include "core/errors.hpp"
#include "simulation/checkpoint.hpp"

namespace mudline {

namespace {

const std::string section_name = "branches";

/// The name as part of the name of a file: "after a year" -> "after_a_year".
std::string in_file_name(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

}  // namespace

std::vector<Branch> Branch::take(Deck& deck) {
  Deck section = deck.take_section(section_name);
  std::vector<Branch> branches;
  std::set<std::string> files;
  for (auto it = section.list().begin(); it != section.list().end(); ++it)
    if (!section.list().entry(it).isList())
      throw InputError(section.position(section.list().name(it)) + ": " + section_name + "/" + section.list().name(it) +
                       ": a branch is a section, with 'from' and what is different from there on");
  for (const std::string& name : section_names(section.list())) {
    Branch branch;
    branch.name_ = name;
    branch.given_ = section.take_section(name);
    branch.from_ = branch.given_.take_text("from");
    if (branch.from_.empty()) branch.fail("'from', the stage at whose end the branch begins, is missing");
    const auto fits = [](unsigned char c) { return std::isalnum(c) != 0 || c == ' ' || c == '_' || c == '-'; };
    if (!std::all_of(name.begin(), name.end(), fits))
      branch.fail("the name becomes one of files; allowed are letters, digits, blanks, '_' and '-'");
    if (!files.insert(in_file_name(name)).second)
      branch.fail("another branch's results have the same name, '" + in_file_name(name) + "'");
    if (branch.given_.list().isSublist("output") && branch.given_.list().sublist("output").isParameter("name"))
      branch.fail("the results of a branch are named after the run and the branch", "output/name");
    branch.deck_.overlay(deck);
    branch.deck_.overlay(branch.given_);
    branches.push_back(branch);
  }
  return branches;
}

void Branch::document(Parameters& p) {
  std::string from;
  p.required("from", from,
             "the stage at whose end the branch begins. Further entries are those of the deck that are different in "
             "the branch: variables, stages, solver, output, functions and boundary conditions may be");
}

std::string Branch::result_name(const std::string& main) const { return main + "_" + in_file_name(name_); }

void Branch::check(const Deck& main, const Deck& branch) const {
  const std::vector<std::string> stages = section_names(main.list().sublist("stages"));
  const auto start = std::find(stages.begin(), stages.end(), from_);
  if (start == stages.end()) fail("unknown stage '" + from_ + "'" + suggestion(from_, stages), "from");
  if (section_names(branch.list().sublist("stages")).back() == from_)
    fail("there is no stage after '" + from_ + "'", "from");
  for (const DeckChange& change : deck_changes(main.list(), branch.list())) {
    if (!Checkpoint::may_change(Checkpoint::For::start, change.path))
      fail(change.values() + ", but a branch goes on with the model of its run", change.path);
    for (auto stage = stages.begin(); stage <= start; ++stage)
      if (lies_in(change.path, "stages/" + *stage))
        fail(change.values() + ", but that stage is over where the branch begins", change.path);
  }
}

void Branch::fail(const std::string& message, const std::string& path) const {
  throw InputError(given_.position(path) + ": " + section_name + "/" + name_ + (path.empty() ? "" : "/" + path) + ": " +
                   message);
}

}  // namespace mudline
