#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contact/nodes/node_pass.hpp"

namespace mudline {

/// Contact of two deformable surfaces, node to segment: the nodes of the slave against the master's surface as it is
/// drawn over the master's nodes, R_u -= (x_slave - y(eta))_{,u} . (t n + s m) A at n+1 with the node's tributary area
/// A, see node_force(). With a second pass the master's nodes look for the slave too, and each pass has half of the
/// forces.
///
/// Parallel: as PairContact. State arrays: those of NodePass, with the prefixes "contact/<name>/" and
/// "contact/<name>/second ".
class NodeContact : public TwoSurfaceContact<NodeParameters> {
 public:
  explicit NodeContact(const ContactContext& context) : TwoSurfaceContact(context) {}
  /// InputError for unknown, empty, equal or touching sets, deep overlap at the start, two passes with multipliers,
  /// friction on the effective traction of surfaces with pore pressure. Collective.
  void check(const Section& section);

  void declare_state(StateStore& store) override;
  void sparsity(Assembler& assembler) override;
  void begin(const StepView& view) override;
  void predicting(bool on) override;
  int residual(const StepView& view, const ResidualView& f) override;
  void correction(const StepView& view, const ResidualView& f) override;
  void jacobian(const StepView& view, Assembler& assembler, double weight) override;
  Augmentation augment(const StepView& view, int count) override;
  void histories(const StepView& view, Report& values) override;
  double step_limit(const State& committed, double dt) const override;
  void relocate(const ConstCoordinateView& x_old, State& committed) override;
  void adopt(const State& evaluated, State& committed) override;
  std::vector<double> nodal_pressure(const State& state) const override;
  std::vector<double> nodal_shear(const State& state) const override;

 private:
  std::vector<double> nodal_sum(const State& state, int column) const;

  std::vector<std::unique_ptr<NodePass>> passes_;
  double gap_tolerance_ = 0;  // [m]
};

}  // namespace mudline
