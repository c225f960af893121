#include "algebra/krylov.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "algebra/gmres.hpp"

namespace mudline {

namespace {

/// D A, with the diagonal D that makes the fields comparable.
class ScaledMatrix : public Operator {
 public:
  ScaledMatrix(RCP<const CrsMatrix> matrix, RCP<const Vector> scale) : matrix_(matrix), scale_(scale) {}
  RCP<const Map> getDomainMap() const override { return matrix_->getDomainMap(); }
  RCP<const Map> getRangeMap() const override { return matrix_->getRangeMap(); }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp mode, double alpha, double beta) const override {
    if (mode != Teuchos::NO_TRANS || alpha != 1 || beta != 0) throw std::logic_error("a scaled matrix applies plainly");
    matrix_->apply(x, y);
    y.elementWiseMultiply(1, *scale_, y, 0);
  }

 private:
  RCP<const CrsMatrix> matrix_;
  RCP<const Vector> scale_;
};

/// P D^-1, the preconditioner of D A.
class ScaledPreconditioner : public Operator {
 public:
  ScaledPreconditioner(RCP<const Operator> preconditioner, const Vector& scale)
      : preconditioner_(preconditioner), inverse_scale_(scale.getMap()), unscaled_(scale.getMap()) {
    inverse_scale_.reciprocal(scale);
  }
  RCP<const Map> getDomainMap() const override { return preconditioner_->getDomainMap(); }
  RCP<const Map> getRangeMap() const override { return preconditioner_->getRangeMap(); }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double, double) const override {
    unscaled_.elementWiseMultiply(1, inverse_scale_, *x.getVector(0), 0);
    preconditioner_->apply(unscaled_, y);
  }

 private:
  RCP<const Operator> preconditioner_;
  Vector inverse_scale_;
  mutable Vector unscaled_;
};

}  // namespace

FieldGmres::FieldGmres(RCP<const DofMap> dofs) : dofs_(dofs), evaluate_(dofs) {}

RCP<Vector> FieldGmres::row_scale(const FieldResidual& residual) const {
  const auto scale = rcp(new Vector(dofs_->owned()));
  const auto values = scale->getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (int f = 0; f < dofs_->num_fields(); ++f) {
    const double reference = residual.reference[f] > 0 ? residual.reference[f] : 1;
    for (int i = dofs_->owned_begin(f); i < dofs_->owned_end(f); ++i) values(i, 0) = 1 / reference;
  }
  return scale;
}

KrylovResult FieldGmres::solve(const RCP<const CrsMatrix>& matrix, const RCP<const Operator>& preconditioner,
                               const Vector& b, Vector& x, const LinearTolerance& tolerance, int max_iterations) {
  KrylovResult result;
  Vector residual(dofs_->owned());
  FieldResidual state;
  const auto evaluate = [&] {
    state = evaluate_(*matrix, b, x, residual);
    state.loosen(tolerance);
    result.relative_residual = state.relative();
    result.converged = result.relative_residual <= tolerance.relative;
    return !result.converged && std::isfinite(result.relative_residual);
  };
  // A first guess only tells how large the terms are; it is not kept, GMRES finds it again in its first step.
  preconditioner->apply(b, x);
  if (!evaluate()) return result;
  x.putScalar(0);
  residual.assign(b);

  // The references follow x, so a second round may be needed when the first guess misjudged them.
  for (int round = 0; round < 4; ++round) {
    if (result.iterations >= max_iterations) break;
    const RCP<Vector> scale = row_scale(state);
    Vector correction(dofs_->owned()), right(dofs_->owned());
    right.elementWiseMultiply(1, *scale, residual, 0);
    const double target = 0.9 * tolerance.relative;  // margin for the drift of the implicit residual
    if (round == 0) result.decades = std::max(0.0, std::log10(right.norm2() / target));
    result.iterations += gmres(ScaledMatrix(matrix, scale), ScaledPreconditioner(preconditioner, *scale), right,
                               correction, target, max_iterations - result.iterations);
    x.update(1, correction, 1);
    if (!evaluate()) return result;
  }
  return result;
}

}  // namespace mudline
