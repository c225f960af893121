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

/// Where the files of a run are continued.
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

  /// How far the files have come, for a checkpoint.
  const HistoryMark& history_mark() const { return history_.mark(); }
  int field_steps() const { return fields_.num_steps(); }
  const FieldMarks& field_marks() const { return fields_.marks(); }

  /// RunError on every rank where files that were written are not there any more. Collective.
  void look_at_files() const;

  /// Of the committed state, where it is asked for. Collective.
  void estimate_error();
  void write_fields(int step, const std::string& stage);
  /// `terms`: what the terms say of the last step.
  void write_history(const Balances& balances, const Report& terms, double dt, int iterations);
  /// Pore pressures from which the excess is counted, by overlap dof. Set when the run starts, part of the checkpoint.
  NodalView initial_pressure() const { return initial_pressure_; }
  void take_initial_pressure();
  /// Pore pressure less that of the start at the same place, by overlap dof; only with pore fluid.
  NodalView excess_pressure() const;
  /// The same as it would be where the nodes are now, by overlap dof: what goes over to another mesh.
  NodalView reference_pressure() const;
  void take_reference_pressure(const NodalView& at_present_places);

 private:
  std::vector<OutputField> nodal_fields() const;
  std::vector<OutputField> cell_fields() const;
  /// Means over the elements' points of all point data, the arrays of `without` aside, by name; 0 at the points that
  /// have no such variable.
  std::vector<OutputField> point_means(const std::set<int>& without) const;
  struct PointVariables {
    int material;  // of which points; -1: of all
    std::vector<StateVariable> variables;
  };
  std::vector<PointVariables> variables_of(int handle) const;
  /// Adds the means of the variables of this name of one point array, by element.
  void add_means(int handle, const std::string& name, double* to) const;
  /// The material of most of a cell's points, and where its soil was at the start; none where no region has layers.
  std::vector<OutputField> layer_fields() const;
  /// A field on all owned nodes; a linear field's missing middle nodes are interpolated.
  std::vector<double> on_all_nodes(int field, const ConstNodalView& values) const;

  Model& model_;
  DiscretisationError* error_;
  FieldFile fields_;
  HistoryFile history_;
  /// Pressure of water at rest by which nodes are deeper than at the start, by overlap dof; 0 without pore fluid.
  NodalView deeper_by() const;
  /// Density of the pore fluid [kg/m3] by overlap dof of the pore pressure, the mean of the elements around.
  /// Collective.
  NodalView fluid_density() const;
  NodalView initial_pressure_, fluid_density_;
  Probes probes_;
};

}  // namespace mudline
