#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "contact/contact.hpp"
#include "contact/contact_rule.hpp"
#include "contact/contact_surface.hpp"
#include "contact/laws/contact_point.hpp"

namespace mudline {

/// The laws that the deck names for a contact, and what they read of the soil behind its surface.
class ContactLaws {
 public:
  /// Declares the entry "normal law" of a contact; declare_friction() declares that of friction.
  static void declare_normal_law(Parameters& p);
  /// Reads the deck's laws. InputError for laws that read what the model does not have.
  void read(const ContactContext& context, const Section& section);
  /// InputError for a normal law that is not linear where it has to be.
  void check_linear(const Section& section, bool multipliers, bool conserving) const;
  /// Finds the arrays of the soil's effective stress, which the physics has declared before. InputError for laws that
  /// read the stress where there is none.
  void declare_state(const StateStore& store);

  const Friction* friction() const { return friction_.get(); }  // null: smooth
  const NormalLaw& normal() const { return *normal_; }
  /// Tangential over normal penalty; 0: no friction.
  double tangential_factor() const { return friction_ ? friction_->tangential_factor() : 0.0; }
  /// The partners of a contact with these laws; `opposite`: side set, empty for a body.
  ContactPartners partners(const std::string& surface, const std::string& opposite, const RigidBody* body) const {
    return {surface, opposite, body, friction_ != nullptr, strength_reader_, read_.pore_pressure};
  }
  int pressure() const { return pressure_; }  // field of the pore pressure; -1: the model has none
  /// How many of the first nodes of a side have a pore pressure that the contact reads.
  int pressure_nodes(const SurfaceSide& side) const;
  /// Shapes of these nodes at a point of a side.
  const double* pressure_shape(const SurfaceSide& side, const ContactRule& points, int point) const;
  /// Pore pressure at a point of a side [Pa], of nodal values by overlap dof; 0 where the contact does not read it.
  double pore_pressure(const SurfaceSide& side, const ContactRule& points, int point,
                       const ConstNodalView& values) const;
  /// Makes the contact read the pore pressure, whatever its laws read.
  void ask_for_pore_pressure() { read_.pore_pressure = true; }
  /// Laws, times and weights of a step; `damping` of the deck [s/m].
  ContactPointLaw in_step(const StepView& view, double damping) const;
  /// The soil at the reference coordinates xi of a side, in the state in which a step starts; without the pore
  /// pressure.
  TouchingSoil soil(const State& committed, const SurfaceSide& side, const double* xi) const;

 private:
  void note(const SoilQuantities& asked, const Section& law);
  double temperature(const State& committed, const SurfaceSide& side, const double* xi) const;
  double mean_stress(const State& committed, const SurfaceSide& side) const;
  double undrained_strength(const State& committed, const SurfaceSide& side, const double* xi) const;

  const Space* space_ = nullptr;
  std::function<double(const State&, int, int, const Point&)> strength_;  // see ContactContext
  std::unique_ptr<const Friction> friction_;
  std::unique_ptr<const NormalLaw> normal_ = std::make_unique<LinearNormalLaw>();
  SoilQuantities read_;
  int pressure_ = -1, temperature_ = -1;     // fields
  std::optional<Section> stress_reader_;     // the law that reads the mean stress
  std::optional<Section> strength_reader_;   // and that needs the undrained strength
  std::vector<std::pair<int, int>> stress_;  // (block) state handle, points per element
};

}  // namespace mudline
