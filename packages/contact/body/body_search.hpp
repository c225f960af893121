#pragma once

#include "contact/body/penalty_side.hpp"

namespace mudline {

/// A body at the ends of a step, as the loops over the sides see it.
BodyInStep body_in_step(const RigidBody& body, const BodyPlacement& old, const BodyPlacement& now);

/// Seeks the places of a contact point on the body, on the host: contours and surfaces are virtual. `point`: number on
/// the side; what else is known of it is in `start` already.
void search(const RigidBody& body, const BodyInStep& step, const ContactTables& rule, const SideContact& side,
            int point, ContactStart& start);

}  // namespace mudline
