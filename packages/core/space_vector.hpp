#pragma once

#include <cmath>

#include "core/function.hpp"

namespace mudline {

// Vectors of space, for the sources that work with them. What is constexpr may run in kernels on a device too.

constexpr double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
constexpr Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
constexpr Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
/// a + factor b.
constexpr Point plus(const Point& a, double factor, const Point& b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
constexpr Point scaled(double factor, const Point& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }
inline double length(const Point& a) { return std::sqrt(dot(a, a)); }

}  // namespace mudline
