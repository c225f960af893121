#pragma once

#include <memory>
#include <string>
#include <vector>

#include "integrator/step_control.hpp"
#include "integrator/time_scheme.hpp"
#include "simulation/registries.hpp"
#include "simulation/stage_end.hpp"
#include "simulation/strength_reduction.hpp"

namespace mudline {

/// One entry of the deck's "stages".
class Stage {
 public:
  enum class Type { geostatic, quasi_static, dynamic };
  enum class InitialRates { automatic, consistent, zero, keep };

  /// Reads and validates a stage. `conditions` and `contacts`: the names that the deck defines. InputError.
  static std::unique_ptr<Stage> read(const Section& section, const Registry<TimeIntegrator>& integrators,
                                     const std::vector<std::string>& conditions,
                                     const std::vector<std::string>& contacts);
  static void document(Parameters& p) { Stage().parameters(p); }

  /// Coefficients of the time integration in a step; `step` counts from 0 in the stage.
  TimeScheme scheme(int step) const;

  std::string name;
  Type type = Type::quasi_static;
  double duration = 1;                          // [s]
  std::vector<std::unique_ptr<StageEnd>> ends;  // read by the model; the first one that is reached ends the stage
  StepControl control;
  StrengthReduction strength_reduction;
  std::vector<std::string> conditions;  // names of the active ones, in deck order
  std::vector<std::string> contacts;
  InitialRates initial_rates = InitialRates::automatic;
  bool mesh_motion = true;           // where the deck has mesh motion
  bool allow_folded = false;         // the run goes on with folded elements
  bool reset_displacements = false;  // at the end of the stage
  double balance_tolerance = 0;  // geostatic: largest displacement [m] before the start counts as unbalanced; 0: off

 private:
  void parameters(Parameters& p);
  /// Reads a strength reduction, whose resolution sets the smallest step. InputError.
  void read_reduction(const Section& section, const Section& steps);
  std::vector<std::string> wanted_conditions_, wanted_contacts_;
  std::unique_ptr<TimeIntegrator> integrator_;
};

}  // namespace mudline
