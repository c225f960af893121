#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "simulation/balances.hpp"
#include "simulation/model.hpp"
#include "simulation/old_results.hpp"
#include "simulation/output/field_file.hpp"
#include "simulation/output/history_file.hpp"
#include "simulation/output_settings.hpp"
#include "simulation/probes.hpp"

namespace mudline {

/// Where the files of a run are continued.
struct ResultsRestart {
  HistoryRestart history;
  FieldRestart fields;
};

/// Writes the committed state of a model: fields for ParaView, histories for plots.
class Results {
 public:
  /// Opens the files; `restart`: continues old ones. Collective.
  Results(Model& model, const OutputSettings& settings, const Origin& origin,
          const std::optional<ResultsRestart>& restart);

  /// How far the files have come, for a checkpoint.
  const HistoryMark& history_mark() const { return history_.mark(); }
  int field_steps() const { return fields_.num_steps(); }

  void write_fields(int step, const std::string& stage);
  /// `terms`: what the terms say of the last step.
  void write_history(const Balances& balances, const Report& terms, double dt, int iterations);
  /// Pore pressures from which the excess is counted, by overlap dof. Set when the run starts, part of the checkpoint.
  NodalView initial_pressure() const { return initial_pressure_; }
  void take_initial_pressure();
  /// The same as it would be where the nodes are now, by overlap dof: what goes over to another mesh.
  NodalView reference_pressure() const;
  void take_reference_pressure(const NodalView& at_present_places);

 private:
  std::vector<OutputField> nodal_fields() const;
  std::vector<OutputField> cell_fields() const;
  /// Means over the elements' points of all point data, the arrays of `without` aside, by name; 0 in the blocks that
  /// have no such variable.
  std::vector<OutputField> point_means(const std::set<int>& without) const;
  /// A field on all owned nodes; a linear field's missing middle nodes are interpolated.
  std::vector<double> on_all_nodes(int field, const ConstNodalView& values) const;

  Model& model_;
  FieldFile fields_;
  HistoryFile history_;
  /// Pore pressure less that of the start at the same place, by overlap dof.
  NodalView excess_pressure(int field) const;
  /// Pressure of water at rest by which nodes are deeper than at the start, by overlap dof; 0 without pore fluid.
  NodalView deeper_by() const;
  /// Density of the pore fluid [kg/m3] by overlap dof of the pore pressure, the mean of the elements around.
  /// Collective.
  NodalView fluid_density() const;
  NodalView initial_pressure_, fluid_density_;
  Probes probes_;
};

}  // namespace mudline
