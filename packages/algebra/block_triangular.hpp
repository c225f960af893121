#pragma once

#include <memory>

#include "algebra/field_blocks.hpp"
#include "algebra/linear_solver.hpp"

namespace mudline {

/// Approximate inverse of the Jacobian by its upper block triangle, from the last field to the first: one cycle of
/// multigrid for each scalar field s beside the pore pressure, s = D^-1 r_s; the pressure by its Schur complement,
/// p = Shat^-1 (r_p - A_ps s); the displacement, u = F^-1 (r_u - A_up p - A_us s). Fields that there are not are left
/// out. Unknowns apart from the mesh are none of its: see Bordered.
class BlockTriangular : public Operator {
 public:
  /// Cuts its own copies out of `matrix`, so that it outlives later values. `blocks` must outlive this.
  BlockTriangular(const CrsMatrix& matrix, const DofMap& dofs, const FieldBlocks& blocks, const BlockData& data);

  RCP<const Map> getDomainMap() const override { return map_; }
  RCP<const Map> getRangeMap() const override { return map_; }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp = Teuchos::NO_TRANS, double = 1,
             double = 0) const override;

 private:
  /// One field on the way up: what is known is taken off its right-hand side, then its block is inverted.
  struct Level {
    int field;
    RCP<Operator> inverse;
    std::vector<std::pair<int, RCP<NodeMatrix>>> known;  // fields before it and their coupling
    RCP<MultiVector> right;
  };
  void add_level(const CrsMatrix& matrix, int field, RCP<Operator> inverse);

  RCP<const Map> map_;
  const FieldBlocks& blocks_;
  std::vector<Level> levels_;
};

}  // namespace mudline
