#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "contact/contact_laws.hpp"
#include "contact/pair_dofs.hpp"
#include "contact/parts/drainage.hpp"
#include "contact/parts/initial_gap.hpp"
#include "contact/parts/leaky_surface.hpp"
#include "contact/point_rows.hpp"
#include "contact/slave_points.hpp"
#include "contact/target.hpp"
#include "contact/uzawa.hpp"
#include "framework/closed_sides.hpp"
#include "framework/first_act.hpp"

namespace mudline {

/// Deck entries of the parts that a contact of points may have.
struct PartParameters {
  explicit PartParameters(Drainage::Kind usual) : drainage(usual) {}
  Drainage drainage;
  InitialGap initial_gap;
};

/// Areas of a side's points.
struct PointAreas {
  double now[max_contact_points], old[max_contact_points];  // [m2] at the end of the step, at its start with a film
  AreaSlopes slope;                                         // of `now`
  bool fixed = false;  // those at the start count for the step, and a point without area sees nothing
};

/// Contact of the points of a slave surface, its nodes or its Gauss points, with a target: a rigid body or another
/// deformable surface: R_u -= (x - y)_{,u} . (t n + s) A at n+1, see PointAction, with what completes the mean force
/// over a step at the alpha level; axisymmetric forces are those of the whole circumference, plane strain ones per
/// metre. The classes of the targets' kinds read the deck, and say which sides and pieces may meet in a step.
///
/// Film: it takes its water from the slave; the target takes its pressure only. Parallel: a rank computes its slave
/// sides against the whole target, whose nodes it has as ghosts (SetPairs).
///
/// Augmented Lagrangian: t = <lambda - penalty gap>, and the stick spring of friction starts from a multiplier
/// likewise. After each solve of a step lambda grows by t - lambda (Uzawa) as far as that is in the space of the sides'
/// shapes: a side has more Gauss points than nodes, and cannot follow a target at all of them. This ends when the gap
/// weighted by the shapes, and the stretch of the stick springs, are within the gap tolerance at all nodes.
///
/// Initial gap: a point's gap may be counted from that of the state in which the contact first acts (see InitialGap).
///
/// State arrays, prefix "contact/<name>/": those of the points (see PointRows), "penalty" (a row per side, frozen when
/// the contact first starts a step), with an adjusted initial gap "initial gap", with a film "film".
class PointContact : public Contact, public ClosesSides, public FirstActs {
 public:
  std::string name() const override { return "contact/" + name_; }
  void predicting(bool on) override { predicting_ = on; }
  void sparsity(Assembler& assembler) override;
  int residual(const StepView& view, const ResidualView& f) override;
  void correction(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;
  void close(const State& committed, ClosedSides& closed) const override;
  void first_act(State& committed) override;
  Augmentation augment(const StepView& view, int count) override;
  std::vector<double> nodal_pressure(const State& state) const override;
  std::vector<double> nodal_shear(const State& state) const override;

 protected:
  /// `deck` and `parts`: members of the contact.
  PointContact(const ContactContext& context, const EnforcementParameters& deck, PartParameters& parts)
      : context_(context), enforcement_(deck), parts_(parts) {}
  /// Whether points exert the shares of impacts in a step, see impact_share.hpp.
  virtual bool conserves(const StepView& view) const = 0;
  /// Areas of a side's points, with their slopes if asked for. False where the side is degenerate.
  virtual bool measure(std::size_t side, const SideCoordinates& x_old, const SideCoordinates& x, bool slopes,
                       PointAreas& areas) const;
  /// Direction out of the slave at a point.
  virtual Point outward(int) const { return {}; }
  /// Weight of a row in means over the surface, beside its nearness to the node.
  virtual double share(int) const { return 1; }
  /// Areas of a side's points without the circumference [m2], by which multipliers are weighted: nodes on the axis
  /// count too. False where the side is degenerate.
  virtual bool lengths(std::size_t side, const State& state, double* of_points) const;
  /// Share of the heat of friction that goes into the slave; the rest goes into the target.
  virtual double heat_share() const { return 1; }
  /// The multiplier of a point's shear stress with which a step starts [Pa].
  virtual Point initial_shear_multiplier(const State& committed, int row) const;

  /// Finds the fields and reads the laws.
  void read(const Section& section);
  /// InputError for parts that have no meaning. `conserving`, `damping`: the deck asks for them.
  void check_parts(const Section& section, bool conserving, bool damping) const;
  /// Makes surface, rules and rows.
  void make_points(const std::string& surface, SideRule::At kind, int quadrature_degree);
  /// Declares all arrays.
  void declare_points(StateStore& store);
  /// Starts penalties, multipliers, film and leaking for a step.
  void begin_parts(const StepView& view);
  /// Differences between stresses and multipliers. Collective.
  Misfit misfit(const State& state) const;
  /// History columns of the parts and of multipliers; `sign`: -1 where forces are those on the target. Collective.
  void report_parts(const State& state, double sign, Report& values) const;
  std::vector<double> nodal_mean(const std::function<double(int row)>& quantity) const {
    return surface_->nodal_mean(quantity, [this](int row) { return share(row); });
  }

  int axes() const { return context_.space.mesh().dimension(); }
  const std::vector<SurfaceSide>& sides() const { return surface_->sides(); }
  const ContactRule& rule(const SurfaceSide& side) const { return surface_->rule(side); }
  double penalty(const State& state, std::size_t side) const { return state.arrays[penalties_](side, 0); }

  ContactContext context_;
  ContactLaws laws_;
  std::string name_;
  int displacement_ = -1, temperature_ = -1;  // fields
  std::unique_ptr<SlavePoints> surface_;
  std::unique_ptr<LeakySurface> leak_;  // null unless leaky
  double gap_tolerance_ = 0;            // [m]
  PointRows rows_;
  int penalties_ = -1;  // state handle

  std::unique_ptr<Target> target_;
  std::vector<std::vector<int>> candidates_;  // (side) pieces of the target that it may meet in this step
  double damping_ = 0;                        // [s/m] of the deck
  double reach_ = 1e300;                      // [m] sides and pieces that are farther apart at the start never meet
  double capture_ = 0;                        // [m] of this step: what is farther away sees nothing
  double touch_ = 0;                          // [m] see ContactPointLaw
  double close_ = 0;                          // [m] see PointInStep::reach
  double damped_ = 0;  // [J] heat of damping in the last residual, and its force [N] on the slave
  Point damping_force_{};
  bool beyond_reach_ = false;  // surfaces met in this step for which the matrix has no entries

 private:
  void start_multipliers(const StepView& view) const;
  /// Adds the heat of friction to the balances of heat. It has no derivatives, because it changes forces slowly.
  void add_heat(const StepView& view, const ResidualView& f) const;

  /// Evaluates all points, and calls take(side, entry, forces between the side and a piece). Without a tangent it
  /// writes the points of the trial state, and remembers what pressed elsewhere before. Returns the number of failures.
  template <class Take>
  int evaluate(const StepView& view, bool tangent, const Take& take);
  struct SideInStep;
  struct PointBuffers;
  /// The point `c` of a side as the target sees it.
  PointInStep point_in_step(const StepView& view, const SideInStep& here, int c, PointBuffers& to) const;
  /// Finds the closest point on the target; false where there is none.
  bool find(const SideInStep& here, int c, TargetPlace& place) const;
  void add_forces(const StepView& view, std::size_t side, int entry, const SideAction& action, const ResidualView& f);
  ContactPointLaw law(const StepView& view, std::size_t side) const;
  /// History of a point. The multiplier of its shear stress counts by its change in this step.
  PointHistory history(const StepView& view, std::size_t side, int row, const Point& place_old) const;
  /// Film of a side in a step.
  SideFilm film(const StepView& view, std::size_t side) const;
  void write(const State& trial, int row, const TargetPlace& place, const ContactPoint& point) const;
  /// Writes a point that sees nothing of the target. Its gap is the capture distance, which is a lower bound.
  void write_away(const StepView& view, int row) const;
  /// Whether a point slides against the direction in which it slid at the linearisation before; notes its own.
  bool turned(const State& trial, int row);
  /// Corrects the old force of a point that pressed at the start of the step on another piece than now, at this gap: it
  /// acts with its share, not with the integrator's weight.
  void leave(const StepView& view, std::size_t side, int row, double gap);

  const EnforcementParameters& enforcement_;
  PartParameters& parts_;
  std::string set_;  // side set of the surface
  bool predicting_ = false;
  std::vector<Point> slid_;  // [Pa] by row: shear stress at the last linearisation of the step, of points that slid
  PairDofs pairs_;           // of sides and pieces of the target, in the order of SideAction
  std::vector<std::pair<int, double>> later_;  // (dof, force) of the last residual call, at the alpha level

  bool covered(std::size_t side, const State& committed) const;
  std::vector<char> covered_sides(const State& committed) const;  // (side)
};

}  // namespace mudline
