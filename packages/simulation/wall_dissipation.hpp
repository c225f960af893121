#pragma once

#include <map>
#include <string>
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
  /// When it ends, after `duration` [s]; nothing where begin() was not called (a restart within the stage). Collective.
  std::vector<Line> end(const Model& model, const NodalView& excess, double duration);

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

  struct Start {
    double pressure;
    Point position;
  };
  std::map<std::string, Start> start_;  // by contact
};

}  // namespace mudline
