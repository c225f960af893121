#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulation/balances.hpp"
#include "simulation/model.hpp"
#include "simulation/output/field_file.hpp"
#include "simulation/output/history_file.hpp"
#include "simulation/output_settings.hpp"
#include "simulation/probes.hpp"

namespace mudline {

/// Writes the committed state of a model: fields for ParaView, histories for plots.
class Results {
 public:
  /// Opens the files; `restart_time`: continues old ones. Collective.
  Results(Model& model, const OutputSettings& settings, const std::string& deck_text, std::optional<double> restart_time);

  void write_fields(int step, const std::string& stage);
  /// `terms`: what the terms say of the last step.
  void write_history(const Balances& balances, const std::map<std::string, double>& terms, double dt, int iterations);
  /// Pore pressures from which the excess is counted, by overlap dof. Set when the run starts, part of the checkpoint.
  NodalView initial_pressure() const { return initial_pressure_; }
  void take_initial_pressure();

 private:
  std::vector<OutputField> nodal_fields() const;
  std::vector<OutputField> cell_fields() const;
  /// A field on all owned nodes; a linear field's missing middle nodes are interpolated.
  std::vector<double> on_all_nodes(int field, const ConstNodalView& values) const;

  Model& model_;
  FieldFile fields_;
  HistoryFile history_;
  /// Pore pressure less that of the start at the same place, by overlap dof.
  NodalView excess_pressure(int field) const;
  NodalView initial_pressure_;
  Probes probes_;
};

}  // namespace mudline
