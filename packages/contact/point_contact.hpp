#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "contact/contact_laws.hpp"
#include "contact/contact_rule.hpp"
#include "contact/contact_surface.hpp"
#include "contact/parts/drainage.hpp"
#include "contact/parts/initial_gap.hpp"
#include "contact/parts/leaky_surface.hpp"
#include "contact/point_rows.hpp"
#include "contact/target.hpp"
#include "contact/uzawa.hpp"
#include "framework/closed_sides.hpp"
#include "framework/first_act.hpp"
#include "framework/surface_points.hpp"

namespace mudline {

/// Deck entries of the parts that a contact of points may have.
struct PartParameters {
  explicit PartParameters(Drainage::Kind usual) : drainage(usual) {}
  Drainage drainage;
  InitialGap initial_gap;
};

/// Contact of the points of a slave surface, its nodes or its Gauss points, with a target: a rigid body or another
/// deformable surface. This class has the points, their laws and state, and the parts that see only points, gaps and
/// normals: initial gap, drainage, film. The classes of the targets evaluate the points.
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
  void close(const State& committed, ClosedSides& closed) const override;
  void first_act(State& committed) override;
  Augmentation augment(const StepView& view, int count) override;
  std::vector<double> nodal_pressure(const State& state) const override;
  std::vector<double> nodal_shear(const State& state) const override;

 protected:
  /// `deck` and `parts`: members of the contact.
  PointContact(const ContactContext& context, const EnforcementParameters& deck, PartParameters& parts)
      : context_(context), enforcement_(deck), parts_(parts) {}
  /// What a point sees of the target in a committed state.
  struct Nearest {
    double gap;  // [m] of the geometry
    Point normal;
    TargetPlace at;  // of a deformable target
  };
  /// Called before the target is asked about a committed state between steps.
  virtual void look_at(const State&) const {}
  /// False where no point of the side is nearer to the target than `distance` [m].
  virtual bool may_be_near(const State& committed, std::size_t side, double distance) const = 0;
  /// The target at a point of the slave with this outward normal; nothing where it has none within `distance` [m].
  virtual std::optional<Nearest> nearest(const State& committed, std::size_t side, const Point& place,
                                         const Point& outward, double distance) const = 0;
  /// Writes a point in the state in which the contact first acts.
  virtual void write_first(const State& committed, int row, const Point& place, const Nearest& nearest,
                           ContactPoint& point) const = 0;
  /// Weight of a row in means over the surface, beside its nearness to the node.
  virtual double share(int) const { return 1; }
  /// Areas of a side's points without the circumference [m2], by which multipliers are weighted: nodes on the axis
  /// count too. False where the side is degenerate.
  virtual bool lengths(std::size_t side, const State& state, double* of_points) const;
  /// The multiplier of a point's shear stress with which a step starts [Pa].
  virtual Point initial_shear_multiplier(const State& committed, int row) const;

  /// Finds the fields and reads the laws.
  void read(const Section& section);
  /// InputError for parts that have no meaning. `conserving`, `damping`: the deck asks for them.
  void check_parts(const Section& section, bool conserving, bool damping) const;
  /// Makes surface, rules and rows.
  void make_points(const std::string& surface, const BodyUnknowns& body, ContactPoints kind, int quadrature_degree);
  /// Declares all arrays; `more`: further columns of the points, which the target needs.
  void declare_points(StateStore& store, const std::vector<StateVariable>& more);
  /// Starts penalties, multipliers, film and leaking for a step.
  void begin_parts(const StepView& view);
  ContactPointLaw law(const StepView& view, std::size_t side, double damping) const;
  /// History of a point. The multiplier of its shear stress counts by its change in this step.
  PointHistory history(const StepView& view, std::size_t side, int row, const Point& place_old) const;
  /// Film of a side in a step.
  SideFilm film(const StepView& view, std::size_t side) const;
  void write_point(const State& trial, int row, const ContactPoint& point) const;
  /// A point that is too far away to be evaluated.
  ContactPoint away(const State& committed, int row, double gap) const;
  /// Pore pressure at a point of a side [Pa], of nodal values by overlap dof; 0 where the contact does not read it.
  double pore_pressure(std::size_t side, int point, const ConstNodalView& values) const;
  /// Shapes of the pore pressure's nodes at a point of a side.
  const double* pressure_shape(const SurfaceSide& side, int point) const;
  /// Differences between stresses and multipliers. Collective.
  Misfit misfit(const State& state) const;
  /// History columns of the parts and of multipliers; `sign`: -1 where forces are those on the target. Collective.
  void report_parts(const State& state, double sign, Report& values) const;
  std::vector<double> nodal_mean(const std::function<double(int row)>& quantity) const;

  int axes() const { return context_.space.mesh().dimension(); }
  int rows() const { return first_row_.back(); }
  const std::vector<SurfaceSide>& sides() const { return surface_->sides(); }
  const ContactRule& rule(const SurfaceSide& side) const { return rules_.at(side.shape); }
  double penalty(const State& state, std::size_t side) const { return state.arrays[penalties_](side, 0); }

  ContactContext context_;
  ContactLaws laws_;
  std::string name_;
  int displacement_ = -1, pressure_ = -1, temperature_ = -1;  // fields
  std::unique_ptr<ContactSurface> surface_;
  std::unique_ptr<LeakySurface> leak_;           // null unless leaky
  std::map<CellShape, ContactRule> rules_;       // of the sides
  std::vector<int> first_row_;                   // (side) one more: number of rows
  std::shared_ptr<const SurfacePoints> places_;  // of the rows
  double gap_tolerance_ = 0;                     // [m]
  bool predicting_ = false;
  PointRows rows_;
  int penalties_ = -1;  // state handle

 private:
  void start_multipliers(const StepView& view) const;

  const EnforcementParameters& enforcement_;
  PartParameters& parts_;
  std::string set_;  // side set of the surface

  /// Closes the initial gaps of one side's points, and sets their pressures.
  void touch_first(std::size_t side, const State& committed, FirstTouch& found) const;
  /// Pressure [Pa] of the slave's stress at a point of a side that touches a target with this normal.
  double in_situ_pressure(std::size_t side, int point, const State& committed, const Point& at, const Point& outward,
                          const Point& normal) const;
  /// Penetration [m] at which a point has this pressure [Pa].
  double in_situ_penetration(std::size_t side, int point, const State& committed, double pressure) const;
  bool covered(std::size_t side, const State& committed) const;
  std::vector<char> covered_sides(const State& committed) const;  // (side)
};

}  // namespace mudline
