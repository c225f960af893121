#include "core/deck.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/deck_xml.hpp"
#include "core/entry.hpp"
#include "core/errors.hpp"
#include "core/function_types.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

/// Entries of `over` replace those of `base`; sections merge.
void merge(Teuchos::ParameterList& base, Sources& base_sources, const Teuchos::ParameterList& over,
           const Sources& over_sources, const std::string& path) {
  for (auto it = over.begin(); it != over.end(); ++it) {
    const std::string& name = over.name(it);
    const std::string full = join_path(path, name);
    const Teuchos::ParameterEntry& entry = over.entry(it);
    if (base.isParameter(name) && base.isSublist(name) != entry.isList())
      throw InputError(over_sources.at(full) + ": " + full + ": " + (entry.isList() ? "a section" : "a parameter") +
                       " cannot replace the " + (entry.isList() ? "parameter" : "section") + " given at " +
                       base_sources.at(full));
    if (entry.isList()) {
      base_sources.emplace(full, over_sources.at(full));
      merge(base.sublist(name), base_sources, Teuchos::any_cast<Teuchos::ParameterList>(entry.getAny(false)),
            over_sources, full);
    } else {
      base_sources[full] = over_sources.at(full);
      base.setEntry(name, entry);
    }
  }
}

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (begin <= path.size()) {
    const auto slash = std::min(path.find('/', begin), path.size());
    parts.push_back(trim(path.substr(begin, slash - begin)));
    begin = slash + 1;
  }
  return parts;
}

/// A value keeps the type it replaces where it can, so that "3" stays a string; otherwise what reads it later decides
/// (an expression may replace the number of a function).
Teuchos::ParameterEntry replacement(const Teuchos::ParameterList& list, const std::string& name,
                                    const std::string& text) {
  if (list.isParameter(name)) {
    try {
      return make_entry(entry_type(list.getEntry(name)), text);
    } catch (const InputError&) {
      return infer_entry(text);
    }
  }
  return infer_entry(text);
}

void refuse_non_finite(const Teuchos::ParameterEntry& entry, const std::string& position, const std::string& path) {
  if (!entry.isType<std::string>()) return;
  const auto number = parse_number(entry_text(entry));
  if (number && !std::isfinite(*number))
    throw InputError(position + ": " + path + ": expected a finite number, given '" + entry_text(entry) + "'");
}

}  // namespace

void Deck::overlay(const std::string& xml_text, const std::string& file_name) {
  Teuchos::ParameterList list("deck");
  Sources sources;
  read_xml(xml_text, file_name, list, sources);
  if (folder_.empty()) folder_ = std::filesystem::absolute(file_name).parent_path().lexically_normal().string();
  sources_->emplace("", sources.at(""));
  merge(*list_, *sources_, list, sources, "");
}

void Deck::set(const std::string& assignment) {
  const std::string position = "--set " + assignment;
  const auto equals = assignment.find('=');
  if (equals == std::string::npos)
    throw InputError(position + ": expected section/parameter=value, such as stages/push/duration=2.0");
  const std::vector<std::string> names = split_path(assignment.substr(0, equals));
  Teuchos::ParameterList* list = list_.get();
  std::string path;
  bool created = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) throw InputError(position + ": a name of the path before '=' is empty");
    const std::string parent = path;
    path = join_path(path, names[i]);
    if (i + 1 == names.size()) break;
    if (!list->isSublist(names[i])) {
      // A whole section may be left to its defaults ("solver", "output"): then the setting brings it in, and whoever reads
      // the deck refuses a misspelt one. Inside a section that the deck gives, an absent name is a typing error.
      const bool new_section = i == 0 || created;
      const Section section(*list, sources_, nullptr, folder_);
      if (!new_section)
        throw InputError(position + ": " + path + ": the deck has no such section" + suggestion(names[i], section.section_names()));
      created = true;
      (*sources_)[path] = position;
    }
    list = &list->sublist(names[i]);
  }
  if (list->isSublist(names.back()))
    throw InputError(position + ": " + path + ": a section; only parameters can be set");
  const auto entry = replacement(*list, names.back(), trim(assignment.substr(equals + 1)));
  refuse_non_finite(entry, position, path);
  list->setEntry(names.back(), entry);
  (*sources_)[path] = position;
}

Section Deck::root() {
  Registry<FunctionDefinition> types("function");
  register_functions(types);
  const Section bare(*list_, sources_, nullptr, folder_);
  auto functions = std::make_shared<FunctionLibrary>(read_functions(bare.section("functions"), types));
  return Section(*list_, sources_, functions, folder_);
}

std::string Deck::to_xml() const { return write_xml(*list_); }

}  // namespace mudline
