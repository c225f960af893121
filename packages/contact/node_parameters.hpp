#pragma once

#include <string>

#include "contact/smooth_surface.hpp"
#include "contact/uzawa.hpp"

namespace mudline {

/// What the deck says of a node-to-segment contact, besides friction.
struct NodeParameters : EnforcementParameters {
  NodeParameters() : EnforcementParameters{Enforcement::penalty} {}
  enum class Impact { conserving, interpolated };
  void parameters(Parameters& p);

  std::string slave, master;
  Drawing drawing = Drawing::hermite;
  double corner_angle = 45;  // [deg]
  double overhang = 0.1;     // [-] of the last piece
  bool two_pass = false;
  double penalty = 0, penalty_factor = 10;  // [Pa/m], [-]
  double capture_distance = 0;  // [m]
  double reach = 0;             // [m]
  double advance_limit = 0.25;  // [-] of the slave's shortest side
  Impact impact = Impact::conserving;
};

}  // namespace mudline
