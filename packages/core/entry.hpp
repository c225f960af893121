#pragma once

#include <Teuchos_ParameterEntry.hpp>
#include <Teuchos_ParameterList.hpp>

#include <ostream>
#include <string>
#include <vector>

#include "core/errors.hpp"

namespace mudline {

/// The types a <Parameter> may declare: double, int, bool, string, Array(double), Array(int), Array(string).
const std::vector<std::string>& entry_types();

/// A value that is written with variables of the deck, such as "{D}/2", until Variables replaces it.
struct Formula {
  std::string type;         // one of entry_types(); "": that which its value fits
  std::string text;         // as it was written
  bool may_differ = false;  // its value may be of another type
  bool operator==(const Formula& other) const { return type == other.type && text == other.text; }
};
std::ostream& operator<<(std::ostream& out, const Formula& formula);

/// One of entry_types(), or the C++ type's name for anything set from code.
std::string entry_type(const Teuchos::ParameterEntry& entry);

/// A value as it would stand in XML: "0.5", "true", "abc".
std::string value_text(double value);
std::string value_text(int value);
std::string value_text(bool value);
std::string value_text(const std::string& value);
/// Values likewise: "{1, 2}".
template <class Items>
std::string values_text(const Items& items) {
  std::vector<std::string> texts;
  for (const auto& item : items) texts.push_back(value_text(item));
  return "{" + join(texts) + "}";
}
/// The value or values of an entry likewise.
std::string entry_text(const Teuchos::ParameterEntry& entry);
/// Names of the sections of a list, in the order of the deck.
std::vector<std::string> section_names(const Teuchos::ParameterList& list);

/// Describes an entry for error messages: "the string 'abc'", "the number 0.5", "a section".
std::string describe_entry(const Teuchos::ParameterEntry& entry);

/// True where two sources (section.hpp) are in different files or on the command line: an overlay or --set may overrule
/// the deck.
bool apart(const std::string& source, const std::string& other);

/// True where a string, or one of several, in the list or below it is `word`.
bool mentions(const Teuchos::ParameterList& list, const std::string& word);

/// The value that `text` stands for; `type` is one of entry_types().
/// Throws InputError without position ("expected a number (double), given 'abc'"); nan and inf are refused.
Teuchos::ParameterEntry make_entry(const std::string& type, const std::string& text);

/// The same, or a Formula where `text` may be one: a text with braces, or a number that is written otherwise.
Teuchos::ParameterEntry make_entry_or_formula(const std::string& type, const std::string& text);

/// The narrowest of bool, int, double, array and string that `text` fits.
Teuchos::ParameterEntry infer_entry(const std::string& text);

}  // namespace mudline
