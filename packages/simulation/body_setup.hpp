#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "simulation/setup.hpp"

namespace mudline {

/// Values of a quantity that a check found: the value, what it is of, and what to change where it is unusual.
using Judge = std::function<void(double value, const std::string& what, const std::string& advice)>;

/// A body before the first step, in the plane or in space: where it is, what it may touch, how its stages move it.
struct BodySetup {
  /// Collective.
  BodySetup(const Setup& setup, const RigidBody& body);

  /// A stage's motion of the body.
  struct Motion {
    std::string stage;
    double begin, duration;  // [s]
    std::shared_ptr<const BodyMotion> law;
    Section entry;
  };
  /// Where prescribed motion takes it, up to the first stage that releases it.
  struct Place {
    double time;         // [s]
    Point displacement;  // [m]
    double angle;        // [rad] turned so far
  };
  /// What its contacts' surfaces are like; over all ranks.
  struct Surfaces {
    int sides = 0, under = 0;  // all, and those whose middle is below or above the body's box
    double gap = any_size, shortest = any_size, longest = 0;  // [m] nearest middle or corner; edges
    double facing = -1;              // cosine between the sides nearest to the body and its surface there
    double misfit = 0, reach = 0;    // [m] in a hole that the body lies in: distance, and the side's length
    Bounds box = Bounds::nothing();  // [m]
  };
  std::string called() const { return "body '" + body.name() + "'"; }
  bool free() const { return release != nullptr; }
  double length_of(int axis) const { return box.high[axis] - box.low[axis]; }

  const Model& model;
  const RigidBody& body;
  Section entry;
  int dim, up;
  Bounds box = Bounds::nothing();  // [m] of the body as it is drawn, at its place at the start
  Shadow shadow;                   // [m] along the vertical axis
  double width = 0, size = 0;      // [m] that of the shadow, and the largest extent along any axis
  std::vector<Motion> motions;
  std::vector<Place> places;
  const ReleasedMotion* release = nullptr;  // the first
  Surfaces surfaces;
  Point soil_gravity{};  // [m/s2] of the deck's physics; 0: none

 private:
  void find_box();
  void follow(const Section& deck);
  void find_surfaces();
};

/// One way in which a body may be meant otherwise than it is written. Its quantity's name is that of the doubt.
struct BodyCheck {
  Usual quantity;
  void (*look)(const BodySetup& body, const Judge& judge);
};

/// The soil behind a surface of the mesh, over all ranks.
struct SoilBehind {
  double side = 0, stiffness = 0;  // means over the sides: [m] edges, [Pa/m] constrained modulus over height
  double strength = 0;             // [Pa] largest undrained strength; 0: unknown
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
/// As BodyCheck, of a contact.
struct ContactCheck {
  Usual quantity;
  void (*look)(const ContactSetup& contact, const Judge& judge);
};

/// A number of the deck, or the fallback where it gives none.
double number_in(const Section& section, const std::string& name, double fallback);

/// The checks of a group; a new one is a line in its list.
std::vector<BodyCheck> body_checks();
std::vector<ContactCheck> contact_checks();

/// Declares their quantities, and keeps what they doubt. Collective.
void declare_body_checks(Doubts& doubts);
void look_at_bodies(const Setup& setup, Doubts& doubts);

}  // namespace mudline
