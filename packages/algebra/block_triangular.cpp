#include "algebra/block_triangular.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <limits>

#include "algebra/amg.hpp"
#include "algebra/p_multigrid.hpp"
#include "algebra/schur.hpp"

namespace mudline {

namespace {

/// The smallest squared wave number of the domain: the inverse square of its extent [1/m2].
double smallest_wave_number(const BlockData& data, int dimension, const Comm& comm) {
  double here[6], extent[6];  // largest coordinates, then the largest negated ones
  std::fill_n(here, 6, -std::numeric_limits<double>::max());
  for (std::size_t i = 0; i < data.coordinates.size(); i += dimension)
    for (int c = 0; c < dimension; ++c) {
      here[c] = std::max(here[c], data.coordinates[i + c]);
      here[3 + c] = std::max(here[3 + c], -data.coordinates[i + c]);
    }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 6, here, extent);
  double width = 0;
  for (int c = 0; c < dimension; ++c) width = std::max(width, extent[c] + extent[3 + c]);
  return 1 / (width * width);
}

}  // namespace

BlockTriangular::BlockTriangular(const CrsMatrix& matrix, const DofMap& dofs, const FieldBlocks& blocks,
                                 const BlockData& data)
    : map_(dofs.owned()), blocks_(blocks) {
  const int u = data.displacement, p = data.pressure;
  for (int f = 0; f < dofs.num_fields(); ++f) {
    if (f == u || f == p || dofs.field(f).apart) continue;
    AmgInput input;
    input.matrix = blocks.block(matrix, f, f);
    isolate(*input.matrix, blocks.isolated(matrix, f));
    add_level(matrix, f, amg_cycle(input));
  }
  if (p >= 0) {
    const double x_min = smallest_wave_number(data, dofs.field(u).components, *map_->getComm());
    add_level(matrix, p,
              rcp(new SchurInverse(schur_coefficients(data, x_min), blocks.block(matrix, p, p),
                                   blocks.renumbered(*data.pressure_mass, p),
                                   blocks.renumbered(*data.pressure_laplacian, p), data.pressure_constrained)));
  }
  if (u >= 0) add_level(matrix, u, rcp(new PMultigrid(matrix, blocks, u, dofs.field(u), data)));
}

void BlockTriangular::add_level(const CrsMatrix& matrix, int field, RCP<Operator> inverse) {
  Level level{field, std::move(inverse), {}, rcp(new MultiVector(blocks_.map(field), 1))};
  for (const Level& before : levels_)
    level.known.emplace_back(before.field, blocks_.node_block(matrix, field, before.field));
  levels_.push_back(level);
}

void BlockTriangular::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double, double) const {
  for (const Level& level : levels_) {
    level.right->update(1, *blocks_.part(x, level.field), 0);
    for (const auto& [field, coupling] : level.known)
      coupling->apply(*blocks_.part(y, field), *level.right, Teuchos::NO_TRANS, -1, 1);
    level.inverse->apply(*level.right, *blocks_.part(y, level.field));
  }
}

}  // namespace mudline
