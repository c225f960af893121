#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "contact/body/initial_gap.hpp"
#include "contact/body/leaky_surface.hpp"
#include "contact/body/point_rows.hpp"
#include "contact/body/water_film.hpp"
#include "contact/contact_laws.hpp"
#include "contact/contact_surface.hpp"
#include "contact/uzawa.hpp"
#include "framework/closed_sides.hpp"
#include "framework/first_act.hpp"

namespace mudline {

/// Deck entries of a penalty contact, besides friction.
struct PenaltyParameters : EnforcementParameters {
  PenaltyParameters() : EnforcementParameters{Enforcement::penalty} {}
  enum class Drainage { sealed, drained, leaky, film };
  enum class Impact { automatic, conserving, interpolated };
  void parameters(Parameters& p);

  std::string body, surface;
  ContactPoints method = ContactPoints::quadrature;
  int quadrature_degree = 5;
  double capture_distance = 0;  // [m]
  double advance_limit = 0.25;  // [-] of the shortest side
  Drainage drainage = Drainage::sealed;
  Impact impact = Impact::automatic;
  double damping = 0;        // [s/m]
  double sealing_gap = 0.1;  // [-] of the side's length
  double conductance = 0;    // [m/(Pa s)]
  Function outside;          // [Pa] pore pressure on the body's side
  WaterFilm film;
  InitialGap initial_gap;
  bool has_film() const { return drainage == Drainage::film; }
};

/// Contact of a soil surface with a rigid body: R_u -= int N^T (t n + s) dA at n+1, t = penalty <-gap> [Pa], n from
/// the body into the soil, s [Pa] along the surface from the friction law, 0 without one; axisymmetric forces are those
/// of the whole circumference, plane strain ones per metre.
///
/// Augmented Lagrangian: t = <lambda - penalty gap>, and the stick spring of friction starts from a multiplier
/// likewise. After each solve of a step lambda grows by t - lambda (Uzawa) as far as that is in the space of the sides'
/// shapes: a side has more contact points than nodes, and cannot follow a body at all of them. This ends when the gap
/// weighted by the shapes, and the stretch of the stick springs, are within the gap tolerance at all nodes.
///
/// Initial gap: a point's gap may be counted from that of the state in which the contact first acts (see InitialGap).
///
/// State arrays: those of the points (see PointRows), "contact/<name>/penalty" (a row per side, frozen when the contact
/// first starts a step), "contact/<name>/work" (this rank's share of the work done on the soil, trapezoidal in the
/// body's motion; heat of damping so far; force of damping on the soil in the last step).
///
/// Drainage: a side is closed to the pore water (what conditions prescribe on it is off) while more than half of its
/// points are at the body in the committed state: lagged by one step, so that Newton sees a fixed set. Leaky: these
/// sides let water through instead, see LeakySurface. Film: water stands between them and the body, see WaterFilm.
class PenaltyContact : public Contact, public ClosesSides, public FirstActs {
 public:
  explicit PenaltyContact(const ContactContext& context) : context_(context) {}
  static void document(Parameters& p);
  void parameters(Parameters& p);
  /// Binds to body and surface. InputError for unknown names, empty surfaces and deep initial overlap. Collective.
  void check(const Section& section);

