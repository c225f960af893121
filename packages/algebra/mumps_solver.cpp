#include "algebra/mumps_solver.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "algebra/mumps_factor.hpp"
#include "algebra/node_ordering.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

/// The most matrices that are factored without trying the old factors, when those never help.
constexpr int longest_wait = 15;

}  // namespace

/// The factors of one graph as an operator, the preconditioner of the reuse path.
class FactorOperator : public Operator {
 public:
  FactorOperator(const CrsMatrix& matrix, bool one_process, const std::vector<GlobalOrdinal>& node_of_row)
      : graph_(matrix.getCrsGraph()), factor_(matrix, one_process, node_of_row) {}
  bool fits(const CrsMatrix& matrix) const { return graph_ == matrix.getCrsGraph(); }
  std::string factor(const CrsMatrix& matrix) { return factor_.factor(matrix); }
  RCP<const Map> getDomainMap() const override { return graph_->getRowMap(); }
  RCP<const Map> getRangeMap() const override { return graph_->getRowMap(); }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp = Teuchos::NO_TRANS, double = 1,
             double = 0) const override {
    factor_.solve(x, y);
  }

 private:
  RCP<const CrsMatrix::crs_graph_type> graph_;
  MumpsFactor factor_;
};

void MumpsSolver::parameters(Parameters& p) {
  p.add("reuse factorisation", reuse_,
        "Keep a factorisation as a preconditioner for the following matrices until it takes too many iterations");
  p.add(
      "reuse iterations", reuse_iterations_, "-", closed(1, 100),
      "Iterations with an old factorisation after which the matrix is factored again; a factorisation costs about ten");
  p.add("reproducible", reproducible_,
        "On several ranks, factor on the first alone, so that a repeated run gives the same bits; false: on all ranks, "
        "which is "
        "faster for large problems but differs in the last digits from run to run");
}

std::string MumpsSolver::prepare(RCP<const DofMap> dofs) {
  reset();
  dofs_ = std::move(dofs);
  evaluate_ = std::make_unique<FieldResidualEvaluator>(dofs_);
  gmres_ = std::make_unique<FieldGmres>(dofs_);
  bool in_space = false;
  for (int f = 0; f < dofs_->num_fields(); ++f)
    in_space = in_space || (dofs_->field(f).components == 3 && !dofs_->field(f).apart);
  // In the plane the order that MUMPS finds is as good.
  node_of_row_ = in_space ? nodes_of_rows(*dofs_) : std::vector<GlobalOrdinal>();
  return "";
}

void MumpsSolver::set_matrix(RCP<const CrsMatrix> matrix, const std::function<BlockData()>& /*block_data*/) {
  matrix_ = std::move(matrix);
  current_ = false;
}

void MumpsSolver::reset() {
  factor_ = Teuchos::null;
  factored_ = current_ = helped_ = false;
  wait_ = skip_ = 0;
}

std::string MumpsSolver::factor() {
  if (factor_.is_null() || !factor_->fits(*matrix_))
    factor_ = rcp(new FactorOperator(*matrix_, reproducible_, node_of_row_));
  const std::string reason = factor_->factor(*matrix_);
  factored_ = current_ = reason.empty();
  helped_ = false;
  const auto values = matrix_->getLocalMatrixHost().values;
  factored_values_.assign(values.data(), values.data() + values.extent(0));
  return reason;
}

std::vector<double> MumpsSolver::memory() {
  if (!factored_ || !(reuse_ || current_)) return {};
  std::vector<double> memory{static_cast<double>(wait_), static_cast<double>(skip_), helped_ ? 1.0 : 0.0,
                             current_ ? 1.0 : 0.0};
  memory.insert(memory.end(), factored_values_.begin(), factored_values_.end());
  return memory;
}

void MumpsSolver::restore(RCP<CrsMatrix> matrix, const std::vector<double>& memory) {
  {
    auto values = matrix->getLocalMatrixHost().values;
    if (memory.size() != values.extent(0) + 4)
      throw std::logic_error("the direct solver's memory does not fit the matrix");
    for (std::size_t i = 0; i < values.extent(0); ++i) values(i) = memory[i + 4];
  }
  matrix_ = matrix;
  factor();
  current_ = memory[3] != 0;
  wait_ = static_cast<int>(memory[0]);
  skip_ = static_cast<int>(memory[1]);
  helped_ = memory[2] != 0;
}

bool MumpsSolver::may_try_old_factor() {
  if (!reuse_ || !factored_ || current_ || !factor_->fits(*matrix_)) return false;
  if (skip_ == 0) return true;
  --skip_;
  return false;
}

LinearReport MumpsSolver::solve(const Vector& b, Vector& x, const LinearTolerance& tolerance) {
  if (matrix_.is_null()) throw std::logic_error("direct solver used before it has a matrix");
  int spent = 0;
  if (may_try_old_factor()) {
    LinearReport report = solve_by_old_factor(b, x, tolerance);
    if (report.converged) return report;
    spent = report.iterations;
  }
  LinearReport report;
  if (!current_) {
    report.reason = factor();
    report.factored = true;
    if (!report.reason.empty()) return report;
  }
  const bool factored = report.factored;
  report = solve_by_factor(b, x, tolerance);
  report.factored = factored;
  report.iterations = spent;
  return report;
}

LinearReport MumpsSolver::solve_by_old_factor(const Vector& b, Vector& x, const LinearTolerance& tolerance) {
  const KrylovResult krylov = gmres_->solve(matrix_, factor_, b, x, tolerance, reuse_iterations_);
  if (krylov.converged)
    wait_ = 0;
  else if (!helped_)
    wait_ = std::min(2 * wait_ + 1, longest_wait);
  helped_ = krylov.converged;
  skip_ = krylov.converged ? 0 : wait_;
  LinearReport report;
  report.converged = krylov.converged;
  report.iterations = krylov.iterations;
  report.relative_residual = krylov.relative_residual;
  return report;
}

LinearReport MumpsSolver::solve_by_factor(const Vector& b, Vector& x, const LinearTolerance& tolerance) {
  Vector residual(dofs_->owned()), correction(dofs_->owned());
  LinearReport report;
  factor_->apply(b, x);
  report.relative_residual = (*evaluate_)(*matrix_, b, x, residual).relative();
  for (int step = 0; step < 2; ++step) {
    if (!(report.relative_residual > tolerance.relative)) break;
    factor_->apply(residual, correction);
    x.update(1, correction, 1);
    report.relative_residual = (*evaluate_)(*matrix_, b, x, residual).relative();
  }
  report.converged = report.relative_residual <= tolerance.relative;
  if (!report.converged)
    report.reason = std::isfinite(report.relative_residual)
                        ? "the direct solution is inaccurate (relative residual " +
                              number_text(report.relative_residual) + "): the matrix is singular or nearly so"
                        : "the matrix or the right-hand side is not finite, or the matrix is singular";
  return report;
}

}  // namespace mudline
