#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mudline {

/// A unit of measurement: `factor` SI units (angles in rad).
struct Unit {
  double factor = 1;
  std::array<int, 6> powers{};  // of m, kg, s, K, rad and of a temperature in degrees Celsius
};

/// A unit that is written as a product: "kPa", "kN/m2", "kg/m3", "J/(kg K)", "cm^2", "day", "%". What follows a '/' up
/// to the next blank divides, a group in parentheses wholly; "-" is a number. Nothing where a unit is not known.
std::optional<Unit> parse_unit(const std::string& text);

/// A number with a unit.
struct ValueWithUnit {
  double number;
  Unit unit;
  std::string text;  // as it was written
  /// The number that a deck without units would have: in SI units, but plain angles in degrees.
  double plain() const;
};

/// "2 kPa", "-1.5e3kN/m2"; nothing where the text does not begin with a number or the rest is no unit.
std::optional<ValueWithUnit> parse_quantity(const std::string& text);

/// What is wrong with a number that an unknown unit follows: "; 'dy' is no unit (did you mean 'day'?)"; "" for other
/// texts.
std::string unknown_unit(const std::string& text);

/// The quantity as a number in the unit `declared`, or plain() where that is no unit but words. InputError, without
/// position, where the quantity measures something else.
double number_in(const std::string& declared, const ValueWithUnit& quantity);

/// The items of the values that are given with units, by the path of the parameter; an item may have none.
using ValuesWithUnits = std::map<std::string, std::vector<std::optional<ValueWithUnit>>>;

}  // namespace mudline
