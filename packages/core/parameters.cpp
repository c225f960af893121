#include "core/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "core/entry.hpp"
#include "core/errors.hpp"
#include "core/text.hpp"
#include "core/unit.hpp"
#include "core/written_number.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// An error in one value, without its position, which the caller adds.
using Fault = InputError;

[[noreturn]] void mismatch(const std::string& expected, const Teuchos::ParameterEntry& entry) {
  throw Fault("expected " + expected + ", given " + describe_entry(entry));
}

template <class T>
const T& used_value(const Teuchos::ParameterEntry& entry) {
  return Teuchos::getValue<T>(entry);
}

void check_range(double value, const std::string& text, const Range& range) {
  if (!std::isfinite(value)) throw Fault(text + " is not finite");
  if (!range.contains(value)) throw Fault(text + " is out of range; allowed: " + range.describe());
}

/// How a text that is an expression becomes a number; "" for other texts.
std::string how_expressions_are_given(const std::string& text) {
  const bool calculates = text.find_first_of("*/+^") != std::string::npos;
  if (!calculates || text.find_first_of("0123456789") == std::string::npos) return "";
  return "; an expression has the type double, and in a setting it stands in braces, \"{" + text + "}\"";
}

void convert(const Teuchos::ParameterEntry& entry, const Range& range, double& member) {
  if (entry.isType<int>()) {
    member = used_value<int>(entry);
  } else if (entry.isType<double>()) {
    member = used_value<double>(entry);
  } else {
    std::string why = entry.isType<std::string>() ? why_no_number(entry_text(entry)) : "";
    if (why.empty()) why = how_expressions_are_given(entry_text(entry));
    throw Fault("expected a number (double), given " + describe_entry(entry) + why);
  }
  check_range(member, number_text(member), range);
}

void convert(const Teuchos::ParameterEntry& entry, const Range& range, int& member) {
  if (!entry.isType<int>()) mismatch("an integer (int)", entry);
  member = used_value<int>(entry);
  check_range(member, std::to_string(member), range);
}

void convert(const Teuchos::ParameterEntry& entry, const Range& /*range*/, bool& member) {
  if (!entry.isType<bool>()) mismatch("true or false (bool)", entry);
  member = used_value<bool>(entry);
}

void convert(const Teuchos::ParameterEntry& entry, const Range& /*range*/, std::string& member) {
  if (!entry.isType<std::string>()) mismatch("a string", entry);
  member = used_value<std::string>(entry);
}

void convert(const Teuchos::ParameterEntry& entry, const Range& range, std::vector<double>& member) {
  if (entry.isType<Teuchos::Array<int>>()) {
    const auto& values = used_value<Teuchos::Array<int>>(entry);
    member.assign(values.begin(), values.end());
  } else if (entry.isType<Teuchos::Array<double>>()) {
    member = used_value<Teuchos::Array<double>>(entry).toVector();
  } else {
    mismatch("an array of numbers (Array(double))", entry);
  }
  for (std::size_t i = 0; i < member.size(); ++i)
    check_range(member[i], number_text(member[i]) + " (entry " + std::to_string(i + 1) + ")", range);
}

void convert(const Teuchos::ParameterEntry& entry, const Range& /*range*/, std::vector<std::string>& member) {
  if (entry.isType<Teuchos::Array<std::string>>()) {
    member = used_value<Teuchos::Array<std::string>>(entry).toVector();
  } else if (entry_text(entry) == "{}") {
    member.clear();  // --set reads "{}" as an array of integers
  } else {
    mismatch("an array of strings (Array(string))", entry);
  }
}

void convert(const Teuchos::ParameterEntry& entry, const Range& range, Vec<double, 2>& member) {
  std::vector<double> values;
  convert(entry, range, values);
  if (values.size() != 2) throw Fault("expected 2 numbers, given " + std::to_string(values.size()));
  std::copy(values.begin(), values.end(), member.begin());
}

