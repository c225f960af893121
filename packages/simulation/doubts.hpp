#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/parameters.hpp"

namespace mudline {

/// Larger than any quantity: "so much or more" is usual.
constexpr double any_size = 1e300;

/// A quantity by which a model is doubted. Its name is that of the entry of "plausibility" that changes what is usual.
struct Usual {
  const char* name;
  const char* unit;
  Vec<double, 2> range;  // {lowest, highest}
  const char* meaning;
};

/// What is usual of the quantities of some groups of checks, as the deck may have changed it, and the doubts so far.
class Doubts {
 public:
  /// std::logic_error for a name that is there already.
  void declare(const Usual& quantity);
  void parameters(Parameters& p);
  /// Whether a value is within what is usual of the quantity.
  bool usual(const std::string& name, double value) const;
  /// " Pa", or "" for a quantity without a unit.
  std::string unit_behind(const std::string& name) const;
  double lowest(const std::string& name) const { return find(name).range[0]; }
  double highest(const std::string& name) const { return find(name).range[1]; }
  /// "<what> is 3 m, usual is 0 to 1 (plausibility/name): <advice>"; "" for what is usual.
  std::string line(const std::string& name, double value, const std::string& what,
                   const std::string& advice = "") const;
  /// Keeps that line, if there is one.
  void judge(const std::string& name, double value, const std::string& what, const std::string& advice = "");
  /// Keeps a doubt that is no matter of a quantity.
  void tell(const std::string& line) { lines_.push_back(line); }
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  const Usual& find(const std::string& name) const;

  std::vector<Usual> quantities_;
  std::map<std::string, std::size_t> place_;  // by name
  std::vector<std::string> lines_;
};

/// Numbers in a text, "%.3g" by default.
std::string told(double value, const char* pattern = "%.3g");

}  // namespace mudline
