#include "core/told.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace mudline {

std::string told(double value, const char* pattern) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, pattern, value);
  return buffer;
}

namespace {

/// The number with as many figures; thousands without an exponent.
std::string rounded(double value, int figures) {
  const std::string text = told(value, ("%." + std::to_string(figures) + "g").c_str());
  constexpr double longest = 1e6;
  return std::abs(value) >= 1 && std::abs(value) < longest ? told(std::stod(text), "%.10g") : text;
}

}  // namespace

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
      {"s", 1e-4, 1e-3, "ms"},
      {"s", 1e-12, 1e-6, "us"},
      {"m", 0.1, 1, "m"},
      {"m", 1e-12, 1e-3, "mm"},
      {"kg", 1e4, 1e3, "t"},
  };
  const auto number = [&](double scaled) { return rounded(scaled, figures) + " "; };
  const double size = std::abs(value);
  for (const Scale& scale : scales)
    if (unit == scale.unit && size >= scale.least) return number(value / scale.size) + scale.name;
  for (const char* prefixed : {"Pa", "Pa/m", "N", "N/m", "N/m3", "N m", "J", "W", "B"})
    for (const auto& [factor, prefix] : {std::pair(1e9, "G"), std::pair(1e6, "M"), std::pair(1e3, "k")})
      if (unit == prefixed && size >= factor) return number(value / factor) + prefix + unit;
  return unit == "-" || unit.empty() ? rounded(value, 3) : number(value) + unit;
}

std::string readable_range(double low, double high, const std::string& unit, int figures) {
  std::string first = readable(low, unit, figures);
  const std::string last = readable(high, unit, figures);
  if (first == last) return first;
  const auto behind = [](const std::string& text) { return text.substr(std::min(text.find(' '), text.size())); };
  if (low == 0 || behind(first) == behind(last)) first.resize(first.size() - behind(first).size());
  return first + " to " + last;
}

std::string place_text(const Point& point, int dimension) {
  return told(point[0], "(%.6g, ") + told(point[1], "%.6g") + (dimension == 2 ? "" : told(point[2], ", %.6g")) + ")";
}

}  // namespace mudline
