#include "algebra/krylov.hpp"

#include <BelosBlockGmresIter.hpp>
#include <BelosICGSOrthoManager.hpp>
#include <BelosLinearProblem.hpp>
#include <BelosOutputManager.hpp>
#include <BelosStatusTest.hpp>
#include <BelosTpetraAdapter.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace mudline {

namespace {

constexpr int most_directions = 60;  // GMRES restarts after as many; all of them are a fifth of a large model's memory

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

/// Stops GMRES where its estimate of the residual's norm has fallen to a bound, or is no number. The rows are weighed
/// so that this norm bounds the residual of every field.
class FieldTest : public Belos::StatusTest<double, MultiVector, Operator> {
 public:
  explicit FieldTest(double bound) : bound_(bound) {}
  Belos::StatusType checkStatus(Belos::Iteration<double, MultiVector, Operator>* iteration) override {
    std::vector<double> estimate(1);
    iteration->getNativeResiduals(&estimate);
    return status_ = estimate[0] > bound_ ? Belos::Failed : Belos::Passed;
  }
  Belos::StatusType getStatus() const override { return status_; }
  void reset() override { status_ = Belos::Undefined; }
  void print(std::ostream& os, int /*indent*/) const override { printStatus(os, status_); }

 private:
  double bound_;
  Belos::StatusType status_ = Belos::Undefined;
};

/// GMRES on A P from x = 0, with at most `directions` search directions, until its estimate of ||b - A x|| is below
/// `bound`. Returns how many it took. Memory is touched only for these, because Belos leaves its basis uninitialised.
int gmres(const RCP<const Operator>& matrix, const RCP<const Operator>& preconditioner, const Vector& b, Vector& x,
          double bound, int directions) {
  x.putScalar(0);
  const double norm = b.norm2();
  if (!(norm > bound)) return 0;
  const auto problem =
      rcp(new Belos::LinearProblem<double, MultiVector, Operator>(matrix, rcpFromRef(x), rcpFromRef(b)));
  problem->setRightPrec(preconditioner);
  problem->setProblem();
  const auto start = rcp(new MultiVector(b, Teuchos::Copy));
  start->scale(1 / norm);
  const auto length = rcp(new Teuchos::SerialDenseMatrix<int, double>(1, 1));
  (*length)(0, 0) = norm;
  Belos::GmresIterationState<double, MultiVector> state;
  state.V = start;
  state.z = length;
  Teuchos::ParameterList list;
  list.set("Num Blocks", directions);
  Belos::BlockGmresIter<double, MultiVector, Operator> iteration(
      problem, rcp(new Belos::OutputManager<double>), rcp(new FieldTest(bound)),
      rcp(new Belos::ICGSOrthoManager<double, MultiVector, Operator>), list);
  iteration.initializeGmres(state);
  try {
    iteration.iterate();
  } catch (const Belos::GmresIterationOrthoFailure&) {  // the space is exhausted: the last direction lies within it
    iteration.updateLSQR(iteration.getCurSubspaceDim());
  }
  const RCP<const MultiVector> update = iteration.getCurrentUpdate();
  preconditioner->apply(*update, x);
  return iteration.getNumIters();
}

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
  Vector residual(dofs_->owned()), correction(dofs_->owned()), right(dofs_->owned());
  FieldResidual state;
  const auto evaluate = [&] {
    state = evaluate_(*matrix, b, x, residual);
    state.loosen(tolerance);
    result.relative_residual = state.relative();
    result.converged = result.relative_residual <= tolerance.relative;
    return !result.converged && std::isfinite(result.relative_residual);
  };
  // A first guess only shows how large the terms are. It is dropped, because GMRES finds it again in its first step.
  preconditioner->apply(b, x);
  if (!evaluate()) return result;
  x.putScalar(0);
  residual.assign(b);

  const double bound = 0.9 * tolerance.relative;  // margin for the drift of the estimate
  const auto unknowns = static_cast<long long>(dofs_->owned()->getGlobalNumElements());
  // The references depend on x, so GMRES starts again, from the x that it has found, where the first guess misjudged
  // them; also where all its directions are used.
  for (int misjudged = 0; misjudged < 4 && result.iterations < max_iterations;) {
    const RCP<Vector> scale = row_scale(state);
    right.elementWiseMultiply(1, *scale, residual, 0);
    if (result.iterations == 0) result.decades = std::max(0.0, std::log10(right.norm2() / bound));
    const auto directions =
        static_cast<int>(std::min<long long>(unknowns, std::min(most_directions, max_iterations - result.iterations)));
    const int taken = gmres(rcp(new ScaledMatrix(matrix, scale)), rcp(new ScaledPreconditioner(preconditioner, *scale)),
                            right, correction, bound, directions);
    result.iterations += taken;
    if (taken < directions) ++misjudged;
    x.update(1, correction, 1);
    if (!evaluate()) return result;
  }
  return result;
}

}  // namespace mudline
