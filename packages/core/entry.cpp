#include "core/entry.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>

#include "core/text.hpp"

namespace mudline {

namespace {

template <class T>
const T& value_of(const Teuchos::ParameterEntry& entry) {
  return Teuchos::any_cast<T>(entry.getAny(false));  // false: reading it here does not mark it as used
}

bool known(const std::string& type) {
  return std::find(entry_types().begin(), entry_types().end(), type) != entry_types().end();
}

double to_number(const std::string& text, const std::string& expected) {
  const auto number = parse_number(text);
  if (!number) throw InputError("expected " + expected + ", given '" + text + "'");
  if (!std::isfinite(*number)) throw InputError("expected a finite number, given '" + text + "'");
  return *number;
}

int to_integer(const std::string& text, const std::string& expected) {
  const auto number = parse_integer(text);
  if (!number) throw InputError("expected " + expected + ", given '" + text + "'");
  return *number;
}

template <class T, class Convert>
Teuchos::ParameterEntry make_array(const std::string& text, const std::string& expected, Convert convert) {
  const auto items = parse_array(text);
  if (!items) throw InputError("expected " + expected + " such as {1, 2}, given '" + text + "'");
  Teuchos::Array<T> values;
  for (const std::string& item : *items) values.push_back(convert(item));
  return Teuchos::ParameterEntry(values);
}

}  // namespace

const std::vector<std::string>& entry_types() {
  static const std::vector<std::string> types{"double",        "int",        "bool",         "string",
                                              "Array(double)", "Array(int)", "Array(string)"};
  return types;
}

std::ostream& operator<<(std::ostream& out, const Formula& formula) { return out << formula.text; }

std::string entry_type(const Teuchos::ParameterEntry& entry) {
  if (entry.isType<Formula>()) return value_of<Formula>(entry).type;
  if (entry.isType<double>()) return "double";
  if (entry.isType<int>()) return "int";
  if (entry.isType<bool>()) return "bool";
  if (entry.isType<std::string>()) return "string";
  if (entry.isType<Teuchos::Array<double>>()) return "Array(double)";
  if (entry.isType<Teuchos::Array<int>>()) return "Array(int)";
  if (entry.isType<Teuchos::Array<std::string>>()) return "Array(string)";
  return entry.getAny(false).typeName();
}

std::string value_text(double value) { return number_text(value); }
std::string value_text(int value) { return std::to_string(value); }
std::string value_text(bool value) { return value ? "true" : "false"; }
std::string value_text(const std::string& value) { return value; }

std::vector<std::string> section_names(const Teuchos::ParameterList& list) {
  std::vector<std::string> names;
  for (auto it = list.begin(); it != list.end(); ++it)
    if (list.entry(it).isList()) names.push_back(list.name(it));
  return names;
}

std::string entry_text(const Teuchos::ParameterEntry& entry) {
  if (entry.isType<Formula>()) return value_of<Formula>(entry).text;
  if (entry.isType<double>()) return value_text(value_of<double>(entry));
  if (entry.isType<int>()) return value_text(value_of<int>(entry));
  if (entry.isType<bool>()) return value_text(value_of<bool>(entry));
  if (entry.isType<std::string>()) return value_text(value_of<std::string>(entry));
  if (entry.isType<Teuchos::Array<double>>()) return values_text(value_of<Teuchos::Array<double>>(entry));
  if (entry.isType<Teuchos::Array<int>>()) return values_text(value_of<Teuchos::Array<int>>(entry));
  if (entry.isType<Teuchos::Array<std::string>>()) return values_text(value_of<Teuchos::Array<std::string>>(entry));
  return Teuchos::toString(entry.getAny(false));
}

std::string describe_entry(const Teuchos::ParameterEntry& entry) {
  if (entry.isList()) return "a section";
  const std::string text = entry_text(entry);
  if (entry.isType<double>()) return "the number " + text;
  if (entry.isType<int>()) return "the integer " + text;
  if (entry.isType<bool>()) return "the bool " + text;
  if (entry.isType<std::string>()) return "the string '" + text + "'";
  return "the " + entry_type(entry) + " " + text;
}

bool apart(const std::string& source, const std::string& other) {
  return source.substr(0, source.rfind(':')) != other.substr(0, other.rfind(':'));
}

bool mentions(const Teuchos::ParameterList& list, const std::string& word) {
  for (auto it = list.begin(); it != list.end(); ++it) {
    const Teuchos::ParameterEntry& entry = list.entry(it);
    if (entry.isList() && mentions(value_of<Teuchos::ParameterList>(entry), word)) return true;
    if (entry.isType<std::string>() && trim(value_of<std::string>(entry)) == word) return true;
    if (!entry.isType<Teuchos::Array<std::string>>()) continue;
    const auto& words = value_of<Teuchos::Array<std::string>>(entry);
    if (std::find(words.begin(), words.end(), word) != words.end()) return true;
  }
  return false;
}

Teuchos::ParameterEntry make_entry(const std::string& type, const std::string& text) {
  if (type == "double") return Teuchos::ParameterEntry(to_number(text, "a number (double)"));
  if (type == "int") return Teuchos::ParameterEntry(to_integer(text, "an integer (int)"));
  if (type == "bool") {
    const auto value = parse_bool(text);
    if (!value) throw InputError("expected true or false (bool), given '" + text + "'");
    return Teuchos::ParameterEntry(*value);
  }
  if (type == "string") return Teuchos::ParameterEntry(text);
  if (type == "Array(double)")
    return make_array<double>(text, "an array of numbers (Array(double))",
                              [](const std::string& item) { return to_number(item, "a number in the array"); });
  if (type == "Array(int)")
    return make_array<int>(text, "an array of integers (Array(int))",
                           [](const std::string& item) { return to_integer(item, "an integer in the array"); });
  if (type == "Array(string)") {
    const auto items = parse_array(text);
    if (!items) throw InputError("expected an array of strings (Array(string)) such as {a, b}, given '" + text + "'");
    return Teuchos::ParameterEntry(Teuchos::Array<std::string>(*items));
  }
  throw InputError("unknown parameter type '" + type + "'" + suggestion(type, entry_types()));
}

Teuchos::ParameterEntry make_entry_or_formula(const std::string& type, const std::string& text) {
  const bool array = type.rfind("Array(", 0) == 0;
  const std::size_t outer = array ? text.find('{') : std::string::npos;
  const bool braces = text.find('{', outer == std::string::npos ? 0 : outer + 1) != std::string::npos;
  const bool holds_text = type == "string" || type == "Array(string)";
  if (braces && (holds_text || type == "bool")) return Teuchos::ParameterEntry(Formula{type, text});
  try {
    return make_entry(type, text);
  } catch (const InputError&) {
    if (holds_text || type == "bool" || !known(type)) throw;
    return Teuchos::ParameterEntry(Formula{type, text});
  }
}

Teuchos::ParameterEntry infer_entry(const std::string& text) {
  for (const char* type : {"bool", "int", "double", "Array(int)", "Array(double)", "Array(string)"}) {
    try {
      return make_entry(type, text);
    } catch (const InputError&) {
      continue;  // the text does not fit this type; try the next, wider one
    }
  }
  return Teuchos::ParameterEntry(text);
}

}  // namespace mudline
