#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "contact/body/penalty_side.hpp"
#include "contact/point_contact.hpp"

namespace mudline {

/// Deck entries of a penalty contact, besides friction.
struct PenaltyParameters : EnforcementParameters, PartParameters {
  PenaltyParameters() : EnforcementParameters{Enforcement::penalty}, PartParameters(Drainage::Kind::sealed) {}
  enum class Impact { automatic, conserving, interpolated };
  void parameters(Parameters& p);

  std::string body, surface;
  ContactPoints method = ContactPoints::quadrature;
  int quadrature_degree = 5;
  double capture_distance = 0;  // [m]
  double advance_limit = 0.25;  // [-] of the shortest side
  Impact impact = Impact::automatic;
  double damping = 0;  // [s/m]
};

/// Contact of a soil surface with a rigid body: R_u -= int N^T (t n + s) dA at n+1, t = penalty <-gap> [Pa], n from
/// the body into the soil, s [Pa] along the surface from the friction law, 0 without one; axisymmetric forces are those
/// of the whole circumference, plane strain ones per metre.
///
/// State arrays beside those of PointContact, whose points have their height above the body's reference point and
/// moment about its centre here: "contact/<name>/work" (this rank's share of the work done on the soil, trapezoidal in
/// the body's motion; heat of damping so far; force of damping on the soil in the last step).
class PenaltyContact : public PointContact {
 public:
  explicit PenaltyContact(const ContactContext& context) : PointContact(context, deck_, deck_) {}
  static void document(Parameters& p);
  void parameters(Parameters& p);
  /// Binds to body and surface. InputError for unknown names, empty surfaces and deep initial overlap. Collective.
  void check(const Section& section);

  ContactPartners partners() const override { return {deck_.surface, "", body_.get(), laws_.friction() != nullptr}; }
  void declare_state(StateStore& store) override;
  void sparsity(Assembler& assembler) override;
  void begin(const StepView& view) override;
  bool asks_for_prediction() const override { return laws_.friction() != nullptr && body_->active(); }
  int residual(const StepView& view, const ResidualView& f) override;
  void correction(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;
  std::string hint(const StepView& view) const override;
  void histories(const StepView& view, Report& values) override;
  double step_limit(const State& committed, double dt) const override;
  void mark_pressed(const State& state, std::vector<char>& nodes) const override;

 protected:
  bool may_be_near(const State& committed, std::size_t side, double distance) const override;
  std::optional<Nearest> nearest(const State& committed, std::size_t side, const Point& place, const Point& outward,
                                 double distance) const override;
  void write_first(const State& committed, int row, const Point& place, const Nearest& nearest,
                   ContactPoint& point) const override;

  PenaltyParameters deck_;

 private:
  /// Where gaps are measured, at both ends of the step.
  struct Positions {
    BodyPlacement body_old, body_end;
    ConstCoordinateView x_old, x_end;
  };
  Positions positions(const StepView& view) const;
  /// Whether points exert the shares of impacts in dynamic steps.
  bool conserves(const StepView& view) const;
  /// Whether damping acts.
  bool damps(const StepView& view) const { return deck_.damping > 0 && view.kind == StepView::Kind::step; }
  /// The heat of friction goes into the soil: the body takes none. Without derivatives, for it changes forces slowly.
  void add_heat(const StepView& view, const ResidualView& f) const;
  /// Adds the damping of the points to the sums of the trial state.
  void add_damping(const State& trial) const;
  void check_enforcement(const Section& section) const;
  /// Data of the sides at the linearisation point.
  std::vector<ContactSides> look(const StepView& view, const Positions& at) const;
  SideContact side_contact(const StepView& view, const Positions& at, std::size_t side) const;
  /// A released body without inertia that touches nothing gets its tangent from the points that are nearest.
  /// Collective.
  void set_reach(const StepView& view);
  struct Sums;
  Sums sums(const State& state) const;
  /// Lower bound of the geometric gap of a side's points [m].
  double least_gap(std::size_t side, const ConstCoordinateView& coordinates_now, const BodyPlacement& placement) const;
  void check_quadrature(const Section& section) const;
  void check_overlap(const Section& section) const;
  void check_above(const Section& section) const;
  void write(const State& trial, int row, const ContactPoint& point) const;
  /// Force on the soil at a point, and its moment about the body's centre.
  PointForce total(const State& state, int row) const;
  /// Force and moment on the soil, this rank's part.
  PointForce local_force(const State& state) const;
  /// Work on the soil of forces that change from `before` to `now` while the body moves.
  static double work(const PointForce& before, const PointForce& now, const BodyPlacement& from,
                     const BodyPlacement& to);

  std::shared_ptr<RigidBody> body_;
  std::vector<char> candidate_;  // (side) near enough to be evaluated in this step
  double capture_ = 0;           // [m] of this step
  double touch_ = 0;             // see SideContact::reach
  int work_ = -1;                // state handle
  /// The sides of a shape on this rank, by row of their dofs.
  struct ShapeSides {
    int group = -1;  // of the assembler
    RowLists rows;
    Kokkos::View<SideContact*> sides;
    PointView later;  // (side, dof) of the last residual call: what is added at the alpha level
  };
  std::map<CellShape, ShapeSides> shapes_;
  Kokkos::View<ContactStart*> starts_;  // by row of points, like happens_
  Kokkos::View<ContactPoint*> happens_;
};

/// Penalty contact without friction, a type of its own in the deck.
class FrictionlessPenaltyContact : public PenaltyContact {
 public:
  using PenaltyContact::PenaltyContact;
  static void document(Parameters& p) { PenaltyParameters().parameters(p); }
  void parameters(Parameters& p) { deck_.parameters(p); }
};

}  // namespace mudline
