#pragma once

#include <vector>

#include "algebra/field_blocks.hpp"
#include "algebra/linear_solver.hpp"

namespace mudline {

/// Approximate inverse of the displacement block: smoothing on the given (quadratic) space around a cycle on the linear
/// one, whose functions are the vertex values with every other node at the mean of its parents. Lowering the degree
/// first leaves multigrid a smaller, sparser problem of the kind it is made for. Algebraic multigrid then solves on the
/// linear space, in three dimensions between two more smoothings, because its own smoother sees single unknowns only.
class PMultigrid : public Operator {
 public:
  /// Takes the diagonal block of the displacement, field f, from `matrix`, whose values may change afterwards.
  PMultigrid(const CrsMatrix& matrix, const FieldBlocks& blocks, int f, const FieldLayout& field,
             const BlockData& data);

  RCP<const Map> getDomainMap() const override { return map_; }
  RCP<const Map> getRangeMap() const override { return map_; }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp = Teuchos::NO_TRANS, double = 1,
             double = 0) const override;

 private:
  RCP<const Map> map_;
  RCP<Operator> cycle_;
};

}  // namespace mudline
