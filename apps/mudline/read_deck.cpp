#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>

#include <algorithm>
#include <filesystem>

#include "commands.hpp"
#include "core/entry.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"

namespace mudline::cli {

namespace {

using Comm = Teuchos::Comm<int>;

/// Text of a file that rank 0 reads, on every rank; a missing file is an error on every rank alike.
std::string read_everywhere(const Comm& comm, const std::string& path) {
  std::string text;
  int length = -1;
  if (comm.getRank() == 0) {
    if (std::optional<std::string> content = file_content(path)) {
      text = std::move(*content);
      length = static_cast<int>(text.size());
    }
  }
  Teuchos::broadcast(comm, 0, 1, &length);
  const std::string with_ending = path + ".xml";
  if (length < 0)
    throw InputError(path + ": the deck does not exist or cannot be read" +
                     (std::filesystem::exists(with_ending) ? " (did you mean '" + with_ending + "'?)" : ""));
  text.resize(length);
  if (length > 0) Teuchos::broadcast(comm, 0, length, text.data());
  return text;
}

}  // namespace

std::string base_deck_file(const std::string& name) { return shared_file("new/decks/" + name + ".xml"); }

std::vector<std::string> base_decks() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(shared_file("new/decks")))
    if (file.path().extension() == ".xml") names.push_back(file.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

Deck read_deck(const DeckOptions& options) {
  Deck deck;
  const auto comm = Tpetra::getDefaultComm();
  for (const std::string& setting : options.settings)  // before the value behind a blank is taken for a deck
    if (setting.find('=') == std::string::npos) Deck().set(setting);
  for (std::size_t i = 0; i < options.decks.size(); ++i) {
    const std::string& path = options.decks[i];
    if (std::count(options.decks.begin(), options.decks.end(), path) > 1)
      throw InputError(path + ": given twice; the files after the deck are overlays, which replace parts of it");
    deck.overlay(read_everywhere(*comm, path), path);
  }
  for (;;) {  // a base may be based on another one
    const std::string entry = "based on", position = deck.position(entry), name = deck.take_text(entry);
    if (name.empty()) break;
    const std::vector<std::string> names = base_decks();
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError(position + ": " + entry + ": the program has no deck '" + name + "'" + suggestion(name, names));
    Deck base;
    base.overlay(read_everywhere(*comm, base_deck_file(name)), base_deck_file(name));
    deck.base_on(base);
  }
  for (const std::string& setting : options.settings) deck.set(setting);
  return deck;
}

std::string result_name(const DeckOptions& options) {
  return std::filesystem::path(options.decks.front()).stem().string();
}

void refuse_unused_functions(const Deck& deck, const Section& root) {
  const std::vector<std::string> sections = root.section_names();
  const auto used = [&](const std::string& name) {
    return mentions(deck.elsewhere(), name) ||
           std::any_of(sections.begin(), sections.end(), [&](const std::string& section) {
             return section != "functions" && mentions(root.section(section).list(), name);
           });
  };
  std::vector<std::string> named, idle;
  for (const std::string& name : root.functions().names()) (used(name) ? named : idle).push_back(name);
  if (idle.empty()) return;
  const std::string near = nearest(idle.front(), named);
  root.section("functions")
      .fail("no entry names this function" + (near.empty() ? "" : " (did you mean '" + near + "'?)"), idle.front());
}

bool is_point_deck(const Deck& deck) { return deck.list().isSublist("tests") && !deck.list().isSublist("mesh"); }

}  // namespace mudline::cli
