#pragma once

#include "contact/laws/friction.hpp"
#include "geometry/contour.hpp"

namespace mudline {

/// What friction remembers of a contact point.
struct ShearState {
  double shear = 0;       // [Pa] on the soil, along the contour's direction of travel; 0 off the body
  double slip = 0;        // [m] path that the point has slid, since it was made
  double dissipated = 0;  // [J] heat, over the point's area
  bool slides = false;
};

/// The shear stress of one contact point and its derivatives.
struct ShearResponse {
  ShearState now;
  double elastic;  // [Pa/m] d shear / d travel along the contour
  double normal;   // [-] d shear / d normal traction
};

/// Return map: the spring `stiffness` [Pa/m] along the surface is stretched by `travel` [m], the advance of the point's
/// foot on the contour in this step; where that exceeds the law's strength at the normal traction `normal` [Pa], the
/// point slides. at.rate is that of the travel over the step of length dt [s]. dissipated is not advanced: it needs the
/// area.
ShearResponse stick_or_slide(const Friction& law, const ShearState& old, double stiffness, double travel, double dt,
                             const FrictionPoint& at);

/// Part of the step's travel that a point made while it touched: all, or for a point that was at gap_old > 0 at its
/// start the fraction after the gap closed at constant speed, which makes the shear stress start from 0.
struct TouchingTravel {
  TouchingTravel(double gap_old, double gap, double travel);
  double value;      // [m]
  double fraction;   // d value / d travel
  double gap_slope;  // d value / d gap
};

}  // namespace mudline
