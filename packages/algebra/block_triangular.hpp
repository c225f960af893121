#pragma once

#include <memory>

#include "algebra/field_blocks.hpp"
#include "algebra/linear_solver.hpp"

namespace mudline {

/// Approximate inverse of the Jacobian [[F, B], [., C]] by its upper triangle with the pressure Schur complement:
/// p = Shat^-1 r_p, then u = F^-1 (r_u - B p). Without a pressure field only F^-1.
class BlockTriangular : public Operator {
 public:
  /// Cuts its own copies out of `matrix`, so that it outlives later values. `blocks` must outlive this.
  BlockTriangular(const CrsMatrix& matrix, const DofMap& dofs, FieldBlocks& blocks, const BlockData& data);

  RCP<const Map> getDomainMap() const override { return map_; }
  RCP<const Map> getRangeMap() const override { return map_; }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp = Teuchos::NO_TRANS, double = 1,
             double = 0) const override;

 private:
  RCP<const Map> map_;
  FieldBlocks& blocks_;
  int displacement_, pressure_;
  RCP<Operator> displacement_inverse_, schur_inverse_;
  RCP<CrsMatrix> coupling_;
  mutable RCP<MultiVector> right_;
};

}  // namespace mudline
