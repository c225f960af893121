#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "simulation/balances.hpp"
#include "simulation/discretisation_error.hpp"
#include "simulation/model.hpp"
#include "simulation/old_results.hpp"
#include "simulation/output/field_file.hpp"
#include "simulation/output/history_file.hpp"
#include "simulation/output_settings.hpp"
#include "simulation/probes.hpp"

namespace mudline {

/// The points at which the files of a run are continued.
struct ResultsRestart {
  HistoryRestart history;
  FieldRestart fields;
};

/// Writes the committed state of a model: fields for ParaView, histories for plots.
class Results {
 public:
  /// Opens the files; `error`: null where no estimate is asked for; `restart`: continues old ones. Collective.
  Results(Model& model, const OutputSettings& settings, const Origin& origin, DiscretisationError* error,
          const std::optional<ResultsRestart>& restart);

  /// Number of rows and steps in the files so far, for a checkpoint.
  const HistoryMark& history_mark() const { return history_.mark(); }
  int field_steps() const { return fields_.num_steps(); }
  const FieldMarks& field_marks() const { return fields_.marks(); }

  /// Throws RunError on every rank when files that were written are gone. Collective.
  void look_at_files() const;

  /// Estimates the discretisation error of the committed state, where that is asked for. Collective.
  void estimate_error();
  void write_fields(int step, const std::string& stage);
  /// `terms`: report of the terms on the last step; `dt` [s].
  void write_history(const Balances& balances, const Report& terms, double dt, int iterations);
  /// Pore pressures [Pa] from which the excess is counted, by overlap dof. They are set when the run starts and are
  /// part of the checkpoint.
  NodalView initial_pressure() const { return initial_pressure_; }
  void take_initial_pressure();
  /// Pore pressure less the initial one, corrected for water at rest to the node's present place [Pa], by overlap dof;
  /// only with pore fluid.
  NodalView excess_pressure() const;
  /// The initial pressure corrected for water at rest to the nodes' present places [Pa], by overlap dof; it is what is
  /// transferred to another mesh.
  NodalView reference_pressure() const;
  void take_reference_pressure(const NodalView& at_present_places);

 private:
  std::vector<OutputField> nodal_fields() const;
  std::vector<OutputField> cell_fields() const;
  /// Means over each element's points of all point data except the arrays `without`, by name; points without a variable
  /// count as 0.
  std::vector<OutputField> point_means(const std::set<int>& without) const;
  struct PointVariables {
    int material;  // whose points have these variables; -1: all points
    std::vector<StateVariable> variables;
  };
  std::vector<PointVariables> variables_of(int handle) const;
  /// Adds the means of the variables of this name in one point array to `to`, by element.
  void add_means(int handle, const std::string& name, double* to) const;
  /// The material of most of a cell's points, and the place of its soil at the start; empty where no region has layers.
  std::vector<OutputField> layer_fields() const;
  /// Values of a field at all owned nodes; those of a linear field at mid-side nodes are interpolated.
  std::vector<double> on_all_nodes(int field, const ConstNodalView& values) const;

  Model& model_;
  DiscretisationError* error_;
  FieldFile fields_;
  HistoryFile history_;
  /// Change of the pressure of water at rest [Pa] between the nodes' places at the start and now, by overlap dof; 0
  /// without pore fluid.
  NodalView deeper_by() const;
  /// Density of the pore fluid [kg/m3] by overlap dof of the pore pressure, as mean of the elements around. Collective.
  NodalView fluid_density() const;
  NodalView initial_pressure_, fluid_density_;
  Probes probes_;
};

}  // namespace mudline
