#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "contact/contact_surface.hpp"
#include "contact/master_surface.hpp"
#include "contact/mortar/pair_segment.hpp"
#include "contact/pair_dofs.hpp"
#include "contact/two_surfaces.hpp"

namespace mudline {

/// Deck entries of a mortar contact, besides friction.
struct PairParameters : TwoSurfaceParameters {
  PairParameters() : TwoSurfaceParameters(Enforcement::augmented_lagrangian) {}
  void parameters(Parameters& p);

  int quadrature_degree = 5;
};

/// Contact of two deformable surfaces, segment to segment: the slave's sides are cut where the closest points of their
/// points pass from one side of the master to the next, and on each segment R_u -= int (N_slave - N_master)^T (t n + s
/// m) ds at n+1, see pair_segment(). Multipliers are linear and continuous along the slave surface (mortar); Uzawa's
/// method as in PenaltyContact. The laws see the pore pressure of the slave.
///
/// Parallel: a rank computes its slave sides against the whole master surface, whose nodes it has as ghosts (SetPairs);
/// the matrix has entries for all pairs of sides that were within `reach` of each other at the start.
///
/// State arrays, a row per corner of each slave side: "contact/<name>/sides" (mean gap; pressure and shear stress as
/// linear fields over the touching part; the side's deepest point; halves of the force on the slave, of the sliding
/// length and of the touching area; remaining misfit and stretch of Uzawa's method; path slid),
/// "contact/<name>/multipliers" (normal and shear), "contact/<name>/penalty" (a row per slave side, frozen when the
/// contact first starts a step), "contact/<name>/heat" (of friction and of damping).
class PairContact : public Contact {
 public:
  explicit PairContact(const ContactContext& context) : context_(context) {}
  static void document(Parameters& p) { declare_with_friction(p, PairParameters()); }
  void parameters(Parameters& p) { declare_with_friction(p, deck_); }
  /// InputError for unknown, empty, equal or touching sets, and for deep overlap at the start. Collective.
  void check(const Section& section);

  std::string name() const override { return "contact/" + name_; }
  ContactPartners partners() const override { return laws_.partners(deck_.slave, deck_.master, nullptr); }
  bool asks_for_prediction() const override { return laws_.friction() != nullptr; }
  void predicting(bool on) override { predicting_ = on; }
  void declare_state(StateStore& store) override;
  void sparsity(Assembler& assembler) override;
  void begin(const StepView& view) override;
  int residual(const StepView& view, const ResidualView& f) override;
  void correction(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;
  Augmentation augment(const StepView& view, int count) override;
  std::string hint(const StepView&) const override {
    return beyond_reach_hint(*context_.space.mesh().comm(), name_, beyond_reach_);
  }
  void histories(const StepView& view, Report& values) override;
  double step_limit(const State& committed, double dt) const override;
  std::vector<double> nodal_pressure(const State& state) const override;
  std::vector<double> nodal_shear(const State& state) const override;

 private:
  struct Pair {
    int slave, master;  // sides
    int row;            // in the dof table; -1: the matrix has no entries for it
  };
  void check_overlap(const Section& section) const;
  PairLaw law(const StepView& view, int slave) const;
  PairCoordinates coordinates(const Pair& pair, const ConstCoordinateView& x) const;
  /// Mass matrix of the multipliers' shapes on a slave side [m].
  Mat<double, side_multipliers> mass(int slave, const ConstCoordinateView& x) const;
  void write_side(const StepView& view, int slave, const PairSums& sums, const double (&force)[2]) const;
  /// Adds the heat of friction between two sides to correction_.
  void add_heat(const StepView& view, const Pair& pair, const PairForce& force);
  Misfit misfit(const State& state) const;
  std::vector<double> nodal_mean(const State& state, int column) const;

  ContactContext context_;
  PairParameters deck_;
  ContactLaws laws_;
  std::string name_;
  int displacement_ = -1, temperature_ = -1;  // fields
  bool beyond_reach_ = false;                 // surfaces met in this step for which the matrix has no entries
  bool predicting_ = false;
  std::vector<std::pair<int, double>> correction_;  // (dof, damping or rate of heat) of the last residual call
  std::unique_ptr<ContactSurface> slave_;
  std::unique_ptr<MasterSurface> master_;
  std::vector<Pair> pairs_;  // of this step, ordered by slave side
  PairDofs dofs_;
  QuadratureRule rule_;                                             // on a segment
  int nodes_ = 3;                                                   // of a side
  double gap_tolerance_ = 0, capture_ = 0, touch_ = 0;              // [m]
  int sides_ = -1, multipliers_ = -1, penalties_ = -1, heat_ = -1;  // state handles
};

/// Columns of the array "sides".
namespace pair_column {
enum : int { gap, pressure, shear, deepest, force_x, force_y, slides, area, misfit, stretch, slip };
}

}  // namespace mudline