/// Unlike other conversions, this one needs the deck's library, for names of functions and for expressions.
Function read_function(const Teuchos::ParameterEntry& entry, const FunctionLibrary& library, const std::string& unit) {
  if (entry.isType<std::string>()) {
    const auto& text = used_value<std::string>(entry);
    const auto quantity = parse_quantity(text);
    return quantity ? Function(number_in(unit, *quantity)) : library.resolve(text, unit);
  }
  if (!entry.isType<double>() && !entry.isType<int>())
    mismatch("a number, an expression or the name of a function", entry);
  double constant = 0.0;
  convert(entry, any(), constant);
  return Function(constant);
}

void require_steady(const Function& function) {
  if (!function.steady())
    throw Fault("'" + function.text() + "' depends on the time; this number may depend on the place only");
}

/// A value that is given with units, in the unit that is declared.
Teuchos::ParameterEntry in_unit(const std::string& unit, const Teuchos::ParameterEntry& entry,
                                const std::vector<std::optional<ValueWithUnit>>& quantities) {
  entry.getAny();  // now it counts as read
  if (entry.isType<double>()) return Teuchos::ParameterEntry(number_in(unit, *quantities.front()));
  auto numbers = used_value<Teuchos::Array<double>>(entry);
  for (std::size_t i = 0; i < quantities.size(); ++i)
    if (quantities[i]) numbers[i] = number_in(unit, *quantities[i]);
  return Teuchos::ParameterEntry(numbers);
}

template <class T>
std::string text_of(const T& value) {
  if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>)
    return value_text(value);
  else
    return values_text(value);
}

const char* type_of(double) { return "double"; }
const char* type_of(int) { return "int"; }
const char* type_of(bool) { return "bool"; }
const char* type_of(const std::string&) { return "string"; }
const char* type_of(const std::vector<double>&) { return "array of doubles"; }
const char* type_of(const Vec<double, 2>&) { return "array of doubles"; }
const char* type_of(const std::vector<std::string>&) { return "array of strings"; }

}  // namespace

Parameters::Parameters(const Section& section) : section_(std::make_shared<Section>(section)) {}

Parameters::Parameters() = default;

void Parameters::declare(ParameterDoc doc) {
  for (const ParameterDoc& known : docs_)
    if (known.name == doc.name) throw std::logic_error("the parameter '" + doc.name + "' is declared twice");
  docs_.push_back(std::move(doc));
}

const Teuchos::ParameterEntry* Parameters::entry(const ParameterDoc& doc) const {
  if (documenting()) return nullptr;
  return section_->list().getEntryPtr(doc.name);  // finish() checks the required ones, when all names are known
}

template <class Read>
void Parameters::read(const ParameterDoc& doc, Read convert_entry) {
  declare(doc);
  const Teuchos::ParameterEntry* found = entry(doc);
  if (found == nullptr) return;
  try {
    const auto* const quantities = section_->quantities(doc.name);
    if (quantities)
      convert_entry(in_unit(doc.unit, *found, *quantities));
    else
      convert_entry(*found);
  } catch (const InputError& fault) {
    section_->fail(fault.what(), doc.name);
  }
}

template <class T>
void Parameters::value(const std::string& name, T& member, const std::string& unit, const Range& range,
                       const std::string& range_text, const std::string& doc, bool required) {
  const std::string default_text = required ? "" : text_of(member);
  read({name, type_of(member), unit, range_text, default_text, doc, required, {}},
       [&](const Teuchos::ParameterEntry& entry) { convert(entry, range, member); });
}

void Parameters::number(const std::string& name, double& member, const std::string& unit, const Range& range,
                        const std::string& doc, bool required) {
  ParameterDoc full{name, type_of(member), unit, range.describe(), required ? "" : text_of(member), doc, required, {}};
  full.may_vary = varying_ != nullptr;
  read(full, [&](const Teuchos::ParameterEntry& entry) {
    const std::string text = entry_text(entry);
    const bool may_be_function =
        varying_ != nullptr && entry.isType<std::string>() && !parse_number(text) && why_no_number(text).empty();
    if (!may_be_function) return convert(entry, range, member);
    const Function function = read_function(entry, section_->functions(), unit);
    require_steady(function);
    if (!function.is_constant()) return varying_->push_back({name, unit, range, function, &member});
    check_range(function(0, {}), function.text(), range);
    member = function(0, {});
  });
}

