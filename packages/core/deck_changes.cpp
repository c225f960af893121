#include "core/deck_changes.hpp"

#include <algorithm>

#include "core/entry.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

const Teuchos::ParameterList& sublist(const Teuchos::ParameterList& list, const std::string& name) {
  static const Teuchos::ParameterList none;
  return list.isSublist(name) ? list.sublist(name) : none;
}

std::string value(const Teuchos::ParameterList& list, const std::string& name) {
  return list.isParameter(name) && !list.isSublist(name) ? entry_text(list.getEntry(name)) : "";
}

/// Adds the changes of the parameters that only `now` has (`only_new`), or of all that `was` has.
void compare(const Teuchos::ParameterList& was, const Teuchos::ParameterList& now, const std::string& path,
             bool only_new, std::vector<DeckChange>& changes) {
  const Teuchos::ParameterList& names = only_new ? now : was;
  for (auto it = names.begin(); it != names.end(); ++it) {
    const std::string& name = names.name(it);
    const std::string full = join_path(path, name);
    if (names.entry(it).isList()) {
      compare(sublist(was, name), sublist(now, name), full, only_new, changes);
      continue;
    }
    const bool known = was.isParameter(name) && !was.isSublist(name);
    if (only_new && known) continue;
    const std::string before = value(was, name), after = value(now, name);
    if (before == after && now.isParameter(name)) continue;
    changes.push_back({full, before, after});
  }
}

std::string in_one_line(std::string value) {
  if (value.empty()) return "not given";
  std::replace(value.begin(), value.end(), '\n', ' ');
  return value;
}

}  // namespace

std::string DeckChange::text() const { return path + ": " + values(); }

std::string DeckChange::values() const { return in_one_line(now) + ", was " + in_one_line(was); }

std::vector<DeckChange> deck_changes(const Teuchos::ParameterList& was, const Teuchos::ParameterList& now) {
  std::vector<DeckChange> changes;
  compare(was, now, "", false, changes);
  compare(was, now, "", true, changes);
  return changes;
}

std::string one_line(const std::vector<DeckChange>& changes) {
  std::vector<std::string> texts;
  for (const DeckChange& change : changes) texts.push_back(change.text());
  return join(texts, "; ");
}

bool lies_in(const std::string& path, const std::string& section) {
  return path == section || path.rfind(section + "/", 0) == 0;
}

}  // namespace mudline
