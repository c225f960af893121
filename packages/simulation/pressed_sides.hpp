#pragma once

#include <vector>

#include "contact/contact.hpp"
#include "simulation/model.hpp"

namespace mudline {

/// The sides of this rank on a contact's surface that touch the other partner in the committed state: those at all of
/// whose nodes the contact presses. Collective.
std::vector<Side> pressed_sides(const Model& model, const Contact& contact);

/// The direction in which a contact presses body and soil apart, a unit vector: that of the resultant of the normal
/// pressure on the soil, in the committed state. It is vertical in axisymmetry, for a half contour, and where nothing
/// is pressed or the pressures cancel. Collective.
Point pressed_direction(const Model& model, const Contact& contact);

/// Half the width [m] of the contact's body across that direction. Collective.
double pressed_half_width(const Model& model, const Contact& contact);

}  // namespace mudline
