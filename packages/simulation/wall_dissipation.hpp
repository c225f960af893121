#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "simulation/model.hpp"

namespace mudline {

/// The excess pore pressure on the walls of bodies that rest during a stage: how much of it the stage has dissipated,
/// and whether the elements there are fine enough to say so. It keeps no model: a mesh made anew brings another one.
class WallDissipation {
 public:
  struct Line {
    std::string text;
    bool doubtful;
  };
  /// When a stage begins. excess: pore pressure by overlap dof. Collective.
  void begin(const Model& model, const NodalView& excess);
  /// When it ends, after `duration` [s]; nothing where neither begin() nor resume() was called. Collective.
  std::vector<Line> end(const Model& model, const NodalView& excess, double duration);

  /// What a contact's wall was when the stage began; part of the checkpoint.
  struct Start {
    double pressure;  // [Pa] mean excess pore pressure
    Point position;   // [m] of the body
  };
  const std::map<std::string, Start>& start() const { return start_; }
  /// Instead of begin(), where a run is continued within a stage.
  void resume(std::map<std::string, Start> start) { start_ = std::move(start); }

 private:
  /// Means over the sides of a contact that touch, weighted by their area.
  struct Wall {
    double pressure = 0;     // [Pa] excess, at the vertices of these sides
    double thickness = 0;    // [m] of the elements behind
    double diffusivity = 0;  // [m2/s] of their soil, of one-dimensional elastic consolidation
    double area = 0;         // [m2]
  };
  static Wall look(const Model& model, const Contact& contact, const NodalView& excess);
  static void add_side(const Model& model, const Side& side, const NodalView& excess, Wall& to);

  std::map<std::string, Start> start_;  // by contact
};

}  // namespace mudline
