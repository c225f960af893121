#include "simulation/balances.hpp"

#include <algorithm>
#include <cmath>

#include "integrator/overlap.hpp"
#include "simulation/output/collective.hpp"

namespace mudline {

namespace {

bool does_work(const Term& term) {
  return term.role() == Role::force || term.role() == Role::inertia || term.role() == Role::contact;
}

}  // namespace

Balances::Balances(Model& model) : model_(model), terms_(model.all_terms()) {
  std::vector<long long> ids;
  for (int row = 0; row < first_term; ++row) ids.push_back(row);
  for (const auto& [term, name] : model_.named_terms()) ids.push_back(id_of(name));
  first_conserved_ = static_cast<int>(ids.size());
  for (const Conserved& what : model_.conserved())
    for (const char* row : {"start", "outflow", "turnover", "remap"})
      ids.push_back(id_of("conserved " + what.name + " " + row));
  first_layer_ = static_cast<int>(ids.size());
  if (model_.ale() && model_.soil()->layered()) {
    for (const char* counted : {"points changed", "points started"}) ids.push_back(id_of(counted));
    for (const char* what : {"restored ", "unresolved "})
      for (const auto& material : model_.soil()->materials) ids.push_back(id_of(what + material->name));
  }
  handle_ = model.store().declare(
      ArrayInfo::of_model("balance", {{"value", 1, "SI"}}, std::move(ids)).not_shown().rest_in(earlier_works));
}

int Balances::row_of(const Term* term) const {
  return first_term + static_cast<int>(std::find(terms_.begin(), terms_.end(), term) - terms_.begin());
}

Inventory Balances::inventory(const State& state) const {
  if (!model_.soil()) return {};
  Inventory result = take_inventory(*model_.soil(), state);
  std::vector<double> bodies(axis_names.size() + 1, 0.0);  // momentum and kinetic energy of this rank's bodies
  for (const auto& [name, body] : model_.bodies()) {
    if (body->unknowns().count == 0 || !body->unknowns().owned) continue;
    const BodyMomentum now = mudline::momentum(*body, state);
    for (std::size_t i = 0; i < axis_names.size(); ++i) bodies[i] += now.linear[i];
    bodies.back() += now.kinetic;
  }
  bodies = sum_over_ranks(*model_.space().dofs()->comm(), bodies);
  for (std::size_t i = 0; i < axis_names.size(); ++i) result.momentum[i] += bodies[i];
  result.kinetic += bodies.back();
  return result;
}

void Balances::start() {
  const State& state = model_.store().committed();
  const Inventory now = inventory(state);
  const PointView rows = state.arrays[handle_];
  Kokkos::deep_copy(rows, 0.0);
  for (std::size_t i = 0; i < axis_names.size(); ++i) rows(momentum + i, 0) = now.momentum[i];
  rows(water_start, 0) = now.water;
  rows(kinetic_start, 0) = now.kinetic;
  for (std::size_t c = 0; c < model_.conserved().size(); ++c)
    rows(row_of_conserved(c), 0) = model_.conserved()[c].content(state);
}

void Balances::jump(const std::function<void()>& change) {
  const Inventory before = inventory(model_.store().committed());
  change();
  const Inventory after = inventory(model_.store().committed());
  const PointView rows = model_.store().committed().arrays[handle_];
  for (std::size_t i = 0; i < axis_names.size(); ++i) rows(momentum + i, 0) += after.momentum[i] - before.momentum[i];
  rows(kinetic_start, 0) += after.kinetic - before.kinetic;
}

void Balances::add_step() {
  const ActingTerms& acting = model_.system().terms();
  const StepView& view = model_.system().view();
  const Space& space = model_.space();
  const int u = space.find("displacement"), p = space.find("pore pressure");
  const int terms = static_cast<int>(acting.active().size());
  // this rank's shares: work by term, reaction work, outflow, excess work, force without inertia by direction
  const int by_reaction = terms, flown = terms + 1, excess = terms + 2, pushed = terms + 3;
  std::vector<double> local(pushed + axis_names.size(), 0.0);
  // Internal forces are interpolated within the step; their work beyond the trapezoidal rule is the integrator's
  // dissipation.
  std::vector<std::pair<NodalView, NodalView>> ends(terms);
  for (int k = 0; k < terms; ++k) {
    const int slot = acting.active()[k]->role() == Role::contact ? -1 : acting.history_slot(k);
    if (slot >= 0)
      ends[k] = {model_.store().committed().history_forces[slot], model_.store().trial().history_forces[slot]};
  }
  const auto add_mechanics = [&](int i, int direction) {
    const double du = view.value_end(i) - view.value_old(i);
    const bool pushes = direction < dimension();  // a moment adds no linear momentum
    for (int k = 0; k < terms; ++k) {
      const double force = acting.force(k)(i);
      local[k] += force * du;
      if (ends[k].first.extent(0) > 0) local[excess] += (force - 0.5 * (ends[k].first(i) + ends[k].second(i))) * du;
      if (pushes && acting.active()[k]->role() != Role::inertia) local[pushed + direction] -= force;
    }
    local[by_reaction] += acting.reaction()(i) * du;
    if (pushes) local[pushed + direction] += acting.reaction()(i);
  };
  if (u >= 0)
    for (const auto& [begin, end] : overlap_ranges(*space.dofs(), u))
      for (int i = begin; i < end; ++i) add_mechanics(i, (i - begin) % space.field(u).components);
  for (const auto& [name, body] : model_.bodies())
    for (int k = 0; k < body->unknowns().count; ++k)
      add_mechanics(body->unknowns().dof[k], body->unknowns().direction[k]);
  if (p >= 0)
    for (const auto& [begin, end] : overlap_ranges(*space.dofs(), p))
      for (int i = begin; i < end; ++i) local[flown] += outflow_at(i);
  const std::vector<double> total = sum_over_ranks(*space.dofs()->comm(), local);
  const PointView rows = model_.store().trial().arrays[handle_];
  for (int k = 0; k < terms; ++k) rows(row_of(acting.active()[k]), 0) += total[k];
  rows(reaction_work, 0) += total[by_reaction];
  rows(excess_work, 0) += view.inertia ? total[excess] : 0.0;
  rows(outflow, 0) += view.flow ? total[flown] * view.dt : 0.0;
  for (std::size_t i = 0; i < axis_names.size(); ++i)
    rows(impulse + i, 0) += view.inertia ? total[pushed + i] * view.dt : 0.0;
  if (view.flow) add_conserved(rows);
}

double Balances::outflow_at(int dof) const {
  const ActingTerms& acting = model_.system().terms();
  double out = -acting.reaction()(dof);  // through prescribed nodes
  for (std::size_t k = 0; k < acting.active().size(); ++k)
    if (exchanges(*acting.active()[k])) out += acting.force(static_cast<int>(k))(dof);
  return out;
}

void Balances::add_conserved(const PointView& rows) {
  const StepView& view = model_.system().view();
  const Space& space = model_.space();
  for (std::size_t c = 0; c < model_.conserved().size(); ++c) {
    const Conserved& what = model_.conserved()[c];
    const auto &own = space.node_dof(what.field), &carrier = space.node_dof(std::max(what.carrier, 0));
    NodalView flow("outflow", view.value.extent(0));
    for (int node = 0; node < space.mesh().num_nodes(); ++node) {
      if (own(node) < 0) continue;
      flow(own(node)) = outflow_at(own(node));
      if (what.carrier >= 0)
        flow(own(node)) += what.carried * outflow_at(carrier(node)) * (view.value(own(node)) - what.reference);
    }
    const NodalView everywhere = sum_overlap(*space.dofs(), flow);
    std::vector<double> sums(2, 0.0);  // net sum and sum of absolute values over this rank's nodes
    for (int node = 0; node < space.mesh().num_owned_nodes(); ++node)
      if (own(node) >= 0) {
        sums[0] += everywhere(own(node));
        sums[1] += std::abs(everywhere(own(node)));
      }
    sums = sum_over_ranks(*space.dofs()->comm(), sums);
    rows(row_of_conserved(c) + 1, 0) += sums[0] * view.dt;
    rows(row_of_conserved(c) + 2, 0) += sums[1] * view.dt;
  }
}

void Balances::add_remap_of_conserved(const std::vector<double>& before) {
  const State& state = model_.store().committed();
  for (std::size_t c = 0; c < before.size(); ++c) {
    const double change = model_.conserved()[c].content(state) - before[c];
    state.arrays[handle_](row_of_conserved(c), 0) += change;
    state.arrays[handle_](row_of_conserved(c) + 3, 0) += change;
  }
}

std::vector<double> Balances::conserved() const {
  std::vector<double> contents;
  for (const Conserved& what : model_.conserved()) contents.push_back(what.content(model_.store().committed()));
  return contents;
}

void Balances::add_remap(const MeshReceipt& receipt) {
  const PointView rows = model_.store().committed().arrays[handle_];
  const Inventory &before = receipt.before, &after = receipt.after;
  rows(remap_solid, 0) += after.solid - before.solid;
  rows(remap_water, 0) += after.water - before.water;
  rows(remap_drift, 0) = receipt.yield_drift;
  rows(remap_kinetic, 0) += after.kinetic - before.kinetic;
  for (std::size_t i = 0; i < axis_names.size(); ++i) {
    rows(remap_momentum + i, 0) += after.momentum[i] - before.momentum[i];
    rows(momentum + i, 0) += after.momentum[i] - before.momentum[i];
  }
  if (model_.soil()->layered()) {
    rows(first_layer_, 0) += receipt.changed;
    rows(first_layer_ + 1, 0) += receipt.started;
    for (std::size_t k = 0; k < receipt.restored_grains.size(); ++k) {
      rows(row_of_restored(k), 0) += receipt.restored_grains[k];
      rows(row_of_unresolved(k), 0) += receipt.unresolved_grains[k];
    }
  }
  // the balances of the steps go on from the content that the points hold now
  rows(water_start, 0) += after.water + receipt.unresolved_volume - before.water;
}

std::vector<HistoryValue> Balances::values() const {
  std::vector<HistoryValue> result;
  if (model_.soil()) add_soil(result);
  const State& state = model_.store().committed();
  const PointView rows = state.arrays[handle_];
  for (std::size_t c = 0; c < model_.conserved().size(); ++c) {
    const Conserved& what = model_.conserved()[c];
    const int row = row_of_conserved(c);
    const double content = what.content(state), change = content - rows(row, 0);
    result.push_back({"balance/" + what.name + "/change", what.unit, change});
    result.push_back({"balance/" + what.name + "/outflow", what.unit, rows(row + 1, 0)});
    // the error is relative to the content and the total flow through the boundary
    const double size = std::max({std::abs(content), rows(row + 2, 0), 1e-300});
    result.push_back({"balance/" + what.name + "/error", "-", (change + rows(row + 1, 0)) / size});
    if (model_.ale()) result.push_back({"mesh motion/change of " + what.name, what.unit, rows(row + 3, 0)});
  }
  return result;
}

void Balances::add_layers(const Inventory& now, std::vector<HistoryValue>& result) const {
  const PointView rows = model_.store().committed().arrays[handle_];
  const auto& materials = model_.soil()->materials;
  for (std::size_t k = 0; k < materials.size(); ++k) {
    const double unresolved = model_.ale() ? rows(row_of_unresolved(k), 0) : 0.0;
    result.push_back({"balance/grains/" + materials[k]->name, "kg", now.grains[k] + unresolved});
  }
  if (!model_.ale()) return;
  const auto push_shares = [&](const std::string& what, int (Balances::*row_of)(std::size_t) const) {
    for (std::size_t k = 0; k < materials.size(); ++k)
      result.push_back({"mesh motion/" + what + " grains of " + materials[k]->name, "-",
                        rows((this->*row_of)(k), 0) / std::max(now.grains[k], 1e-300)});
  };
  push_shares("restored", &Balances::row_of_restored);
  push_shares("unresolved", &Balances::row_of_unresolved);
  result.push_back({"mesh motion/points of another material", "-", rows(first_layer_, 0)});
  result.push_back({"mesh motion/laws started anew", "-", rows(first_layer_ + 1, 0)});
}

void Balances::add_soil(std::vector<HistoryValue>& result) const {
  const State& state = model_.store().committed();
  const PointView rows = state.arrays[handle_];
  const Inventory now = inventory(state);
  // The works of all terms, kinetic energy among them, add up to the energy supplied by prescribed motion.
  double works = rows(earlier_works, 0), inertia = 0;
  for (std::size_t k = 0; k < terms_.size(); ++k) {
    const double work = rows(first_term + static_cast<int>(k), 0);
    works += work;
    if (terms_[k]->role() == Role::inertia) inertia += work;
    if (!does_work(*terms_[k])) continue;
    result.push_back({"balance/energy/" + terms_[k]->name(), "J", work});
  }
  const double kinetic = now.kinetic - rows(kinetic_start, 0);
  result.push_back({"balance/energy/kinetic", "J", kinetic});
  // the integrator's share: work of inertia that is not in the velocities, and work of internal forces that they did
  // not store
  result.push_back({"balance/energy/numerical dissipation", "J", inertia - kinetic + rows(excess_work, 0)});
  result.push_back({"balance/energy/supplied by prescribed motion", "J", rows(reaction_work, 0)});
  result.push_back({"balance/energy/error", "J", works - rows(reaction_work, 0)});
  for (int i = 0; i < dimension(); ++i) {
    const double change = now.momentum[i] - rows(momentum + i, 0);
    result.push_back({std::string("balance/momentum/change ") + axis_names[i], "N s", change});
    result.push_back({std::string("balance/momentum/impulse ") + axis_names[i], "N s", rows(impulse + i, 0)});
  }
  if (model_.soil()->pressure >= 0) {
    const double change = now.water - rows(water_start, 0);
    result.push_back({"balance/water/change", "m3", change});
    result.push_back({"balance/water/outflow", "m3", rows(outflow, 0)});
    result.push_back({"balance/water/error", "-", (change + rows(outflow, 0)) / std::max(now.pore_volume, 1e-300)});
  }
  if (model_.ale()) {
    result.push_back({"mesh motion/change of solid", "-", rows(remap_solid, 0) / std::max(now.solid, 1e-300)});
    if (model_.soil()->pressure >= 0)
      result.push_back({"mesh motion/change of water", "-", rows(remap_water, 0) / std::max(now.pore_volume, 1e-300)});
    for (int i = 0; i < dimension(); ++i)
      result.push_back(
          {std::string("mesh motion/change of momentum ") + axis_names[i], "N s", rows(remap_momentum + i, 0)});
    result.push_back({"mesh motion/change of kinetic energy", "J", rows(remap_kinetic, 0)});
    result.push_back({"mesh motion/yield drift", "-", rows(remap_drift, 0)});
  }
  if (model_.soil()->layered()) add_layers(now, result);
}

}  // namespace mudline
