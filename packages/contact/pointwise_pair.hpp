#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "contact/point_contact.hpp"
#include "contact/target_point.hpp"
#include "contact/two_surfaces.hpp"

namespace mudline {

/// Deck entries of the contacts of two surfaces whose points press one by one.
struct PointwiseParameters : TwoSurfaceParameters, PartParameters {
  PointwiseParameters() : TwoSurfaceParameters(Enforcement::penalty), PartParameters(Drainage::Kind::drained) {}
  /// Forces in a dynamic step. conserving: the share of it that does the work of the penalty spring. interpolated: what
  /// the integrator interpolates.
  enum class Impact { conserving, interpolated };
  void declare_corner_angle(Parameters& p);
  /// Declares "impact" and the entries of the parts.
  void declare_rest(Parameters& p);

  double corner_angle = 45;  // [deg]
  Impact impact = Impact::conserving;
};

/// Contact of the points of a slave surface, its nodes or its Gauss points, with a deformable target, one by one: R_u
/// -= (x - y)_{,u} . (t n + s) A at n+1 with the area A of the point at the start of the step, see target_force().
/// Rows: the points of each slave side; a rank has those of its sides. Impact of a point adds no energy, see
/// end_share().
///
/// Multipliers of nodes take the stress of their node: there are as many as conditions.
///
/// Film: the target takes its pressure, but no water. Parallel: a rank computes its slave sides against the whole
/// target, whose nodes it has as ghosts (SetPairs). With damping the state has "contact/<name>/damping", one row: its
/// heat so far.
class PointwisePairContact : public PointContact {
 public:
  ContactPartners partners() const override {
    return {deck_.slave, deck_.master, nullptr, laws_.friction() != nullptr};
  }
  bool asks_for_prediction() const override { return laws_.friction() != nullptr; }
  void declare_state(StateStore& store) override;
  void sparsity(Assembler& assembler) override;
  void begin(const StepView& view) override;
  int residual(const StepView& view, const ResidualView& f) override;
  void correction(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;
  std::string hint(const StepView& view) const override;
  Augmentation augment(const StepView& view, int count) override;
  void histories(const StepView& view, Report& values) override;
  double step_limit(const State& committed, double dt) const override;

 protected:
  PointwisePairContact(const ContactContext& context, PointwiseParameters& deck)
      : PointContact(context, deck, deck), deck_(deck) {}
  /// First part of every check(): sets, laws and parts.
  void check_entries(const Section& section, int dimension);
  /// Last part of every check(): makes the slave's points, and compares them with the target. `reach` [m]: see the
  /// deck.
  void bind(const Section& section, std::unique_ptr<Target> target, ContactPoints kind, int quadrature_degree,
            double reach);

  void look_at(const State& committed) const override { target_->update(committed.coordinates); }
  bool may_be_near(const State& committed, std::size_t side, double distance) const override;
  std::optional<Nearest> nearest(const State& committed, std::size_t side, const Point& place, const Point& outward,
                                 double distance) const override;
  void write_first(const State& committed, int row, const Point& place, const Nearest& nearest,
                   ContactPoint& point) const override;
  double share(int row) const override { return points_[row].share; }
  bool lengths(std::size_t side, const State& state, double* of_points) const override;
  Point initial_shear_multiplier(const State& committed, int row) const override;

 private:
  struct SlavePoint {
    int side, point;   // side of the slave; point of its rule
    double area = 0;   // [m2] at the start of the step
    double share = 1;  // weight in means over the surface: of a node its length [m] on the side
    Point outward{};   // direction out of the slave
  };
  /// Positions in which gaps are measured, at both ends of the step.
  struct Positions {
    ConstCoordinateView old, end;
  };
  /// What a point sees of the target.
  struct Seen {
    TargetPlace at;
    ClosestPoint closest;
    int entry = -1;  // in the dof table; -1: none
  };
  const SurfaceSide& side(int row) const { return sides()[points_[row].side]; }
  const ContactRule& rule(int row) const { return rules_.at(side(row).shape); }
  double stiffness(const State& state, int row) const { return penalty(state, points_[row].side); }
  Point place(int row, const ConstCoordinateView& x) const;
  void measure(const ConstCoordinateView& x);
  bool conserves(const StepView& view) const;
  Positions positions(const StepView& view) const;
  bool look(int row, const ConstCoordinateView& x, Seen& seen) const;
  int entry(int row, int piece) const;
  ContactPointLaw law(const StepView& view, int row) const;
  /// `film`: of the point's side, here and below.
  TargetForce evaluate(const StepView& view, const Positions& at, int row, const Seen& seen, const SideFilm& film,
                       bool want_tangent) const;
  TargetColumns columns(int row, int piece, const double* of_target) const;
  void write(const State& trial, int row, const ContactPoint& point, const TargetPlace& at, const Point& normal) const;
  /// Writes a point that sees nothing of the target. Its gap is the capture distance, which is a lower bound.
  void write_away(const StepView& view, int row) const;
  /// Remembers the rates of the film's water at a point.
  void add_film(const StepView& view, int row, const Seen& seen, const SideFilm& film, const TargetForce& force,
                const ResidualView& f);
  void add_film_tangent(const StepView& view, const MatrixScatter& to, int row, const Seen& seen, const SideFilm& film,
                        const TargetForce& force) const;
  /// Gradients of the pore pressure's shapes at a point, along the side at the start of the step [1/m].
  void pressure_slopes_at(const StepView& view, int row, Point* slope) const;
  /// Gradient of the film's pressure less the water's weight [Pa/m].
  Point drive(const StepView& view, int row, const SideFilm& film, const Point* slope) const;
  /// First column of the pore pressures in a row of the dof table.
  int first_pressure(int row, const Seen& seen) const;
  void remember(int entry, const TargetColumns& columns, double factor, const Point& force);
  /// Piece on which a point pressed at the start of the step, and its columns there.
  int old_piece(const State& committed, int row) const;
  TargetColumns old_columns(const State& committed, int row) const;
  /// Corrects the old force of a point that pressed at the start of the step: it acts with this share, not with the
  /// integrator's weight.
  void add_old_share(const StepView& view, int row, double share);
  template <int D>
  void add_tangent(const StepView& view, const MatrixScatter& to, int row, const Seen& seen, const TargetForce& force,
                   double weight, double moved) const;

  const PointwiseParameters& deck_;
  std::unique_ptr<Target> target_;
  bool at_nodes_ = false;
  std::vector<SlavePoint> points_;              // (row)
  std::vector<std::vector<int>> candidates_;    // (slave side) pieces
  std::unordered_map<long long, int> entries_;  // (slave side, piece) in the dof table
  ElementDofs dofs_;                            // displacements of slave and piece, pore pressures of the slave
  int group_ = -1;
  double reach_ = 0, capture_ = 0, touch_ = 0;      // [m]
  std::vector<std::pair<int, double>> correction_;  // (dof, force) of the last residual call, at the alpha level
  bool beyond_reach_ = false;                       // surfaces met in this step for which the matrix has no entries
  int damping_ = -1;                                // state handle
};

}  // namespace mudline
