#pragma once

#include <string>

namespace mudline {

/// A number as a message tells it, by the pattern of printf: "%.3g", or "%.4g Pa".
std::string told(double value, const char* pattern = "%.3g");

/// A number in SI units as a reader likes it: 42130 N is "42.13 kN", 11500 s is "3.194 h". Units that it does not know
/// stay as they are, and shares have three figures.
std::string readable(double value, const std::string& unit, int figures = 4);

}  // namespace mudline
