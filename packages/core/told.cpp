#include "core/told.hpp"

#include <cmath>
#include <cstdio>
#include <utility>

namespace mudline {

std::string told(double value, const char* pattern) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, pattern, value);
  return buffer;
}

std::string readable(double value, const std::string& unit, int figures) {
  struct Scale {
    const char* unit;    // of the value
    double least, size;  // magnitude from which on it is used, and one of it [unit]
    const char* name;
  };
  static constexpr Scale scales[] = {
      {"s", 2 * 31557600.0, 31557600.0, "years"},
      {"s", 2 * 86400.0, 86400.0, "days"},
      {"s", 2 * 3600.0, 3600.0, "h"},
      {"s", 100, 60.0, "min"},
      {"s", 1, 1, "s"},
      {"s", 1e-12, 1e-3, "ms"},
      {"m", 0.1, 1, "m"},
      {"m", 1e-12, 1e-3, "mm"},
  };
  const std::string pattern = "%." + std::to_string(figures) + "g ";
  const auto number = [&](double scaled) { return told(scaled, pattern.c_str()); };
  const double size = std::abs(value);
  for (const Scale& scale : scales)
    if (unit == scale.unit && size >= scale.least) return number(value / scale.size) + scale.name;
  for (const char* prefixed : {"Pa", "N", "N m", "J", "W", "B"})
    for (const auto& [factor, prefix] : {std::pair(1e9, "G"), std::pair(1e6, "M"), std::pair(1e3, "k")})
      if (unit == prefixed && size >= factor) return number(value / factor) + prefix + unit;
  return unit == "-" || unit.empty() ? told(value, "%.3g") : number(value) + unit;
}

}  // namespace mudline
