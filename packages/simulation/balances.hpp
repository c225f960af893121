#pragma once

#include <functional>
#include <vector>

#include "simulation/model.hpp"
#include "simulation/output/history_file.hpp"

namespace mudline {

/// Audits of the run: work of every term, kinetic energy, linear momentum, pore water. Cumulative values live in the
/// state array "balance" (one row each, the same on every rank), so that they are part of the transaction and of a
/// checkpoint.
class Balances {
 public:
  /// Declares the state array "balance". To be called before the first step.
  explicit Balances(Model& model);
  /// Adds a step to the trial state; to be called after a successful attempt, before acceptance. Collective.
  void add_step();
  /// Adds what a mesh motion or a remeshing changed; this is kept apart from the balances of the steps.
  void add_remap(const MeshReceipt& receipt);
  /// Adds what a mesh motion or a remeshing changed in the conserved contents. `before`: conserved() as it was before.
  /// Collective.
  void add_remap_of_conserved(const std::vector<double>& before);
  /// Contents of the conserved quantities in the committed state, in the order of Model::conserved(). Collective.
  std::vector<double> conserved() const;
  /// Columns of the history file for the committed state. Collective.
  std::vector<HistoryValue> values() const;
  /// Makes a change of the committed velocities that no step makes (a body is set free with a velocity), and adds it to
  /// the momentum and kinetic energy at the start. Collective.
  void jump(const std::function<void()>& change);
  /// Takes the committed state as the start of all balances; to be called when the run begins, not at a restart.
  /// Collective.
  void start();

 private:
  static constexpr int directions = static_cast<int>(axis_names.size());
  // Rows of the state array; the works of all terms of the model follow.
  enum Row {
    reaction_work,
    excess_work,
    outflow,
    impulse,  // a row per direction, as for momentum below
    momentum = impulse + directions,
    water_start = momentum + directions,
    kinetic_start,
    remap_solid,
    remap_water,
    remap_momentum,
    remap_kinetic = remap_momentum + directions,
    remap_drift,
    earlier_works,  // of terms that the run had which this one goes on from, and that it has no longer
    first_term
  };
  Inventory inventory(const State& state) const;
  int dimension() const { return model_.mesh().dimension(); }
  int row_of(const Term* term) const;
  /// First of four rows of a conserved quantity: content at the start, outflow, sum of absolute outflows, change by
  /// mesh motion.
  int row_of_conserved(std::size_t c) const { return first_conserved_ + 4 * static_cast<int>(c); }
  /// Rows of a material's grains [kg]: those that transfers restored, and those that points of cut elements do not
  /// resolve.
  int row_of_restored(std::size_t material) const { return first_layer_ + 2 + static_cast<int>(material); }
  int row_of_unresolved(std::size_t material) const {
    return row_of_restored(material) + static_cast<int>(model_.soil()->materials.size());
  }
  /// Outflow through the boundary at a dof of a scalar field: this rank's contributions.
  double outflow_at(int dof) const;
  void add_conserved(const PointView& rows);
  /// Adds the values of work, momentum, water and mesh motion.
  void add_soil(std::vector<HistoryValue>& result) const;
  /// Adds the grains of each material, and the sums of what mesh motions changed in them.
  void add_layers(const Inventory& now, std::vector<HistoryValue>& result) const;

  Model& model_;
  int handle_, first_conserved_ = 0, first_layer_ = 0;
  std::vector<const Term*> terms_;
};

}  // namespace mudline
