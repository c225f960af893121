#include "simulation/model_remeshing.hpp"

#include <unordered_map>

#include "ale/yield_drift.hpp"
#include "framework/dof_ids.hpp"
#include "integrator/overlap.hpp"
#include "simulation/surface_transfer.hpp"

namespace mudline {

namespace {

bool begins_with(const std::string& text, const std::string& head) { return text.compare(0, head.size(), head) == 0; }

/// Arrays that hold nodal forces of a condition.
constexpr const char* held_forces = "absorbing/";

/// How an array that is no point data is transferred.
enum class TransferRule { common, summed, at_nodes, along_surface, unknown };

TransferRule transfer_rule(const ArrayInfo& info, bool of_contact) {
  if (of_contact) return TransferRule::along_surface;
  if (begins_with(info.name, held_forces)) return TransferRule::at_nodes;
  if (info.shares) return TransferRule::summed;
  // these arrays have ids, but their rows are the same on every rank
  const bool named = info.name == "balance" || info.name == "discretisation error";
  return info.ids.empty() || named ? TransferRule::common : TransferRule::unknown;
}

/// Handles of the arrays that contacts keep along their surfaces.
std::set<int> arrays_of_contacts(const Model& model) {
  std::set<int> handles;
  for (const auto& [name, contact] : model.contacts())
    for (const SurfaceRows& rows : contact->surface_rows(model.store().committed().coordinates))
      handles.insert(rows.array);
  return handles;
}

/// Local dofs of this rank's rows of an array whose rows stand for dofs.
std::vector<int> dofs_of(const Model& model, const ArrayInfo& info) {
  std::unordered_map<long long, int> local;
  const std::vector<long long> ids = dof_ids(*model.space().dofs());
  for (std::size_t dof = 0; dof < ids.size(); ++dof) local.emplace(ids[dof], static_cast<int>(dof));
  std::vector<int> result;
  for (long long id : info.ids) result.push_back(local.at(id));
  return result;
}

/// Error text where nodes that hold forces would move; "": none would.
std::string moving_forces(const Model& model, const ArrayInfo& info) {
  const int u = model.soil()->displacement;
  NodalView held("held", model.space().dofs()->num_overlap_dofs());
  for (int dof : dofs_of(model, info)) held(dof) = 1;
  const Ale& ale = *model.ale();
  const std::vector<double> nodes = ale.mesh().gather(model.space(), u, held);
  bool moving = false;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    moving = moving || (nodes[i] != 0 && !ale.remeshing()->keeps(static_cast<int>(i) / ale.mesh().dimension()));
  if (ale.mesh().any(moving))
    return "the boundary condition '" + info.name.substr(std::string(held_forces).size()) +
           "' holds forces at nodes that would move; name its set in boundary/material sides";
  return "";
}

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

/// Copies arrays that do not depend on the mesh: the same on every rank, or shares of a sum. Returns the name of one
/// whose number of rows differs all the same, or "".
std::string copy_common(Model& from, Model& to) {
  const std::set<int> of_contacts = arrays_of_contacts(to);
  for (int handle = 0; handle < to.store().num_arrays(); ++handle) {
    const ArrayInfo& info = to.store().info(handle);
    if (info.block >= 0) continue;
    const TransferRule rule = transfer_rule(info, of_contacts.count(handle) > 0);
    if (rule != TransferRule::common && rule != TransferRule::summed) continue;
    const PointView &old = from.store().committed().arrays[from.store().find(info.name)],
                    &now = to.store().committed().arrays[handle];
    if (old.extent(0) != now.extent(0)) return info.name;
    const bool keeper = to.mesh().comm()->getRank() == 0;
    for (std::size_t row = 0; row < now.extent(0); ++row)
      for (std::size_t c = 0; c < now.extent(1); ++c) {
        now(row, c) = old(row, c);
        if (rule == TransferRule::common) continue;
        const double sum = sum_over_ranks(*to.mesh().comm(), old(row, c));
        now(row, c) = keeper ? sum : 0.0;
      }
  }
  return "";
}

void transfer_contacts(Model& from, Model& to) {
  const Positions x = from.ale()->mesh().gather(from.store().committed().coordinates);
  for (std::size_t k = 0; k < to.contacts().size(); ++k) {
    const Contact &old = *from.contacts()[k].second, &now = *to.contacts()[k].second;
    const SurfaceTransfer transfer(*from.ale(), x, now.partners().surface);
    const auto before = old.surface_rows(from.store().committed().coordinates),
               after = now.surface_rows(to.store().committed().coordinates);
    for (std::size_t i = 0; i < after.size(); ++i) {
      const ArrayInfo& info = to.store().info(after[i].array);
      const PointView& rows = to.store().committed().arrays[after[i].array];
      transfer.transfer(info, from.store().committed().arrays[before[i].array], before[i], rows, after[i]);
    }
  }
}

void transfer_held_forces(Model& from, const MeshChange& change, Model& to) {
  for (int handle = 0; handle < to.store().num_arrays(); ++handle) {
    const ArrayInfo& info = to.store().info(handle);
    if (!begins_with(info.name, held_forces)) continue;
    const PointView &old = from.store().committed().arrays[from.store().find(info.name)],
                    &now = to.store().committed().arrays[handle];
    NodalView forces("held forces", from.space().dofs()->num_overlap_dofs());
    const std::vector<int> dofs = dofs_of(from, from.store().info(from.store().find(info.name)));
    for (std::size_t row = 0; row < dofs.size(); ++row) forces(dofs[row]) = old(row, 0);
    const NodalView made("held forces", to.space().dofs()->num_overlap_dofs());
    change.transfer(to.soil()->displacement, forces, made);
    const std::vector<int> new_dofs = dofs_of(to, info);
    for (std::size_t row = 0; row < new_dofs.size(); ++row) now(row, 0) = made(new_dofs[row]);
  }
}

}  // namespace

std::string remeshing_problem(const Model& model) {
  const std::set<int> of_contacts = arrays_of_contacts(model);
  for (const auto& [name, contact] : model.contacts())
    if (contact->surface_rows(model.store().committed().coordinates).empty())
      return "the contact '" + name +
             "' cannot go over to another mesh; those with a body, of nodes to segments and of points to faces can";
  for (int handle = 0; handle < model.store().num_arrays(); ++handle) {
    const ArrayInfo& info = model.store().info(handle);
    if (info.block >= 0) continue;
    const TransferRule rule = transfer_rule(info, of_contacts.count(handle) > 0);
    if (rule == TransferRule::unknown) return "the state '" + info.name + "' cannot go over to another mesh";
    if (rule != TransferRule::at_nodes) continue;
    if (const std::string problem = moving_forces(model, info); !problem.empty()) return problem;
  }
  return "";
}

StateTransfer transfer_from(Model& from, const Stage& stage, Model& to) {
  StateTransfer result;
  MeshReceipt& receipt = result.receipt;
  const State& before = from.store().committed();
  State& state = to.store().committed();
  state.time = before.time;
  state.increment = before.increment;
  if (const std::string name = copy_common(from, to); !name.empty()) {
    receipt.veto = "the state '" + name + "' has other rows on another mesh";
    return result;
  }
  copy_bodies(from, to);
  to.activate(stage, false);
  Constraints constraints(to.space().dofs()->num_overlap_dofs());
  to.prescribe(stage, state.time, state.time, state, constraints);
  to.ale()->match_volume(*from.ale(), before, constraints, state);
  result.change = std::make_unique<const MeshChange>(*from.ale(), before, *to.ale(), state);
  receipt = to.ale()->transfer_from(*from.ale(), from.store(), *result.change, constraints, to.store());
  if (!receipt.moved) return result;
  transfer_contacts(from, to);
  transfer_held_forces(from, *result.change, to);
  to.stepper().measures() = from.stepper().measures();
  if (!to.stepper().refresh_history()) {
    receipt.veto = "the state on the new mesh cannot be evaluated" + to.stepper().hints();
    receipt.moved = false;
    return result;
  }
  receipt.yield_drift = yield_drift(*to.soil(), state, to.store().trial());
  for (Transferred* term : to.stepper().transferred()) term->take_evaluated(to.store().trial(), state);
  return result;
}

}  // namespace mudline
