#pragma once

#include "ale/ghosted_mesh.hpp"

namespace mudline {

/// Rounds lengths so that last digits, which depend on the number of ranks, do not decide on a mesh.
class Rounding {
 public:
  /// The unit of rounding is a power of two near 1e-8 of the places' extent.
  explicit Rounding(const Positions& places) {
    Bounds box = Bounds::nothing();
    for (const Point& place : places) box.enclose(place);
    unit_ = std::exp2(std::floor(std::log2(1e-8 * box.extent())));
  }
  double operator()(double length) const { return unit_ * std::round(length / unit_); }
  Point operator()(const Point& place) const { return {(*this)(place[0]), (*this)(place[1]), (*this)(place[2])}; }
  Positions operator()(const Positions& places) const {
    Positions result;
    for (const Point& place : places) result.push_back((*this)(place));
    return result;
  }

 private:
  double unit_;
};

}  // namespace mudline
