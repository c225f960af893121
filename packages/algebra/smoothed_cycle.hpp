#pragma once

#include "algebra/types.hpp"

namespace mudline {

/// A correction from a smaller space, or from another approximate inverse on the same space, between two smoothings.
class SmoothedCycle : public Operator {
 public:
  /// `prolongator`: from the space of `inner` to that of `matrix`; null: they are the same.
  SmoothedCycle(RCP<const Operator> matrix, RCP<const Operator> smoother, RCP<const Operator> inner,
                RCP<const CrsMatrix> prolongator);

  RCP<const Map> getDomainMap() const override { return matrix_->getDomainMap(); }
  RCP<const Map> getRangeMap() const override { return matrix_->getDomainMap(); }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp = Teuchos::NO_TRANS, double = 1,
             double = 0) const override;

 private:
  /// residual_ = x - A y
  void find_residual(const MultiVector& x, const MultiVector& y) const;

  RCP<const CrsMatrix> prolongator_;
  RCP<const Operator> matrix_, smoother_, inner_;
  mutable MultiVector residual_, correction_, inner_residual_, inner_correction_;
};

}  // namespace mudline
