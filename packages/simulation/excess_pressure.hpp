#pragma once

#include "simulation/model.hpp"

namespace mudline {

/// Pore pressures counted from those at the start of a run. A node that has moved with the soil or the mesh is compared
/// with water at rest at its present place.
class ExcessPressure {
 public:
  /// Collective.
  explicit ExcessPressure(const Model& model);
  /// Pore pressure less the initial one, corrected for water at rest to the node's present place [Pa], by overlap dof;
  /// 0 without pore fluid.
  NodalView values() const;
  /// An excess pore pressure [Pa] and where it is [m].
  struct AtPlace {
    double pressure = 0;
    Point place{};
  };
  /// The one of the largest magnitude on all ranks; 0 without pore fluid. Collective.
  AtPlace highest() const;
  /// Takes the committed pressures as the initial ones, unless these are kept.
  void take_start();
  /// Keeps the initial pressures of another result from now on; by overlap dof, at the nodes' present places [Pa].
  void keep_reference(const NodalView& at_present_places);
  /// Pore pressures [Pa] from which the excess is counted, by overlap dof; part of the checkpoint.
  NodalView initial() const { return initial_; }
  /// The initial pressure corrected for water at rest to the nodes' present places [Pa], by overlap dof; it is what is
  /// transferred to another mesh.
  NodalView reference() const;
  void take_reference(const NodalView& at_present_places);

 private:
  /// Density of the pore fluid [kg/m3] by overlap dof of the pore pressure, as mean of the elements around. Collective.
  NodalView fluid_density() const;
  /// Change of the pressure of water at rest [Pa] between the nodes' places at the start and now, by overlap dof; 0
  /// without pore fluid.
  NodalView deeper_by() const;

  const Model& model_;
  NodalView initial_, fluid_density_;
  bool kept_ = false;
};

}  // namespace mudline
