#pragma once

#include <string>

#include "simulation/model.hpp"

namespace mudline {

/// Why the state of this model could not go over to another mesh of the same regions; "" where it can. Collective.
std::string renewal_problem(const Model& model);

/// The committed state of `from` goes over to `to`, a model of the same deck on a mesh made anew, whose terms are those
/// of the stage from then on and have taken the state over. A receipt without `moved` says why not; `to` is then good
/// for nothing. Collective.
MeshReceipt take_over(Model& from, const Stage& stage, Model& to);

/// A nodal quantity of a field, by overlap dof, goes over likewise. Collective.
NodalView carried_over(Model& from, Model& to, int field, const NodalView& values);

}  // namespace mudline
