#pragma once

#include "bodies/rigid_body.hpp"
#include "framework/space.hpp"
#include "framework/term.hpp"

namespace mudline {

/// Coordinates of the nodes moved on by `ahead` (by overlap dof, [m]; empty: x itself), see ImpactView: where
/// gaps are measured in dynamic steps by contacts that conserve energy.
ConstCoordinateView moved_ahead(const Space& space, const ConstCoordinateView& x, const ConstNodalView& ahead);

/// The same of a body, which moves on with its velocity where its motion is prescribed; `lead` [s].
BodyPlacement moved_ahead(const RigidBody& body, const State& state, const ConstNodalView& ahead, double lead);

}  // namespace mudline
