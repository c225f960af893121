#include "algebra/block_amg_solver.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "algebra/block_triangular.hpp"
#include "algebra/bordered.hpp"
#include "algebra/krylov.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

/// Added to the growth limit, so that a handful of iterations does not trigger a rebuild.
constexpr int rebuild_slack = 5;

}  // namespace

BlockAmgSolver::BlockAmgSolver() = default;
BlockAmgSolver::~BlockAmgSolver() = default;

void BlockAmgSolver::parameters(Parameters& p) {
  p.add("maximum iterations", maximum_iterations_, "-", closed(1, 100000),
        "GMRES iterations after which a solve fails");
  p.add(
      "rebuild growth", rebuild_growth_, "-", closed(1, 100),
      "The preconditioner is rebuilt when the iterations exceed this factor of those of its first solve, for the same "
      "fall of the residual, plus 5");
}

std::string BlockAmgSolver::prepare(RCP<const DofMap> dofs) {
  reset();
  dofs_ = std::move(dofs);
  gmres_ = std::make_unique<FieldGmres>(dofs_);
  for (int f = 0; f < dofs_->num_fields(); ++f) {
    const FieldLayout& field = dofs_->field(f);
    const bool moves = field.name == "displacement" && (field.components == 2 || field.components == 3);
    if (field.apart || field.components == 1 || moves) continue;
    return "linear solver 'block amg' treats a displacement of two or three components and scalar fields, not '" +
           field.name + "'; use 'direct'";
  }
  return "";
}

void BlockAmgSolver::set_matrix(RCP<const CrsMatrix> matrix, const std::function<BlockData()>& block_data) {
  matrix_ = std::move(matrix);
  block_data_ = block_data;
}

void BlockAmgSolver::reset() {
  preconditioner_ = Teuchos::null;
  blocks_.reset();
  fresh_rate_ = -1;
  stale_ = false;
}

void BlockAmgSolver::build() {
  preconditioner_ = Teuchos::null;
  if (!blocks_ || !blocks_->fits(*matrix_)) blocks_ = std::make_unique<FieldBlocks>(*matrix_, dofs_);
  preconditioner_ = rcp(new BlockTriangular(*matrix_, *dofs_, *blocks_, block_data_()));
  std::vector<int> apart;
  for (int f = 0; f < dofs_->num_fields(); ++f)
    if (dofs_->field(f).apart) apart.push_back(f);
  if (!apart.empty()) preconditioner_ = rcp(new Bordered(*matrix_, *dofs_, *blocks_, preconditioner_, apart));
  fresh_rate_ = -1;
  stale_ = false;
}

int BlockAmgSolver::most_iterations(double decades) const {
  return static_cast<int>(rebuild_growth_ * fresh_rate_ * decades) + rebuild_slack;
}

LinearReport BlockAmgSolver::solve(const Vector& b, Vector& x, const LinearTolerance& tolerance) {
  if (matrix_.is_null()) throw std::logic_error("block amg solver used before it has a matrix");
  LinearReport report;
  KrylovResult krylov;
  // The old preconditioner is tried only where the matrix still has the graph that the blocks were built for.
  const bool old = !preconditioner_.is_null() && !stale_ && blocks_->fits(*matrix_) && fresh_rate_ >= 0;
  if (old) {
    // The limit is twice that of a full solve: a solve that just exceeds its own limit is finished, and the rebuild
    // waits for the next matrix.
    const double most_decades = -std::log10(tolerance.relative);
    krylov = gmres_->solve(matrix_, preconditioner_, b, x, tolerance,
                           std::min(2 * most_iterations(most_decades), maximum_iterations_));
    stale_ = krylov.iterations > most_iterations(krylov.decades);
  }
  if (!krylov.converged) {
    const int spent = krylov.iterations;
    build();
    report.factored = true;
    krylov = gmres_->solve(matrix_, preconditioner_, b, x, tolerance, maximum_iterations_);
    fresh_rate_ = krylov.iterations / std::max(krylov.decades, 1.0);
    krylov.iterations += spent;
  }
  report.converged = krylov.converged;
  report.iterations = krylov.iterations;
  report.relative_residual = krylov.relative_residual;
  if (!krylov.converged) {
    stale_ = true;
    report.reason = std::isfinite(krylov.relative_residual)
                        ? "no convergence in " + std::to_string(maximum_iterations_) +
                              " iterations (relative residual " + number_text(krylov.relative_residual) + ")"
                        : "the matrix or the right-hand side is not finite, or the matrix is singular";
  }
  return report;
}

}  // namespace mudline
