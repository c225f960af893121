#pragma once

#include "contact/body/penalty_side.hpp"

namespace mudline {

/// Placements of a body at both ends of a step, for the loops over the sides.
BodyInStep body_in_step(const RigidBody& body, const BodyPlacement& old, const BodyPlacement& now);

/// Finds the closest points of the body to a contact point at both ends of a step. It runs on the host, since contours
/// and surfaces are virtual. `point`: number on the side; `start` holds its other data already.
void search(const RigidBody& body, const BodyInStep& step, const ContactTables& rule, const SideContact& side,
            int point, ContactStart& start);

}  // namespace mudline
