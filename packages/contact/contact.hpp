#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bodies/rigid_body.hpp"
#include "contact/laws/friction.hpp"
#include "contact/laws/normal_law.hpp"
#include "core/registry.hpp"
#include "framework/term_faces.hpp"

namespace mudline {

/// Data of the model that a contact reads when it is constructed.
struct ContactContext {
  const Space& space;
  const std::map<std::string, std::shared_ptr<RigidBody>>& bodies;  // by name
  const Registry<Friction>& frictions;
  const Registry<NormalLaw>& normal_laws;
  /// Representative constrained modulus lambda + 2 G [Pa] of the soil in an element (block, element): scale of
  /// penalties.
  std::function<double(int block, int element)> stiffness;
  /// Weight [N/m3] of the pore water in a block, as far as the pore pressures balance it; absent: none.
  std::function<Point(int block, double time)> water_weight = {};
  /// Total stress [Pa, tension positive, as sym6 numbers it] of a state in an element of a block, at a point on its
  /// surface; absent: none.
  std::function<std::array<double, 6>(const State& state, int block, int element, const Point& at)> stress = {};
  /// Undrained strength [Pa] of the soil in an element of a block in a state, at a point on its surface; not a number
  /// where the law of the soil there has none; absent: no soil has one.
  std::function<double(const State& state, int block, int element, const Point& at)> undrained_strength = {};
  /// The mesh is the result of remeshing: its surface is where the bodies have left it, not where they start.
  bool remeshed = false;
};

/// Partners of a contact: the sides of one surface, and a body or the sides of another surface.
struct ContactPartners {
  std::string surface;
  std::string opposite;                    // side set; empty: a body
  const RigidBody* body = nullptr;         // null: two surfaces
  bool shear = false;                      // friction may act along the surface
  std::optional<Section> strength_reader;  // the law that needs the undrained strength of the surface's soil
  bool pressure_reader = false;            // its laws or its film read the soil's pore pressure
};

/// One entry of the deck's "contacts": a term that couples the soil's surface with a body, or two surfaces. A contact
/// type is constructible from a ContactContext, reads its parameters, and binds to sets and bodies in check(); all
/// collective, every rank throws alike. Its history lives in state arrays named "contact/<name>/...".
class Contact : public Term, public History, public Unilateral, public Reports {
 public:
  Role role() const override { return Role::contact; }
  virtual ContactPartners partners() const = 0;
  /// Normal pressure [Pa] on the soil, compression positive, by local node (owned and ghost), averaged from the contact
  /// points around it; 0 off the surface. For output. Collective.
  virtual std::vector<double> nodal_pressure(const State& state) const = 0;
  /// Shear stress [Pa] on the soil by local node, averaged alike, positive along the body's contour; empty without
  /// friction.
  virtual std::vector<double> nodal_shear(const State&) const { return {}; }
  /// Sets 1, by local node, on the sides where a penalty acts at some point. For preconditioners.
  virtual void mark_pressed(const State&, std::vector<char>&) const {}
};

using ContactRegistry = Registry<Contact, const ContactContext&>;

/// Registers "penalty", "frictionless penalty", "node to segment", "point to face" and "mortar".
void register_contact(ContactRegistry& registry);

}  // namespace mudline
