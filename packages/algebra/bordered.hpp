#pragma once

#include <vector>

#include "algebra/dense_factor.hpp"
#include "algebra/field_blocks.hpp"

namespace mudline {

/// Completes the approximate inverse P of a matrix's inner fields by its few unknowns apart from the mesh (motions of
/// bodies). With the columns A_ib and rows A_bi of those, W = P A_ib and S = A_bb - A_bi W,
///     y_b = S^-1 (r_b - A_bi P r_i),   y_i = P r_i - W y_b.
/// S is dense and small, the same on every rank.
class Bordered : public Operator {
 public:
  /// `inner`: P on the map of the whole matrix, reads and writes the inner fields only. `apart`: the other fields.
  Bordered(const CrsMatrix& matrix, const DofMap& dofs, const FieldBlocks& blocks, RCP<Operator> inner,
           const std::vector<int>& apart);

  RCP<const Map> getDomainMap() const override { return map_; }
  RCP<const Map> getRangeMap() const override { return map_; }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp = Teuchos::NO_TRANS, double = 1,
             double = 0) const override;

 private:
  /// Values of v at the unknowns apart from the mesh, on every rank.
  std::vector<double> gathered(const MultiVector& v) const;
  /// The product A_bi v_i, on every rank.
  std::vector<double> rows_times(const MultiVector& v) const;

  RCP<const Map> map_;
  const FieldBlocks& blocks_;
  std::vector<int> inner_fields_, apart_, sizes_;
  RCP<Operator> inner_;
  std::vector<RCP<CrsMatrix>> rows_;  // (apart field, inner field)
  int count_ = 0;
  DenseFactor factor_;        // of S
  RCP<MultiVector> columns_;  // W
};

}  // namespace mudline
