#pragma once

#include <string>

namespace mudline {

/// A number as a message tells it, by the pattern of printf: "%.3g", or "%.4g Pa".
std::string told(double value, const char* pattern = "%.3g");

}  // namespace mudline
