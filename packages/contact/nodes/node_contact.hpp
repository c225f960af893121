#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "contact/contact_rule.hpp"
#include "contact/nodes/node_parameters.hpp"

namespace mudline {

/// Contact of two deformable surfaces, node to segment: the nodes of the slave against the master's surface as it is
/// drawn over the master's nodes, R_u -= (x_slave - y(eta))_{,u} . (t n + s m) A at n+1 with the node's tributary area
/// A, see node_force(). Rows: the nodes of each slave side, with their tributary area of that side, so that a node
/// between two sides has two rows; a rank has the rows of its sides.
///
/// Parallel: as PairContact. State arrays, a row each, prefix "contact/<name>/": "points", see node_column;
/// "multipliers" (normal and shear, augmented Lagrangian); "penalty" (a row per side, frozen when the contact first
/// starts a step); "damping" (with damping, one row: its heat so far).
class NodeContact : public PointwisePairContact<NodeParameters> {
 public:
  explicit NodeContact(const ContactContext& context) : PointwisePairContact(context) {}
  /// InputError for unknown, empty, equal or touching sets, deep overlap at the start, friction on the effective
  /// traction of surfaces with pore pressure. Collective.
  void check(const Section& section);

  void declare_state(StateStore& store) override;
  void sparsity(Assembler& assembler) override;
  void begin(const StepView& view) override;
  int residual(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;
  Augmentation augment(const StepView& view, int count) override;
  void histories(const StepView& view, Report& values) override;
  double step_limit(const State& committed, double dt) const override;
  void relocate(const ConstCoordinateView& x_old, State& committed) override;
  void take_evaluated(const State& evaluated, State& committed) override;
  std::vector<double> nodal_pressure(const State& state) const override;
  std::vector<double> nodal_shear(const State& state) const override;

 private:
  struct Row {
    int side, node;       // on this rank
    double xi;            // of the node on the side
    double area = 0;      // [m2] tributary, at the start of the step
    double length = 0;    // [m] the same without the circumference
    PlanePoint facing{};  // along the side
    std::vector<int> candidates;
  };
  struct Seen {
    int piece = -1, place = -1;  // place: in the dof table, -1: none
    NodeProjection projection;
  };
  void measure(const ConstCoordinateView& x);
  bool look(int row, const ConstCoordinateView& x, Seen& seen) const;
  NodeLaw law(const StepView& view, int row) const;
  NodeCoordinates coordinates(int row, int piece, const ConstCoordinateView& x) const;
  /// Force on nodes and piece that acted at the start of the step, by dof of its place.
  void old_force(const State& committed, int row, const SurfacePiece& piece, double (&force)[node_dofs]) const;
  /// Corrects the old force of a node that pressed at the start of the step: it acts with this share, not with the
  /// integrator's weight.
  void add_old_share(const StepView& view, int row, double share);
  void write_away(const StepView& view, int row) const;
  double penalty(const State& state, int row) const { return state.arrays[penalties_](rows_[row].side, 0); }
  bool sticks(const State& state, int row) const;
  int place(int row, int piece) const;
  Misfit misfit(const State& state) const;
  /// Mean of a column by local node, weighted by length.
  std::vector<double> nodal_mean(const State& state, int column) const;
  /// Least gap [m] of this rank's nodes that have a closest point on the master within `capture` [m].
  double least_gap(double capture, const ConstCoordinateView& x) const;

  std::unique_ptr<ContactSurface> slave_;
  std::unique_ptr<MasterSurface> master_;
  std::unique_ptr<SmoothSurface> surface_;  // the master, as it is drawn
  std::vector<ContactRule> rules_;          // for sides of 2 and of 3 nodes
  std::vector<Row> rows_;
  std::unordered_map<long long, int> place_of_;  // (row, piece)
  ElementDofs dofs_;
  int group_ = -1;
  double capture_ = 0, touch_ = 0;                                      // [m] of this step
  double gap_tolerance_ = 0;                                            // [m]
  int points_ = -1, multipliers_ = -1, penalties_ = -1, damping_ = -1;  // state handles
};

/// Columns of the points.
namespace node_column {
enum : int { gap, pressure, shear, slides, force_x, force_y, area, length, slip, heat, piece, eta };
}

}  // namespace mudline
