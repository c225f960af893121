#pragma once

#include <string>

#include "tensor/vec.hpp"

namespace mudline {

/// A number as a message tells it, by the pattern of printf: "%.3g", or "%.4g Pa".
std::string told(double value, const char* pattern = "%.3g");

/// A number in SI units as a reader likes it: 42130 N is "42.13 kN", 11500 s is "3.194 h". Units that it does not know
/// stay as they are, and shares have three figures.
std::string readable(double value, const std::string& unit, int figures = 4);

/// A range as a reader likes it: "2 to 15.6 kPa", "0.2 to 80 mm", "900 Pa to 2 kPa"; one number where both read alike.
std::string readable_range(double low, double high, const std::string& unit, int figures = 4);

/// "(0.1, -2)", in space with three numbers.
std::string place_text(const Point& point, int dimension);

}  // namespace mudline
