#include "simulation/model_remeshing.hpp"

#include "ale/yield_drift.hpp"

namespace mudline {

namespace {

void copy_bodies(Model& from, Model& to) {
  const State &old = from.store().committed(), &now = to.store().committed();
  for (const auto& [name, body] : to.bodies()) {
    const BodyUnknowns &here = body->unknowns(), &there = from.bodies().at(name)->unknowns();
    for (int k = 0; k < here.count; ++k) {
      now.value(here.dof[k]) = old.value(there.dof[k]);
      now.rate(here.dof[k]) = old.rate(there.dof[k]);
      now.acceleration(here.dof[k]) = old.acceleration(there.dof[k]);
    }
  }
}

}  // namespace

StateTransfer transfer_from(Model& from, const Stage& stage, Model& to) {
  StateTransfer result;
  MeshReceipt& receipt = result.receipt;
  const State& before = from.store().committed();
  State& state = to.store().committed();
  state.time = before.time;
  state.increment = before.increment;
  if (const std::string name = MeshTransfer::copy_without_places(from.store(), to.store(), *to.mesh().comm());
      !name.empty()) {
    receipt.veto = "the state '" + name + "' has other rows on another mesh";
    return result;
  }
  copy_bodies(from, to);
  to.activate(stage, false);
  Constraints constraints(to.space().dofs()->num_overlap_dofs());
  to.prescribe(stage, state.time, state.time, state, constraints);
  to.ale()->match_volume(*from.ale(), before, constraints, state);
  result.transfer = std::make_unique<const MeshTransfer>(*from.ale(), before, *to.ale(), state);
  receipt = to.ale()->transfer_from(*from.ale(), from.store(), *result.transfer, constraints, to.store());
  if (!receipt.moved) return result;
  if (!to.system().refresh_history()) {
    receipt.veto = "the state on the new mesh cannot be evaluated" + to.system().hints();
    receipt.moved = false;
    return result;
  }
  receipt.yield_drift = yield_drift(*to.soil(), state, to.store().trial());
  to.store().take_evaluated();
  return result;
}

}  // namespace mudline
