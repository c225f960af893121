#pragma once

#include <Teuchos_ParameterList.hpp>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/entry.hpp"
#include "core/section.hpp"

namespace mudline {

/// The entries of the deck's section "variables": numbers, texts and bools that other values name. A variable may be
/// written with others, in any order.
class Variables {
 public:
  /// Reads the section of `deck` and works its entries out. `elsewhere`: what was taken out of the deck or
  /// replaced, whose values may name variables too. InputError with path and line.
  Variables(const Teuchos::ParameterList& deck, const Sources& sources, const Teuchos::ParameterList& elsewhere);

  /// Replaces every formula in the deck by its value: {expression} in texts by its text; numbers are expressions of
  /// variables, with or without braces, or quantities, which are entered in `quantities`. InputError with path and
  /// line.
  void replace_formulas(Teuchos::ParameterList& deck, const Sources& sources, ValuesWithUnits& quantities,
                        const std::string& path = "") const;
  /// InputError for a variable that no value names, here or `elsewhere`. All variables count as read afterwards.
  void refuse_unused(const Section& root) const;

 private:
  struct Number {
    double value;
    std::optional<ValueWithUnit> quantity{};
  };
  struct Value {
    Teuchos::ParameterEntry entry;
    std::vector<std::optional<ValueWithUnit>> quantities{};  // of its items
  };

  void work_out(const std::string& name, const Sources& sources);
  /// Works out the variables that a text names.
  void work_out_words(const std::string& text, const Sources& sources);
  bool any() const { return !numbers_.empty() || !texts_.empty(); }
  /// The value of a setting: of the formula's type, or of the narrowest that it fits.
  Value widest_value(const Formula& formula) const;
  Value value(const Formula& formula) const;
  /// The value of exactly the formula's type.
  Value strict_value(const Formula& formula) const;
  /// InputError where a word of an expression has no value.
  void check_word(const std::string& word) const;
  Number number(const std::string& expression) const;
  int integer(const std::string& expression) const;
  std::string replaced(const std::string& text) const;

  const Teuchos::ParameterList* given_ = nullptr;  // only while variables are worked out
  std::vector<std::string> begun_;                 // likewise, each named by the one before it
  std::set<std::string> words_;                    // of all formulas of the deck
  std::string hint_;                               // added to errors where there are no variables
  std::map<std::string, double> numbers_;
  std::map<std::string, ValueWithUnit> quantities_;  // of the numbers that are given with units
  std::map<std::string, std::string> texts_;         // bools too
};

}  // namespace mudline
