#include "materials/numbers_of_place.hpp"

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "core/told.hpp"

namespace mudline {

void NumbersOfPlace::settle(const void* law, std::size_t bytes, std::vector<StateVariable>& variables,
                            const std::string& prefix) {
  if (empty()) return;
  const char *begin = static_cast<const char*>(law), *end = begin + bytes;
  const Kokkos::View<std::size_t*> offsets("numbers of place", numbers_.size());
  members_.first = 0;
  for (const StateVariable& variable : variables) members_.first += variable.components;
  for (int k = 0; k < size(); ++k) {
    NumberOfPlace& number = numbers_[k];
    number.name = prefix + number.name;
    const char* member = reinterpret_cast<const char*>(number.number);
    if (std::less<>()(member, begin) || !std::less<>()(member, end))
      throw std::logic_error("the parameter '" + number.name + "' is no member of its law");
    offsets(k) = static_cast<std::size_t>(member - begin);
    const bool taken = std::any_of(variables.begin(), variables.end(),
                                   [&](const StateVariable& variable) { return variable.name == number.name; });
    variables.push_back({(taken ? "initial " : "") + number.name, 1, number.unit, Transfer::value,
                         std::max(number.range.low, -1e300), std::min(number.range.high, 1e300)});
  }
  members_.offsets = offsets;
}

std::string NumbersOfPlace::at(const Point& place, double* values) const {
  for (int k = 0; k < size(); ++k) {
    const NumberOfPlace& number = numbers_[k];
    values[k] = number.function(0, place);
    if (number.range.contains(values[k])) continue;
    return "its '" + number.name + "' is " + told(values[k], "%.6g") + " here; allowed: " + number.range.describe();
  }
  return "";
}

}  // namespace mudline