Function Parameters::function_in(const Teuchos::ParameterEntry& entry, const ParameterDoc& doc,
                                 const Range& range) const {
  const Function function = read_function(entry, section_->functions(), doc.unit);
  if (function.is_constant()) check_range(function(0, {}), function.text(), range);
  return function.within(range, section_->origin(doc.name), section_->dimension());
}

bool Parameters::varies(const std::string& name) const {
  return varying_ != nullptr && std::any_of(varying_->begin(), varying_->end(),
                                            [&](const NumberOfPlace& number) { return number.name == name; });
}

void Parameters::function(const std::string& name, Function& member, const std::string& unit, const std::string& doc,
                          bool required) {
  const ParameterDoc full{name, "function", unit, "", required ? "" : member.text(), doc, required, {}};
  read(full, [&](const Teuchos::ParameterEntry& entry) { member = function_in(entry, full, any()); });
}

void Parameters::point(const std::string& name, Point& member, const std::string& unit, const std::string& doc,
                       bool required) {
  const std::size_t size = dimension();
  const std::vector<double> start(member.begin(), member.begin() + (member[2] == 0 ? 2 : 3));
  read({name, "array of doubles", unit, "2 numbers, in space 3", required ? "" : text_of(start), doc, required, {}},
       [&](const Teuchos::ParameterEntry& entry) {
         std::vector<double> values;
         convert(entry, any(), values);
         if (values.size() != size)
           throw Fault("expected " + std::to_string(size) + " numbers, " +
                       (size == 2 ? "as the mesh's 'geometry' is not '" : "as the mesh's 'geometry' is '") +
                       geometry_in_space + "'; given " + std::to_string(values.size()));
         std::copy(values.begin(), values.end(), member.begin());
       });
}

void Parameters::path(const std::string& name, std::string& member, const std::string& doc, bool required) {
  read({name, "file", "", "", required ? "" : member, doc, required, {}}, [&](const Teuchos::ParameterEntry& entry) {
    std::string given;
    convert(entry, any(), given);
    const auto full = std::filesystem::absolute(std::filesystem::path(section_->folder()) / given).lexically_normal();
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(full, ignored))
      throw Fault("the file '" + given + "' does not exist (looked for " + full.string() + ")" +
                  (given.find('\\') == std::string::npos ? "" : "; folders are separated by '/'"));
    member = full.string();
  });
}

std::size_t Parameters::choose(const std::string& name, std::size_t fallback, const std::vector<std::string>& words,
                               const std::string& doc) {
  std::size_t chosen = fallback;
  read({name, "choice", "", "", words.at(fallback), doc, false, words}, [&](const Teuchos::ParameterEntry& entry) {
    std::string word;
    convert(entry, any(), word);
    const auto found = std::find(words.begin(), words.end(), word);
    if (found == words.end()) throw Fault("'" + word + "' is not a choice" + suggestion(word, words));
    chosen = static_cast<std::size_t>(found - words.begin());
  });
  return chosen;
}

