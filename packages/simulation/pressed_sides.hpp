#pragma once

#include <vector>

#include "contact/contact.hpp"
#include "simulation/model.hpp"

namespace mudline {

/// The sides of this rank on a contact's surface that touch the other partner in the committed state: those at all of
/// whose nodes the contact presses. Collective.
std::vector<Side> pressed_sides(const Model& model, const Contact& contact);

}  // namespace mudline
