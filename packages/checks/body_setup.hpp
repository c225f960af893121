#pragma once

#include <string>
#include <vector>

#include "checks/body_way.hpp"
#include "checks/setup.hpp"

namespace mudline {

/// Extent of a body at the start.
struct StartingExtent {
  explicit StartingExtent(const RigidBody& body);
  Bounds box = Bounds::nothing();  // [m]
  Shadow shadow;                   // shadow along the vertical axis
};

/// A body before the first step, in the plane or in space: its place, the surfaces that it may touch, and its motions
/// in the stages.
struct BodySetup : BodyWay {
  /// Collective.
  BodySetup(const Setup& setup, const RigidBody& body);

  /// The surfaces of the body's contacts, over all ranks.
  struct Surfaces {
    int sides = 0, under = 0;  // number of all sides, and of those whose middle lies below or above the body's box
    double gap = any_size, shortest = any_size, longest = 0;  // [m] gap of the nearest middle or corner; edges
    double facing = -1;              // largest cosine between a side near the body and the body's surface opposite
    double misfit = 0, reach = 0;    // [m] of a side of a hole around the body: largest distance, and the side's length
    Bounds box = Bounds::nothing();  // [m]
  };
  std::string called() const { return "body '" + body.name() + "'"; }
  bool free() const { return release != nullptr; }
  double length_of(int axis) const { return box.high[axis] - box.low[axis]; }

  const Model& model;
  Section entry;
  int dim, up;
  Bounds box = Bounds::nothing();  // [m] box of the body at the start
  Shadow shadow;                   // shadow along the vertical axis
  double width = 0, size = 0;      // [m] width of the shadow, and largest extent along any axis
  Surfaces surfaces;
  Point soil_gravity{};  // [m/s2] gravity of the deck's physics; 0: none

 private:
  void find_box();
  void find_surfaces();
};

/// The soil behind a surface of the mesh, over all ranks.
struct SoilBehind {
  // means over the sides: length of edges [m], constrained modulus [Pa], the same over the element's height [Pa/m]
  double side = 0, modulus = 0, stiffness = 0;
  double strength = 0;     // [Pa] largest undrained strength; 0: unknown
  double top = -any_size;  // [m] highest place
};
/// Collective.
SoilBehind soil_behind(const Model& model, const std::string& surface);

/// A contact before the first step.
struct ContactSetup {
  /// Collective.
  ContactSetup(const Setup& setup, const std::string& name, const Contact& contact);
  std::string called() const { return "contact '" + name + "'"; }
  std::string name;
  const Model& model;
  ContactPartners partners;
  Section entry, deck;
  SoilBehind soil;
};

/// A number of the deck, or the fallback where it gives none.
double number_in(const Section& section, const std::string& name, double fallback);

/// The checks of a group; a new one is a line in its list.
std::vector<Check<BodySetup>> body_checks();
std::vector<Check<ContactSetup>> contact_checks();

/// Declare the quantities of these checks; make the checks and keep their doubts. Collective.
void declare_body_checks(Doubts& doubts);
void look_at_bodies(const Setup& setup, Doubts& doubts);

}  // namespace mudline
