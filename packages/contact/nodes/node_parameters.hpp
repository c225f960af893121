#pragma once

#include "contact/nodes/smooth_surface.hpp"
#include "contact/two_surfaces.hpp"

namespace mudline {

/// What the deck says of a node-to-segment contact, besides friction.
struct NodeParameters : TwoSurfaceParameters {
  NodeParameters() : TwoSurfaceParameters(Enforcement::penalty) {}
  void parameters(Parameters& p);

  Drawing drawing = Drawing::hermite;
  double corner_angle = 45;  // [deg]
  double overhang = 0.1;     // [-] of the last piece
  PairImpact impact = PairImpact::conserving;
};

}  // namespace mudline
