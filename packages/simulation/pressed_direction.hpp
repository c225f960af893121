#pragma once

#include "contact/contact.hpp"
#include "simulation/model.hpp"

namespace mudline {

/// The direction in which a contact presses body and soil apart, a unit vector: that of the resultant of the normal
/// pressure on the soil, in the committed state. It is vertical in axisymmetry, for a half contour, and where nothing
/// is pressed or the pressures cancel. Collective.
Point pressed_direction(const Model& model, const Contact& contact);

/// Half the width [m] of the contact's body across that direction. Collective.
double pressed_half_width(const Model& model, const Contact& contact);

}  // namespace mudline
