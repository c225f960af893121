#pragma once

#include <memory>
#include <string>
#include <vector>

#include "algebra/field_residual.hpp"
#include "algebra/krylov.hpp"
#include "algebra/linear_solver.hpp"

namespace mudline {

class FactorOperator;

/// "direct": sparse LU by MUMPS. The order of elimination is found once per graph. With "reuse factorisation" an older
/// factorisation preconditions GMRES on the current matrix until that takes too many iterations; where the matrices
/// change so fast that it never helps, it is tried ever more rarely. Either way the requested tolerance is tested on
/// the true residual.
class MumpsSolver : public LinearSolver {
 public:
  void parameters(Parameters& p);
  std::string prepare(RCP<const DofMap> dofs) override;
  void set_matrix(RCP<const CrsMatrix> matrix, const std::function<BlockData()>& block_data) override;
  LinearReport solve(const Vector& b, Vector& x, const LinearTolerance& tolerance) override;
  bool exact() const override { return factored_ && current_; }
  void reset() override;
  /// The counters of the reuse, then the values of the matrix that the factors belong to.
  std::vector<double> memory() override;
  void restore(RCP<CrsMatrix> matrix, const std::vector<double>& memory) override;

 private:
  /// "" or why the current matrix could not be factored.
  std::string factor();
  bool may_try_old_factor();
  LinearReport solve_by_old_factor(const Vector& b, Vector& x, const LinearTolerance& tolerance);
  LinearReport solve_by_factor(const Vector& b, Vector& x, const LinearTolerance& tolerance);

  std::vector<double> factored_values_;  // local values of the matrix that factor_ belongs to
  bool reuse_ = true, reproducible_ = true;
  int reuse_iterations_ = 8;
  RCP<const DofMap> dofs_;
  std::vector<GlobalOrdinal> node_of_row_;  // for the ordering in space; else empty
  RCP<const CrsMatrix> matrix_;
  RCP<FactorOperator> factor_;
  bool factored_ = false;    // factor_ holds factors, maybe of an older matrix
  bool current_ = false;     // the factors are those of matrix_
  bool helped_ = false;      // the factors preconditioned a later matrix well
  int wait_ = 0, skip_ = 0;  // matrices to factor before old factors are tried again; how many of them remain
  std::unique_ptr<FieldResidualEvaluator> evaluate_;
  std::unique_ptr<FieldGmres> gmres_;
};

}  // namespace mudline
