#pragma once

#include <vector>

#include "bodies/body_load.hpp"

namespace mudline {

/// The water around a body. Buoyancy is the weight of the water displaced above the mudline; below it the soil acts
/// through contact. Drag 1/2 rho C_d A |v| v, times the share of the volume that is in the water; in space the product
/// C_d A may differ along each of the body's axes.
struct BodyWater {
  void parameters(Parameters& p);
  void check(const BodyProperties& body, bool rotates, const Section& section) const;
  /// Adds buoyancy and drag.
  void act(const BodyProperties& body, const Point& gravity, const BodyInstant& at, BodyLoad& load) const;
  AddedMass moved(const BodyProperties& body) const;
  double density = 0, drag = 0, area = 0, added_mass = 0, mudline = 0;
  std::vector<double> drags, areas, added_masses, added_inertia, spin_drag;  // along the body's axes
  bool has_mudline = false;

 private:
  void act_in_plane(const BodyProperties& body, const Point& gravity, const BodyInstant& at, BodyLoad& load) const;
  void act_in_space(const BodyProperties& body, const Point& gravity, const BodyInstant& at, BodyLoad& load) const;
  bool drags_at_all() const { return drag > 0 || !drags.empty(); }
};

}  // namespace mudline