void Parameters::add(const std::string& name, double& member, const std::string& unit, Range range,
                     const std::string& doc) {
  number(name, member, unit, range, doc, false);
}
void Parameters::add(const std::string& name, int& member, const std::string& unit, Range range,
                     const std::string& doc) {
  value(name, member, unit, range, range.describe(), doc, false);
}
void Parameters::add(const std::string& name, bool& member, const std::string& doc) {
  value(name, member, "", any(), "", doc, false);
}
void Parameters::add(const std::string& name, std::string& member, const std::string& doc) {
  value(name, member, "", any(), "", doc, false);
}
void Parameters::add(const std::string& name, std::vector<double>& member, const std::string& unit, Range range,
                     const std::string& doc) {
  value(name, member, unit, range, range.describe(), doc, false);
}
void Parameters::add(const std::string& name, std::vector<std::string>& member, const std::string& doc) {
  value(name, member, "", any(), "", doc, false);
}
void Parameters::add(const std::string& name, Vec<double, 2>& member, const std::string& unit, const std::string& doc) {
  value(name, member, unit, any(), "2 numbers", doc, false);
}
void Parameters::add(const std::string& name, Point& member, const std::string& unit, const std::string& doc) {
  point(name, member, unit, doc, false);
}
void Parameters::add(const std::string& name, Function& member, const std::string& unit, const std::string& doc) {
  function(name, member, unit, doc, false);
}
void Parameters::add_of_place(const std::string& name, Function& member, const std::string& unit, const Range& range,
                              const std::string& doc) {
  const ParameterDoc full{name, "function", unit, range.describe(), member.text(), doc, false, {}};
  read(full, [&](const Teuchos::ParameterEntry& entry) {
    const Function function = function_in(entry, full, range);
    require_steady(function);
    member = function;
  });
}

void Parameters::required(const std::string& name, double& member, const std::string& unit, Range range,
                          const std::string& doc) {
  number(name, member, unit, range, doc, true);
}
void Parameters::required(const std::string& name, int& member, const std::string& unit, Range range,
                          const std::string& doc) {
  value(name, member, unit, range, range.describe(), doc, true);
}
void Parameters::required(const std::string& name, std::string& member, const std::string& doc) {
  value(name, member, "", any(), "", doc, true);
}
void Parameters::required(const std::string& name, std::vector<double>& member, const std::string& unit, Range range,
                          const std::string& doc) {
  value(name, member, unit, range, range.describe(), doc, true);
}
void Parameters::required(const std::string& name, std::vector<std::string>& member, const std::string& doc) {
  value(name, member, "", any(), "", doc, true);
}
void Parameters::required(const std::string& name, Vec<double, 2>& member, const std::string& unit,
                          const std::string& doc) {
  value(name, member, unit, any(), "2 numbers", doc, true);
}
void Parameters::required(const std::string& name, Point& member, const std::string& unit, const std::string& doc) {
  point(name, member, unit, doc, true);
}
void Parameters::required(const std::string& name, Function& member, const std::string& unit, const std::string& doc) {
  function(name, member, unit, doc, true);
}

void Parameters::file(const std::string& name, std::string& member, const std::string& doc) {
  path(name, member, doc, false);
}
void Parameters::required_file(const std::string& name, std::string& member, const std::string& doc) {
  path(name, member, doc, true);
}

void Parameters::passes_on(const std::string& name, const std::string& doc) {
  subsections_.push_back({name, doc, {}, {}, true});
  if (!documenting()) section_->section(name);
}

bool Parameters::given(const std::string& name) const { return !documenting() && section_->has_parameter(name); }

void Parameters::finish() const {
  if (documenting()) return;
  std::vector<std::string> parameters, sections, missing, unknown;
  for (const ParameterDoc& doc : docs_) {
    parameters.push_back(doc.name);
    if (doc.required && !section_->list().isParameter(doc.name)) missing.push_back(doc.name);
  }
  for (const SubsectionDoc& doc : subsections_) sections.push_back(doc.name);
  for (const std::string& name : section_->parameter_names())
    if (std::find(parameters.begin(), parameters.end(), name) == parameters.end()) unknown.push_back(name);
  for (const std::string& name : missing)
    if (!nearest(name, unknown).empty())
      section_->fail("unknown parameter (did you mean '" + name + "'?)", nearest(name, unknown));
  section_->allow_parameters(parameters);
  section_->allow_sections(sections);
  if (!missing.empty()) section_->fail("required parameter '" + missing.front() + "' is missing");
}

}  // namespace mudline
