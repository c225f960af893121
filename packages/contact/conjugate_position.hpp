#pragma once

#include "bodies/rigid_body.hpp"
#include "framework/space.hpp"
#include "framework/term.hpp"

namespace mudline {

/// Coordinates of the nodes [m] displaced by `ahead` (by overlap dof, [m]; empty: x itself), see ImpactView. Contacts
/// that conserve energy measure their gaps there in dynamic steps.
ConstCoordinateView moved_ahead(const Space& space, const ConstCoordinateView& x, const ConstNodalView& ahead);

/// Placement of a body displaced by `ahead`. A body of prescribed motion moves for the time `lead` [s] with its
/// velocity instead.
BodyPlacement moved_ahead(const RigidBody& body, const State& state, const ConstNodalView& ahead, double lead);

}  // namespace mudline
