#pragma once

#include <functional>
#include <memory>
#include <string>

#include "algebra/linear_solver.hpp"

namespace mudline {

class FieldBlocks;
class FieldGmres;

/// "block amg": GMRES on the current matrix, preconditioned by block_triangular.hpp. The preconditioner is reused for
/// later matrices until the iterations grow.
class BlockAmgSolver : public LinearSolver {
 public:
  BlockAmgSolver();
  ~BlockAmgSolver() override;
  void parameters(Parameters& p);
  std::string prepare(RCP<const DofMap> dofs) override;
  void set_matrix(RCP<const CrsMatrix> matrix, const std::function<BlockData()>& block_data) override;
  LinearReport solve(const Vector& b, Vector& x, const LinearTolerance& tolerance) override;
  bool iterative() const override { return true; }
  void reset() override;

 private:
  void build();
  /// The most iterations that reducing the residual by `decades` may take with the current preconditioner.
  int most_iterations(double decades) const;

  int maximum_iterations_ = 200;
  double rebuild_growth_ = 1.3;
  RCP<const DofMap> dofs_;
  RCP<const CrsMatrix> matrix_;
  std::function<BlockData()> block_data_;
  std::unique_ptr<FieldGmres> gmres_;
  std::unique_ptr<FieldBlocks> blocks_;
  RCP<Operator> preconditioner_;
  double fresh_rate_ = -1;  // iterations per decade in the first solve with this preconditioner
  bool stale_ = false;
};

}  // namespace mudline
