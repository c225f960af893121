#include "simulation/old_results.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "core/deck.hpp"
#include "core/deck_changes.hpp"
#include "core/errors.hpp"
#include "core/log.hpp"
#include "simulation/output/collective.hpp"
#include "simulation/output/field_file.hpp"
#include "simulation/run_start.hpp"

namespace mudline {

namespace {

bool exists(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

std::vector<DeckChange> changes_between(const std::string& was, const std::string& now) {
  Deck old, present;
  old.overlay(was, "results");
  present.overlay(now, "deck");
  return deck_changes(old.list(), present.list());
}

/// Whether two decks have the same content, apart from the place of their output.
bool alike(const std::vector<DeckChange>& changes) {
  return std::all_of(changes.begin(), changes.end(), [](const auto& change) { return lies_in(change.path, "output"); });
}

/// Removes old results, on rank 0. Returns why they must stay, or "".
std::string replace(const std::string& stem, const Origin& origin, bool overwrite) {
  const auto metadata = metadata_of(stem);
  const bool others = exists(stem + ".csv") || exists(stem + ".restart");
  if (!metadata && !(others && !exists(stem + ".h5"))) return "";
  Origin old;
  if (metadata)
    for (const auto& [name, text] : *metadata) {
      if (name == "deck") old.deck = text;
      if (name == "deck_file") old.deck_file = text;
      if (name == "program") old.program = text;
    }
  const bool same_file = !old.deck_file.empty() && old.deck_file == origin.deck_file;
  const auto changes = old.deck.empty() ? std::vector<DeckChange>{} : changes_between(old.deck, origin.deck);
  const bool same = same_file || (!old.deck.empty() && alike(changes));
  const std::string whose = !old.deck_file.empty() ? "those of another deck, " + old.deck_file
                            : !old.deck.empty()    ? "those of another deck"
                                                   : "of unknown origin";
  if (!same && !overwrite)
    return stem + ".*: there are results already, " + whose +
           "; give another output/name or output/folder, or replace them by --overwrite";
  if (!same)
    log::warn(stem + ".*: results are replaced: " + whose);
  else
    log::info("replaces the results of an earlier run of this deck" +
              (old.program == origin.program || old.program.empty() ? "" : " by " + old.program) +
              (changes.empty() ? "" : " with other values: " + one_line(changes)));
  return "";
}

}  // namespace

bool has_results(const Teuchos::Comm<int>& comm, const std::string& stem) {
  const bool here = exists(stem + ".restart") || exists(stem + ".csv") || exists(stem + ".h5");
  return !broadcast(raw_communicator(comm), here ? "yes" : "").empty();
}

void make_room(const Teuchos::RCP<const Teuchos::Comm<int>>& comm, const std::string& stem, const Origin& origin,
               bool overwrite) {
  const bool root = comm->getRank() == 0;
  const std::string error = agreed_message(raw_communicator(*comm), root ? replace(stem, origin, overwrite) : "");
  if (!error.empty()) throw InputError(error);
  std::error_code ignored;
  // the fields are removed when the new ones begin
  if (!root) return;
  for (const char* ending : {".csv", ".results.csv", ".restart"}) std::filesystem::remove(stem + ending, ignored);
  for (const std::string& stage : checkpointed_stages(stem))
    std::filesystem::remove(stage_checkpoint(stem, stage), ignored);
}

}  // namespace mudline
