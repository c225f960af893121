#include "core/range.hpp"

#include <limits>

#include "core/text.hpp"

namespace mudline {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

bool Range::contains(double value) const {
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

std::string Range::describe() const {
  if (low == -infinity && high == infinity) return "any";
  return (low_open ? "(" : "[") + number_text(low) + ", " + number_text(high) + (high_open ? ")" : "]");
}

Range any() { return {-infinity, infinity, true, true}; }
Range positive() { return {0.0, infinity, true, true}; }
Range non_negative() { return {0.0, infinity, false, true}; }
Range closed(double low, double high) { return {low, high, false, false}; }
Range at_least(double low) { return {low, infinity, false, true}; }
Range open(double low, double high) { return {low, high, true, true}; }
Range half_open(double low, double high) { return {low, high, false, true}; }

}  // namespace mudline
