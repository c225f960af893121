#pragma once

#include <string>

#include "core/parameters.hpp"

namespace mudline {

/// A filter of a body, through which it measures the pore pressure: the part of its surface between two heights.
struct FilterSettings {
  std::string name, body;
  double position = 0;   // [m] height of its middle above the body's reference point, in the body frame
  double height = 5e-3;  // [m] its extent along the body's axis

  void parameters(Parameters& p) {
    p.required("body", body, "whose filter it is, in the plane or in axisymmetry");
    p.required("position", position, "m", any(), "height of its middle above the body's reference point");
    p.add("height", height, "m", positive(), "its extent along the body's axis");
  }
  double bottom() const { return position - 0.5 * height; }
  double top() const { return position + 0.5 * height; }
};

}  // namespace mudline
