#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/parameters.hpp"
#include "simulation/filter_settings.hpp"
#include "simulation/probe_settings.hpp"

namespace mudline {

/// The deck's section "output".
class OutputSettings {
 public:
  /// `deck_name`: stem of the deck's file, the default name of the results; `bodies`: names of the bodies that a probe
  /// may move with. InputError.
  static OutputSettings read(const Section& section, const std::string& deck_name,
                             const std::vector<std::string>& bodies);
  void parameters(Parameters& p);

  std::string folder = "results";
  std::string name;
  double field_interval = 0;  // [s] 0: only at the end of stages
  int field_steps = 0;        // number of steps between fields; 0: off
  int history_steps = 1;
  int checkpoint_steps = 100;   // 0: only at the end of stages
  bool error_estimate = false;  // estimate of the discretisation error, in fields and histories
  double target_error = 0.05;   // [-] relative error of the stress for which wanted element sizes are computed
  std::vector<ProbeSettings> probes;
  std::vector<FilterSettings> filters;

  /// Makes the folder for the results. `section`: the deck's "output". InputError.
  void make_folder(const Section& section) const;
  /// Stem of all files of the run.
  std::string stem() const { return folder + "/" + name; }
};

}  // namespace mudline
