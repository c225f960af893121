#pragma once

#include "simulation/model.hpp"
#include "simulation/observer.hpp"

namespace mudline {

/// The excess pore pressure on the walls of bodies that rest during a stage: how much of it the stage has dissipated,
/// and whether the elements there are fine enough to tell. What the walls were like when the stage began is the state
/// array "wall at the start" with a row per contact with a body.
class WallDissipation : public Observer {
 public:
  void declare_state(Model& model) override;
  /// Notes the walls' state.
  void begin_stage(const RunView& run) override;
  /// The excess pressure on the wall of a body that rests, as a mean over its contacts, and its dissipation.
  void results(const RunView& run, ResultTable& to) override;
  /// Tells the dissipation, or that the mesh does not resolve it.
  void end_stage(const RunView& run) override;

 private:
  /// Area-weighted means over the sides of a contact that touch.
  struct Wall {
    double pressure = 0;     // [Pa] excess, at the vertices of these sides
    double thickness = 0;    // [m] of the elements behind
    double diffusivity = 0;  // [m2/s] coefficient of one-dimensional elastic consolidation of their soil
    double area = 0;         // [m2]
  };
  static Wall look(const Model& model, const Contact& contact, const NodalView& excess);
  static void add_side(const Model& model, const Side& side, const NodalView& excess, Wall& to);
};

}  // namespace mudline
