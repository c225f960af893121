#pragma once

#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "contact/contact_laws.hpp"
#include "contact/contact_rule.hpp"
#include "contact/contact_surface.hpp"
#include "contact/nodes/node_parameters.hpp"
#include "contact/nodes/smooth_surface.hpp"

namespace mudline {

/// What one pass needs of its contact.
struct NodePassSettings {
  const ContactContext* context;
  const NodeParameters* deck;
  ContactLaws* laws;
  double share;        // of every force: 1, or 1/2 where a second pass does the other half
  std::string prefix;  // of its state arrays
};

/// The nodes of one surface against another one, drawn over its nodes. Rows: the nodes of each slave side, with their
/// tributary area of that side, so that a node between two sides has two rows; a rank has the rows of its sides.
///
/// State arrays, a row each: "<prefix>points", see node_column; "<prefix>multipliers" (normal and shear, augmented
/// Lagrangian);
/// "<prefix>active set" (see ActiveSet), "<prefix>penalty" (a row per side, frozen when the contact first starts a
/// step),
/// "<prefix>damping" (with damping, one row: its heat so far).
class NodePass {
 public:
  /// Collective.
  NodePass(const NodePassSettings& settings, const std::string& slave, const std::string& master);
  const ContactSurface& slave() const { return slave_; }
  const MasterSurface& master() const { return sides_; }

  void declare_state(StateStore& store);
  void sparsity(Assembler& assembler);
  void begin(const StepView& view);
  void predicting(bool on) { predicting_ = on; }
  /// Adds to f; returns the number of nodes that touch where the matrix has no place.
  int residual(const StepView& view, const ResidualView& f);
  void correction(const ResidualView& f) const;
  void jacobian(const StepView& view, Assembler& assembler, double weight);

  const ActiveSet& active_set() const { return active_set_; }
  std::optional<Augmentation> update_active_set(const State& trial, const std::string& contact,
                                                double gap_tolerance) const;
  Misfit misfit(const State& state) const;
  /// One step of Uzawa's method.
  void augment(const State& trial) const;
  void relocate(const ConstCoordinateView& x_old, State& committed) const;
  void adopt(const State& evaluated, State& committed) const;
  /// Heat of damping so far, this rank's [J].
  double damping_heat(const State& state) const;
  /// Sum of a column over this rank's rows; the deepest penetration among them [m].
  double sum(const State& state, int column) const;
  double deepest(const State& state) const;
  /// Column by local node, weighted by length.
  std::vector<double> nodal_mean(const State& state, int column) const;
  /// Least gap of the nodes that see the master within `capture` [m], this rank's.
  double least_gap(double capture, const ConstCoordinateView& x) const;

 private:
  struct Row {
    int side, node;       // on this rank
    double xi;            // of the node on the side
    double area = 0;      // [m2] tributary, at the start of the step, with the pass's share
    double length = 0;    // [m] the same without the circumference
    PlanePoint facing{};  // along the side
    std::vector<int> candidates;
  };
  struct Seen {
    int piece = -1, place = -1;  // place: in the dof table, -1: none
    NodeFoot foot;
  };
  void start_active_set(const StepView& view) const;
  void measure(const ConstCoordinateView& x);
  bool look(int row, const ConstCoordinateView& x, double capture, Seen& seen) const;
  NodeLaw law(const StepView& view, int row) const;
  NodeCoordinates coordinates(int row, int piece, const ConstCoordinateView& x) const;
  bool conserves(const StepView& view) const;
  /// Where gaps are measured, at both ends of the step.
  struct Positions {
    ConstCoordinateView old, end;
  };
  Positions positions(const StepView& view) const;
  /// Force on nodes and piece that acted at the start of the step, by dof of its place.
  void old_force(const State& committed, int row, const SurfacePiece& piece, double (&force)[node_dofs]) const;
  /// A node that pressed at the start of the step exerts the share of that force, not what the integrator takes of it.
  void add_old_share(const StepView& view, int row, double share);
  void write_away(const StepView& view, int row) const;
  double penalty(const State& state, int row) const { return state.arrays[penalties_](rows_[row].side, 0); }
  bool sticks(const State& state, int row) const;
  int place(int row, int piece) const;

  NodePassSettings settings_;
  const Mesh& mesh_;
  ContactSurface slave_;
  MasterSurface sides_;
  SmoothSurface surface_;
  std::vector<ContactRule> rules_;  // for sides of 2 and of 3 nodes
  std::vector<Row> rows_;
  ActiveSet active_set_;                         // used with the outer loop only
  std::unordered_map<long long, int> place_of_;  // (row, piece)
  ElementDofs dofs_;
  int group_ = -1, displacement_ = -1;
  double capture_ = 0, touch_ = 0;                  // [m] of this step
  std::vector<std::pair<int, double>> correction_;  // (dof, share) of the last residual call
  bool predicting_ = false;
  int points_ = -1, multipliers_ = -1, penalties_ = -1, damping_ = -1;  // state handles
};

/// Columns of a pass's points.
namespace node_column {
enum : int { gap, pressure, shear, slides, force_x, force_y, area, length, slip, heat, piece, eta };
}

}  // namespace mudline
