#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/parameters.hpp"
#include "core/told.hpp"

namespace mudline {

/// Larger than any quantity; as the upper end of a range it means that there is none.
constexpr double any_size = 1e300;

/// A quantity that plausibility checks judge, with its usual range. Its name is that of the entry of "plausibility"
/// that changes the range.
struct Usual {
  const char* name;
  const char* unit;
  Vec<double, 2> range;  // {lowest, highest}
  const char* meaning;
};

/// The usual ranges of quantities, as the deck may have changed them, and the doubts found so far.
class Doubts {
 public:
  /// Declares a quantity. Throws std::logic_error for a name that is declared already.
  void declare(const Usual& quantity);
  void parameters(Parameters& p);
  /// Whether a value lies within the usual range of the quantity.
  bool usual(const std::string& name, double value) const;
  /// "Pa"; "-" for a quantity without a unit.
  std::string unit(const std::string& name) const { return find(name).unit; }
  double lowest(const std::string& name) const { return find(name).range[0]; }
  double highest(const std::string& name) const { return find(name).range[1]; }
  /// "<what> is 3 m, usual is 0 to 1 m (plausibility/name): <advice>"; "" for what is usual.
  std::string line(const std::string& name, double value, const std::string& what,
                   const std::string& advice = "") const;
  /// Keeps that line, if there is one.
  void judge(const std::string& name, double value, const std::string& what, const std::string& advice = "");
  /// Keeps a doubt that belongs to no quantity.
  void tell(const std::string& line) { lines_.push_back(line); }
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  const Usual& find(const std::string& name) const;

  std::vector<Usual> quantities_;
  std::map<std::string, std::size_t> place_;  // by name
  std::vector<std::string> lines_;
};

}  // namespace mudline
