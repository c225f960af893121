#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contact/body/rigid_target.hpp"
#include "contact/point_contact.hpp"

namespace mudline {

/// Deck entries of a penalty contact, besides friction.
struct PenaltyParameters : EnforcementParameters, PartParameters {
  PenaltyParameters() : EnforcementParameters{Enforcement::penalty}, PartParameters(Drainage::Kind::sealed) {}
  enum class Impact { automatic, conserving, interpolated };
  void parameters(Parameters& p);

  std::string body, surface;
  SideRule::At method = SideRule::At::gauss;
  int quadrature_degree = 5;
  double capture_distance = 0;  // [m]
  double advance_limit = 0.25;  // [-] of the shortest side
  Impact impact = Impact::automatic;
  double damping = 0;  // [s/m]
};

/// Contact of a soil surface with a rigid body. State arrays beside those of PointContact: "contact/<name>/work" (this
/// rank's share of the work done on the soil, trapezoidal in the body's motion; heat of damping so far; force of
/// damping on the soil in the last step).
class PenaltyContact : public PointContact {
 public:
  explicit PenaltyContact(const ContactContext& context) : PointContact(context, deck_, deck_) {}
  static void document(Parameters& p);
  void parameters(Parameters& p);
  /// Binds to body and surface. InputError for unknown names, empty surfaces and deep initial overlap. Collective.
  void check(const Section& section);

  ContactPartners partners() const override { return laws_.partners(deck_.surface, "", body_.get()); }
  void declare_state(StateStore& store) override;
  void begin(const StepView& view) override;
  bool asks_for_prediction() const override { return laws_.friction() != nullptr && body_->active(); }
  int residual(const StepView& view, const ResidualView& f) override;
  std::string hint(const StepView& view) const override;
  void histories(const StepView& view, Report& values) override;
  double step_limit(const State& committed, double dt) const override;
  void mark_pressed(const State& state, std::vector<char>& nodes) const override;

 protected:
  bool conserves(const StepView& view) const override;

  PenaltyParameters deck_;

 private:
  /// Sums of forces on the soil [N], and of their moments about the body's centre [N m].
  struct Load {
    Point force{}, moment{};
  };
  void check_enforcement(const Section& section) const;
  /// A released body without inertia that touches nothing gets its tangent from the points that are nearest.
  /// Collective.
  void set_reach(const StepView& view);
  struct Sums;
  Sums sums(const State& state) const;
  void check_quadrature(const Section& section) const;
  void check_overlap(const Section& section) const;
  void check_above(const Section& section) const;
  /// This rank's part.
  Load load_on_soil(const State& state) const;
  /// Work on the soil of forces that change from `before` to `now` while the body moves.
  static double work(const Load& before, const Load& now, const BodyPlacement& from, const BodyPlacement& to);

  std::shared_ptr<RigidBody> body_;
  RigidTarget* rigid_ = nullptr;  // the target
  int work_ = -1;                 // state handle
};

/// Penalty contact without friction, a type of its own in the deck.
class FrictionlessPenaltyContact : public PenaltyContact {
 public:
  using PenaltyContact::PenaltyContact;
  static void document(Parameters& p) { PenaltyParameters().parameters(p); }
  void parameters(Parameters& p) { deck_.parameters(p); }
};

}  // namespace mudline
