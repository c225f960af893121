#pragma once

#include <string>

#include "simulation/model.hpp"

namespace mudline {

/// Result of the transfer of a model's state to a model on another mesh.
struct StateTransfer {
  MeshReceipt receipt;                           // where `moved` is false, the new model must not be used
  std::unique_ptr<const MeshTransfer> transfer;  // between the two models
};

/// Transfers the committed state of `from` to `to`, a model of the same deck on a remeshed domain, and activates the
/// terms of the stage there. Collective.
StateTransfer transfer_from(Model& from, const Stage& stage, Model& to);

}  // namespace mudline
