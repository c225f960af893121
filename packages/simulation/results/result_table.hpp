#pragma once

#include <string>
#include <vector>

namespace mudline {

/// Name of the share of a body whose forces are told, where only a part of it is modelled.
constexpr const char* modelled_share = "modelled share";

/// One number that a run answers.
struct Result {
  std::string stage;     // "": of the whole run
  std::string of;        // a body, a condition, or what else it belongs to: "pile", "soil"
  std::string quantity;  // "highest resistance"
  std::string unit;      // "N"
  double value;
};

/// The results of a run, in the order in which they were first set. It is the same on all ranks.
class ResultTable {
 public:
  /// Sets a result, or gives it another value. std::invalid_argument for a value that is no finite number.
  void set(const std::string& stage, const std::string& of, const std::string& quantity, const std::string& unit,
           double value);
  /// Removes a result where there is one.
  void remove(const std::string& stage, const std::string& of, const std::string& quantity);
  /// Null where there is none.
  const Result* find(const std::string& stage, const std::string& of, const std::string& quantity) const;
  const std::vector<Result>& all() const { return results_; }

  /// A CSV with a header; numbers are written as in a history.
  std::string csv() const;
  /// Lines from which from_lines() makes the same table; no name in it may have a tab or a line break.
  std::string lines() const;
  /// InputError where the text is none of lines().
  static ResultTable from_lines(const std::string& text);

 private:
  Result* at(const std::string& stage, const std::string& of, const std::string& quantity);

  std::vector<Result> results_;
};

}  // namespace mudline
