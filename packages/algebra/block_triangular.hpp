#pragma once

#include <memory>

#include "algebra/field_blocks.hpp"
#include "algebra/linear_solver.hpp"

namespace mudline {

/// Approximate inverse of the Jacobian by its upper block triangle, from the last field to the first: one cycle of
/// multigrid for each scalar field s beside the pore pressure, s = D^-1 r_s; the pressure by its Schur complement, p =
/// Shat^-1 (r_p - A_ps s); the displacement, u = F^-1 (r_u - A_up p - A_us s). Absent fields are left out. Unknowns
/// apart from the mesh are left to Bordered.
class BlockTriangular : public Operator {
 public:
  /// Copies the blocks out of `matrix`, so that later values of `matrix` do not affect it. `blocks` must outlive this.
  BlockTriangular(const CrsMatrix& matrix, const DofMap& dofs, const FieldBlocks& blocks, const BlockData& data);

  RCP<const Map> getDomainMap() const override { return map_; }
  RCP<const Map> getRangeMap() const override { return map_; }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp = Teuchos::NO_TRANS, double = 1,
             double = 0) const override;

 private:
  /// One step of the back substitution: the known fields are subtracted from the right-hand side of `field`, then its
  /// block is inverted.
  struct Level {
    int field;
    RCP<Operator> inverse;
    std::vector<std::pair<int, RCP<NodeMatrix>>> known;  // fields solved before it, and their coupling blocks
    RCP<MultiVector> right;
  };
  void add_level(const CrsMatrix& matrix, int field, RCP<Operator> inverse);

  RCP<const Map> map_;
  const FieldBlocks& blocks_;
  std::vector<Level> levels_;
};

}  // namespace mudline
