#include "core/deck.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/deck_changes.hpp"
#include "core/deck_xml.hpp"
#include "core/entry.hpp"
#include "core/errors.hpp"
#include "core/function_types.hpp"
#include "core/text.hpp"
#include "core/variables.hpp"

namespace mudline {

namespace {

/// InputError where a variable with a unit gets a value whose unit measures something else: it would be told of at the
/// entries that follow from the variable, if at all.
void refuse_other_unit(const Teuchos::ParameterList& list, const std::string& name, const Teuchos::ParameterEntry& now,
                       const std::string& position, const std::string& path) {
  if (!lies_in(path, "variables") || !list.isParameter(name) || now.isList()) return;
  const auto was = parse_quantity(entry_text(list.getEntry(name))), is = parse_quantity(entry_text(now));
  if (was && is && was->unit.powers != is->unit.powers)
    throw InputError(position + ": " + path + ": given '" + is->text + "', which measures something else than '" +
                     was->text + "', the value that it replaces");
}

/// Adds an entry to a list in which names have no meaning.
void keep(const Teuchos::ParameterEntry& entry, Teuchos::ParameterList& in) {
  in.setEntry("entry " + std::to_string(in.numParams()), entry);
}

/// Entries of `over` replace those of `base`, which are kept in `replaced`; sections merge.
void merge(Teuchos::ParameterList& base, Sources& base_sources, const Teuchos::ParameterList& over,
           const Sources& over_sources, const std::string& path, Teuchos::ParameterList& replaced) {
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
            over_sources, full, replaced);
    } else {
      refuse_other_unit(base, name, entry, over_sources.at(full), full);
      if (base.isParameter(name)) keep(base.getEntry(name), replaced);
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

/// A value keeps the type it replaces where it can, so that "3" stays a string; otherwise its reader decides later (an
/// expression may replace the number of a function).
Teuchos::ParameterEntry replacement(const Teuchos::ParameterList& list, const std::string& name,
                                    const std::string& text) {
  const std::string type = list.isParameter(name) ? entry_type(list.getEntry(name)) : "";
  if (!type.empty()) {
    try {
      const Teuchos::ParameterEntry entry = make_entry_or_formula(type, text);
      return entry.isType<Formula>() ? Teuchos::ParameterEntry(Formula{type, text, true}) : entry;
    } catch (const InputError&) {
      return infer_entry(text);
    }
  }
  const Teuchos::ParameterEntry entry = infer_entry(text);
  if (entry.isType<std::string>() && parse_quantity(text)) return Teuchos::ParameterEntry(Formula{"double", text});
  const bool words = entry.isType<std::string>() || entry_type(entry) == "Array(string)";
  const bool braces = text.find('{') != std::string::npos;
  return words && braces ? Teuchos::ParameterEntry(Formula{type, text, true}) : entry;
}

void refuse_non_finite(const Teuchos::ParameterEntry& entry, const std::string& position, const std::string& path) {
  const auto number = parse_number(entry_text(entry));
  if (number && !std::isfinite(*number))
    throw InputError(position + ": " + path + ": expected a finite number, given '" + entry_text(entry) + "'");
}

/// True where the section, or one in it, names the type of an object.
bool names_a_type(const Teuchos::ParameterList& list) {
  if (list.isParameter("type")) return true;
  for (auto it = list.begin(); it != list.end(); ++it)
    if (list.entry(it).isList() &&
        names_a_type(Teuchos::any_cast<Teuchos::ParameterList>(list.entry(it).getAny(false))))
      return true;
  return false;
}

/// Refuses a section that only settings made, that names no type (so it is no new object) and whose name looks like
/// that of a sibling in the deck.
void refuse_misspelt_settings(const Teuchos::ParameterList& list, const Sources& sources, const std::string& path) {
  const auto is_setting = [&](const std::string& name) {
    return sources.at(join_path(path, name)).rfind("--set ", 0) == 0;
  };
  std::vector<std::string> given;
  for (auto it = list.begin(); it != list.end(); ++it)
    if (list.entry(it).isList() && !is_setting(list.name(it))) given.push_back(list.name(it));
  for (auto it = list.begin(); it != list.end(); ++it) {
    if (!list.entry(it).isList()) continue;
    const auto& inner = Teuchos::any_cast<Teuchos::ParameterList>(list.entry(it).getAny(false));
    const std::string full = join_path(path, list.name(it));
    const std::string near = is_setting(list.name(it)) && !names_a_type(inner) ? nearest(list.name(it), given) : "";
    if (!near.empty())
      throw InputError(sources.at(full) + ": " + full + ": the deck has no such section (did you mean '" + near +
                       "'?)");
    refuse_misspelt_settings(inner, sources, full);
  }
}

}  // namespace

void Deck::overlay(const std::string& xml_text, const std::string& file_name) {
  const std::filesystem::path path = std::filesystem::absolute(file_name);
  if (const std::string bad = unfit(path.string()); !bad.empty())
    throw InputError(path.string() + ": the name of the deck, or of its folder, holds " + bad);
  Deck over;
  read_xml(xml_text, file_name, *over.list_, *over.sources_);
  over.folder_ = path.parent_path().lexically_normal().string();
  overlay(over);
}

void Deck::overlay(const Deck& over) {
  if (folder_.empty()) folder_ = over.folder_;
  sources_->emplace("", over.sources_->at(""));
  merge(*list_, *sources_, *over.list_, *over.sources_, "", elsewhere_);
  for (auto it = over.elsewhere_.begin(); it != over.elsewhere_.end(); ++it)
    keep(over.elsewhere_.entry(it), elsewhere_);
}

void Deck::base_on(const Deck& base) {
  Deck whole;
  whole.folder_ = folder_;
  whole.sources_->emplace("", sources_->at(""));
  whole.overlay(base);
  whole.overlay(*this);
  *this = whole;
}

std::string Deck::take_text(const std::string& name) {
  if (!list_->isParameter(name)) return "";
  const Teuchos::ParameterEntry entry = list_->getEntry(name);
  if (entry.isList() || entry_type(entry) != "string" || entry.isType<Formula>())
    throw InputError(position(name) + ": " + name + ": expected a plain text (type string)");
  list_->remove(name);
  return Teuchos::any_cast<std::string>(entry.getAny(false));
}

Deck Deck::take_section(const std::string& name) {
  Deck taken;
  taken.folder_ = folder_;
  taken.sources_->emplace("", position(name));
  if (!list_->isParameter(name)) return taken;
  if (!list_->isSublist(name)) throw InputError(position(name) + ": " + name + ": expected a section (ParameterList)");
  *taken.list_ = list_->sublist(name);
  for (const auto& [path, source] : *sources_)
    if (path.rfind(name + "/", 0) == 0) taken.sources_->emplace(path.substr(name.size() + 1), source);
  keep(list_->getEntry(name), elsewhere_);
  list_->remove(name);
  return taken;
}

std::string Deck::position(const std::string& path) const {
  const auto found = sources_->find(path);
  if (found != sources_->end()) return found->second;
  const auto slash = path.rfind('/');
  return position(slash == std::string::npos ? "" : path.substr(0, slash));
}

void Deck::set(const std::string& assignment) {
  const std::string position = "--set " + beginning(assignment, 200);
  if (const std::string bad = unfit(assignment); !bad.empty()) throw InputError(position + ": it holds " + bad);
  const auto equals = assignment.find('=');
  if (equals == std::string::npos)
    throw InputError(position + ": expected section/parameter=value, such as stages/push/duration=2.0");
  const std::vector<std::string> names = split_path(assignment.substr(0, equals));
  Teuchos::ParameterList* list = list_.get();
  std::string path;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i].empty()) throw InputError(position + ": a name of the path before '=' is empty");
    path = join_path(path, names[i]);
    if (i + 1 == names.size()) break;
    // The first setting in a missing section adds that section. A misspelt one is refused, at this position, when the
    // deck is read.
    if (list->isParameter(names[i]) && !list->isSublist(names[i]))
      throw InputError(position + ": " + path + ": a parameter; it has no entries of its own");
    if (!list->isSublist(names[i])) (*sources_)[path] = position;
    list = &list->sublist(names[i]);
  }
  if (list->isSublist(names.back()))
    throw InputError(position + ": " + path + ": a section; only parameters can be set");
  const auto entry = replacement(*list, names.back(), trim(assignment.substr(equals + 1)));
  refuse_non_finite(entry, position, path);
  refuse_other_unit(*list, names.back(), entry, position, path);
  if (list->isParameter(names.back())) keep(list->getEntry(names.back()), elsewhere_);
  list->setEntry(names.back(), entry);
  (*sources_)[path] = position;
}

Section Deck::root() {
  refuse_misspelt_settings(*list_, *sources_, "");
  const Variables variables(*list_, *sources_, elsewhere_);
  auto quantities = std::make_shared<ValuesWithUnits>();
  variables.replace_formulas(*list_, *sources_, *quantities);
  Registry<FunctionDefinition> types("function");
  register_functions(types);
  const Teuchos::ParameterEntry* geometry =
      list_->isSublist("mesh") ? list_->sublist("mesh").getEntryPtr("geometry") : nullptr;
  const bool space = geometry != nullptr && geometry->isType<std::string>() &&
                     Teuchos::any_cast<std::string>(geometry->getAny(false)) == geometry_in_space;
  const Section bare(*list_, sources_, std::make_shared<FunctionLibrary>(space ? 3 : 2), folder_, quantities);
  variables.refuse_unused(bare);
  auto functions = std::make_shared<FunctionLibrary>(read_functions(bare.section("functions"), types));
  return Section(*list_, sources_, functions, folder_, quantities);
}

std::string Deck::to_xml() const { return write_xml(*list_); }

}  // namespace mudline
