#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "simulation/model.hpp"
#include "simulation/observer.hpp"

namespace mudline {

/// The excess pore pressure on the walls of bodies that rest during a stage: how much of it the stage has dissipated,
/// and whether the elements there are fine enough to tell. It keeps no reference to a model, because remeshing replaces
/// the model.
class WallDissipation : public Observer {
 public:
  /// Notes the walls' state.
  void begin_stage(const RunView& run) override;
  /// Tells the dissipation, or that the mesh does not resolve it.
  void end_stage(const RunView& run) override;

  /// State of a contact's wall when the stage began; part of the checkpoint.
  struct Start {
    double pressure;  // [Pa] mean excess pore pressure
    Point position;   // [m] of the body
  };
  const std::map<std::string, Start>& start() const { return start_; }
  /// Replaces begin_stage() where a run is continued within a stage.
  void resume(std::map<std::string, Start> start) { start_ = std::move(start); }

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

  std::map<std::string, Start> start_;  // by contact
};

}  // namespace mudline
