#include "algebra/smoothed_cycle.hpp"

namespace mudline {

SmoothedCycle::SmoothedCycle(RCP<const Operator> matrix, RCP<const Operator> smoother, RCP<const Operator> inner,
                             RCP<const CrsMatrix> prolongator)
    : prolongator_(prolongator),
      matrix_(matrix),
      smoother_(smoother),
      inner_(inner),
      residual_(matrix->getDomainMap(), 1),
      correction_(matrix->getDomainMap(), 1) {
  if (prolongator_.is_null()) return;
  inner_residual_ = MultiVector(prolongator_->getDomainMap(), 1);
  inner_correction_ = MultiVector(prolongator_->getDomainMap(), 1);
}

void SmoothedCycle::find_residual(const MultiVector& x, const MultiVector& y) const {
  residual_.update(1, x, 0);
  matrix_->apply(y, residual_, Teuchos::NO_TRANS, -1, 1);
}

void SmoothedCycle::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double, double) const {
  smoother_->apply(x, y);
  find_residual(x, y);
  if (prolongator_.is_null()) {
    inner_->apply(residual_, correction_);
    y.update(1, correction_, 1);
  } else {
    prolongator_->apply(residual_, inner_residual_, Teuchos::TRANS);
    inner_->apply(inner_residual_, inner_correction_);
    prolongator_->apply(inner_correction_, y, Teuchos::NO_TRANS, 1, 1);
  }
  find_residual(x, y);
  smoother_->apply(residual_, correction_);
  y.update(1, correction_, 1);
}

}  // namespace mudline
