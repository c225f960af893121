#include "algebra/bordered.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include "algebra/tpetra_compat.hpp"

namespace mudline {

Bordered::Bordered(const CrsMatrix& matrix, const DofMap& dofs, const FieldBlocks& blocks, RCP<Operator> inner,
                   const std::vector<int>& apart)
    : map_(dofs.owned()), blocks_(blocks), apart_(apart), inner_(std::move(inner)) {
  for (int f = 0; f < dofs.num_fields(); ++f)
    if (std::find(apart_.begin(), apart_.end(), f) == apart_.end()) inner_fields_.push_back(f);
  for (int b : apart_) {
    sizes_.push_back(static_cast<int>(blocks_.map(b)->getGlobalNumElements()));
    count_ += sizes_.back();
    for (int f : inner_fields_) rows_.push_back(blocks_.block(matrix, b, f));
  }
  columns_ = rcp(new MultiVector(map_, count_));
  std::vector<double> bordered(count_ * count_, 0.0);  // S
  int column = 0;
  for (std::size_t k = 0; k < apart_.size(); ++k)
    for (int j = 0; j < sizes_[k]; ++j, ++column) {
      MultiVector unit(map_, 1), product(map_, 1);
      const RCP<MultiVector> own = blocks_.part(unit, apart_[k]);
      if (own->getMap()->isNodeGlobalElement(j)) own->replaceGlobalValue(j, 0, 1.0);
      matrix.apply(unit, product);
      const std::vector<double> diagonal = gathered(product);
      MultiVector w(map_, 1);
      inner_->apply(product, w);
      const std::vector<double> through = rows_times(w);
      for (int i = 0; i < count_; ++i) bordered[column * count_ + i] = diagonal[i] - through[i];
      columns_->getVectorNonConst(column)->update(1, *w.getVector(0), 0);
    }
  // A body without forces yet has an empty row. A unit diagonal keeps it where it is.
  for (int i = 0; i < count_; ++i) {
    double largest = 0;
    for (int j = 0; j < count_; ++j) largest = std::max(largest, std::abs(bordered[j * count_ + i]));
    if (!(largest > 0)) bordered[i * count_ + i] = 1;
  }
  factor_ = DenseFactor(std::move(bordered), count_);
}

std::vector<double> Bordered::gathered(const MultiVector& v) const {
  std::vector<double> here(count_, 0.0), all(count_);
  int first = 0;
  for (std::size_t k = 0; k < apart_.size(); ++k) {
    const RCP<const MultiVector> part = blocks_.part(v, apart_[k]);
    const auto values = part->getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t i = 0; i < values.extent(0); ++i)
      here[first + part->getMap()->getGlobalElement(static_cast<LocalOrdinal>(i))] = values(i, 0);
    first += sizes_[k];
  }
  Teuchos::reduceAll(*map_->getComm(), Teuchos::REDUCE_SUM, count_, here.data(), all.data());
  return all;
}

std::vector<double> Bordered::rows_times(const MultiVector& v) const {
  MultiVector sum(map_, 1);
  std::size_t next = 0;
  for (int b : apart_) {
    const RCP<MultiVector> part = blocks_.part(sum, b);
    for (int f : inner_fields_) rows_[next++]->apply(*blocks_.part(v, f), *part, Teuchos::NO_TRANS, 1, 1);
  }
  return gathered(sum);
}

void Bordered::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double, double) const {
  inner_->apply(x, y);
  std::vector<double> right = gathered(x);
  const std::vector<double> through = rows_times(y);
  for (int i = 0; i < count_; ++i) right[i] -= through[i];
  if (factor_.regular()) factor_.solve(right);
  for (int j = 0; j < count_; ++j) y.getVectorNonConst(0)->update(-right[j], *columns_->getVector(j), 1);
  int first = 0;
  for (std::size_t k = 0; k < apart_.size(); ++k) {
    const RCP<MultiVector> part = blocks_.part(y, apart_[k]);
    const auto values = part->getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < values.extent(0); ++i)
      values(i, 0) = right[first + part->getMap()->getGlobalElement(static_cast<LocalOrdinal>(i))];
    first += sizes_[k];
  }
}

}  // namespace mudline
