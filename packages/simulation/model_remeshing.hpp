#pragma once

#include <string>

#include "simulation/model.hpp"

namespace mudline {

/// Why the state of this model could not go over to another mesh of the same regions; "" where it can. Collective.
std::string remeshing_problem(const Model& model);

/// The state of a model on another mesh, which takes it over from the one before.
struct TakeOver {
  MeshReceipt receipt;                       // where it was not `moved`, the new model is good for nothing
  std::unique_ptr<const MeshChange> change;  // between the two models
};

/// The committed state of `from` goes over to `to`, a model of the same deck on a mesh made anew, whose terms are those
/// of the stage from then on and have taken the state over. Collective.
TakeOver take_over(Model& from, const Stage& stage, Model& to);

}  // namespace mudline
