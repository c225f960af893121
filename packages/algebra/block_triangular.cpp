#include "algebra/block_triangular.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <limits>

#include "algebra/p_multigrid.hpp"
#include "algebra/schur.hpp"

namespace mudline {

namespace {

/// The inverse square of the domain's extent [1/m2].
double smallest_wave_number(const BlockData& data, const Comm& comm) {
  constexpr double huge = std::numeric_limits<double>::max();
  double here[4] = {-huge, -huge, -huge, -huge}, extent[4];  // x, y, -x, -y
  for (std::size_t i = 0; i + 1 < data.coordinates.size(); i += 2)
    for (int c = 0; c < 2; ++c) {
      here[c] = std::max(here[c], data.coordinates[i + c]);
      here[2 + c] = std::max(here[2 + c], -data.coordinates[i + c]);
    }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 4, here, extent);
  const double width = std::max(extent[0] + extent[2], extent[1] + extent[3]);
  return 1 / (width * width);
}

}  // namespace

BlockTriangular::BlockTriangular(const CrsMatrix& matrix, const DofMap& dofs, FieldBlocks& blocks,
                                 const BlockData& data)
    : map_(dofs.owned()), blocks_(blocks), displacement_(data.displacement), pressure_(data.pressure) {
  const RCP<CrsMatrix> block = blocks.block(matrix, displacement_, displacement_);
  displacement_inverse_ =
      rcp(new PMultigrid(block, dofs.field(displacement_), data, blocks.isolated(matrix, displacement_)));
  if (pressure_ < 0) return;
  right_ = rcp(new MultiVector(blocks.map(displacement_), 1));
  coupling_ = blocks.block(matrix, displacement_, pressure_);
  const double x_min = smallest_wave_number(data, *map_->getComm());
  schur_inverse_ =
      rcp(new SchurInverse(schur_coefficients(data, x_min), blocks.block(matrix, pressure_, pressure_),
                           blocks.renumbered(*data.pressure_mass, pressure_),
                           blocks.renumbered(*data.pressure_laplacian, pressure_), data.pressure_constrained));
}

void BlockTriangular::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double, double) const {
  const RCP<const MultiVector> force = blocks_.part(x, displacement_);
  const RCP<MultiVector> displacement = blocks_.part(y, displacement_);
  if (pressure_ < 0) {
    displacement_inverse_->apply(*force, *displacement);
    return;
  }
  const RCP<MultiVector> pressure = blocks_.part(y, pressure_);
  schur_inverse_->apply(*blocks_.part(x, pressure_), *pressure);
  right_->update(1, *force, 0);
  coupling_->apply(*pressure, *right_, Teuchos::NO_TRANS, -1, 1);
  displacement_inverse_->apply(*right_, *displacement);
}

}  // namespace mudline
