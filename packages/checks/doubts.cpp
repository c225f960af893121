#include "checks/doubts.hpp"

#include <cmath>
#include <stdexcept>

namespace mudline {

void Doubts::declare(const Usual& quantity) {
  if (!place_.emplace(quantity.name, quantities_.size()).second)
    throw std::logic_error(std::string("two doubts are called '") + quantity.name + "'");
  quantities_.push_back(quantity);
}

void Doubts::parameters(Parameters& p) {
  for (Usual& quantity : quantities_) {
    p.add(quantity.name, quantity.range, quantity.unit, std::string("usual {lowest, highest} ") + quantity.meaning);
    if (!p.documenting() && quantity.range[0] > quantity.range[1])
      p.deck().fail("the first value, the lowest, is above the second", quantity.name);
  }
}

const Usual& Doubts::find(const std::string& name) const {
  const auto found = place_.find(name);
  if (found == place_.end()) throw std::logic_error("no doubt is called '" + name + "'");
  return quantities_[found->second];
}

bool Doubts::usual(const std::string& name, double value) const {
  const auto& range = find(name).range;
  constexpr double rounding = 1e-9;  // of a value at the end of the range that was converted from another unit
  return value >= range[0] - rounding * std::abs(range[0]) && value <= range[1] + rounding * std::abs(range[1]);
}

std::string Doubts::line(const std::string& name, double value, const std::string& what,
                         const std::string& advice) const {
  if (usual(name, value)) return "";
  const Usual& quantity = find(name);
  const double low = quantity.range[0], high = quantity.range[1];
  const std::string unit = quantity.unit;
  const bool pure = unit == "-";
  const std::string given = pure ? told(value, "%.4g") : readable(value, unit);
  const std::string range = high >= any_size ? (pure ? told(low, "%.4g") : readable(low, unit)) + " or more"
                            : pure           ? told(low, "%.4g") + " to " + told(high, "%.4g")
                                             : readable_range(low, high, unit);
  return what + " is " + given + ", usual is " + range + " (plausibility/" + name + ")" +
         (advice.empty() ? "" : ": " + advice);
}

void Doubts::judge(const std::string& name, double value, const std::string& what, const std::string& advice) {
  const std::string found = line(name, value, what, advice);
  if (!found.empty()) lines_.push_back(found);
}

}  // namespace mudline
