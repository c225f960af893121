#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contact/deformable_target.hpp"
#include "contact/point_contact.hpp"
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

/// Contact of the points of a slave surface, its nodes or its Gauss points, with a deformable target, with the area of
/// a point at the start of the step. Rows: the points of each slave side; a rank has those of its sides. Impact of a
/// point adds no energy, see end_share(). Multipliers of nodes take the stress of their node: there are as many as
/// conditions.
///
/// With damping the state has "contact/<name>/damping", one row: its heat so far.
class PointwisePairContact : public PointContact {
 public:
  ContactPartners partners() const override { return laws_.partners(deck_.slave, deck_.master, nullptr); }
  bool asks_for_prediction() const override { return laws_.friction() != nullptr; }
  void declare_state(StateStore& store) override;
  void begin(const StepView& view) override;
  int residual(const StepView& view, const ResidualView& f) override;
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
  void bind(const Section& section, std::unique_ptr<DeformableTarget> target, SideRule::At kind, int quadrature_degree,
            double reach);

  bool conserves(const StepView& view) const override;
  bool measure(std::size_t side, const SideCoordinates& x_old, const SideCoordinates& x, bool slopes,
               PointAreas& areas) const override;
  Point outward(int row) const override { return points_[row].outward; }
  double share(int row) const override { return points_[row].share; }
  double heat_share() const override { return deck_.heat_share; }
  bool lengths(std::size_t side, const State& state, double* of_points) const override;
  Point initial_shear_multiplier(const State& committed, int row) const override;

 private:
  struct SlavePoint {
    double area = 0;   // [m2] at the start of the step
    double share = 1;  // weight in means over the surface: of a node its length [m] on the side
    Point outward{};   // direction out of the slave
  };
  void measure_points(const ConstCoordinateView& x);

  const PointwiseParameters& deck_;
  const DeformableTarget* master_ = nullptr;
  bool at_nodes_ = false;
  std::vector<SlavePoint> points_;  // (row)
  int heat_ = -1;                   // state handle
};

}  // namespace mudline