  std::string name() const override { return "contact/" + name_; }
  ContactPartners partners() const override { return {deck_.surface, "", body_.get(), laws_.friction() != nullptr}; }
  void declare_state(StateStore& store) override;
  void sparsity(Assembler& assembler) override;
  void first_act(State& committed) override;
  void begin(const StepView& view) override;
  bool asks_for_prediction() const override { return laws_.friction() != nullptr && body_->active(); }
  void predicting(bool on) override { predicting_ = on; }
  void close(const State& committed, ClosedSides& closed) const override;
  int residual(const StepView& view, const ResidualView& f) override;
  void correction(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;
  Augmentation augment(const StepView& view, int count) override;
  std::string hint(const StepView& view) const override;
  void histories(const StepView& view, Report& values) override;
  double step_limit(const State& committed, double dt) const override;
  void relocate(const ConstCoordinateView& x_old, State& committed) override;
  void take_evaluated(const State& evaluated, State& committed) override;
  std::vector<SurfaceRows> surface_rows(const ConstCoordinateView& x) const override;
  std::vector<double> nodal_pressure(const State& state) const override;
  void mark_pressed(const State& state, std::vector<char>& nodes) const override;
  std::vector<double> nodal_shear(const State& state) const override;

 protected:
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
  /// Data of a point of a side before it is evaluated. The multiplier of its shear stress counts by its change in this
  /// step.
  ContactStart point_start(const StepView& view, std::size_t side, int row) const;
  ContactPointLaw law(const StepView& view, std::size_t side) const;
  void check_enforcement(const Section& section) const;
  /// The multiplier of a point's shear stress with which a step starts [Pa].
  Point initial_shear_multiplier(const State& committed, int row) const;
  void start_multipliers(const StepView& view) const;
  Misfit misfit(const State& state) const;
  /// Data of the sides at the linearisation point.
  std::vector<ContactSides> look(const StepView& view, const Positions& at) const;
  SideContact side_contact(const StepView& view, const Positions& at, std::size_t side) const;
  /// A released body without inertia that touches nothing gets its tangent from the points that are nearest.
  /// Collective.
  void set_reach(const StepView& view);
  struct Sums;
  Sums sums(const State& state) const;
  /// Mean of a quantity of the rows, by local node.
  std::vector<double> nodal_mean(const std::function<double(int row)>& quantity) const;
  /// Closes the initial gaps of one side's points, and sets their pressures.
  void touch_first(std::size_t side, const State& committed, const BodyPlacement& placement, FirstTouch& found) const;
  /// Pressure [Pa] of the soil's stress at a point of a side that touches the body with this normal.
  double in_situ_pressure(std::size_t side, int point, const State& committed, const Point& at, const Point& outward,
                          const Point& normal) const;
  /// Penetration [m] at which a point has this pressure [Pa].
  double in_situ_penetration(std::size_t side, int point, const State& committed, double pressure) const;
  /// Pore pressure at a point of a side [Pa]; 0 where the contact does not read it.
  double pore_pressure(std::size_t side, int point, const State& state) const;
  /// Counted gap [m] of a point that is at `at`.
  double gap(const State& state, int row, const BodyPlacement& placement, const Point& at) const {
    return body_->gap(placement, at) - deck_.initial_gap.offset(state, row);
  }
  /// Lower bound of the geometric gap of a side's points [m].
  double least_gap(std::size_t side, const ConstCoordinateView& coordinates_now, const BodyPlacement& placement) const;
  const ContactRule& rule(const SurfaceSide& side) const { return rules_.at(side.shape); }
  void check_drainage(const Section& section) const;
  void check_quadrature(const Section& section) const;
  void check_overlap(const Section& section) const;
  void check_above(const Section& section) const;
  /// A point of a skipped side. Its gap is the capture distance, which is a lower bound.
  ContactPoint away(const StepView& view, int row) const;
  /// Whether more than half of the side's points are nearer to the body than the sealing gap, or in it.
  bool covered(std::size_t side, const State& committed, const BodyPlacement& placement) const;
  std::vector<char> covered_sides(const State& committed) const;  // (side)
  /// Force and moment on the soil, this rank's part.
  PointForce local_force(const State& state) const;
  /// Work on the soil of forces that change from `before` to `now` while the body moves.
  static double work(const PointForce& before, const PointForce& now, const BodyPlacement& from,
                     const BodyPlacement& to);
  int axes() const { return context_.space.mesh().dimension(); }

  ContactContext context_;
  ContactLaws laws_;
  std::string name_;
  std::shared_ptr<RigidBody> body_;
  std::unique_ptr<ContactSurface> surface_;
  std::unique_ptr<LeakySurface> leak_;      // null unless leaky
  std::map<CellShape, ContactRule> rules_;  // of the sides
  std::vector<int> first_row_;              // (side) in the points array; one more: number of rows
  std::vector<char> candidate_;             // (side) near enough to be evaluated in this step
  double capture_ = 0;                      // [m] of this step
  double gap_tolerance_ = 0;                // [m]
  double touch_ = 0;                        // see SideContact::reach
  bool predicting_ = false;
  int pressure_ = -1, temperature_ = -1;
  PointRows rows_;
  int penalties_ = -1, work_ = -1;  // state handles
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
