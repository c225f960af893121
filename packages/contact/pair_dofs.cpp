#include "contact/pair_dofs.hpp"

#include <algorithm>

namespace mudline {

void PairDofs::add(std::size_t side, int piece, std::vector<int> dofs) {
  rows_[key(side, piece)] = static_cast<int>(pairs_.size());
  pairs_.push_back(std::move(dofs));
}

void PairDofs::sparsity(Assembler& assembler) {
  std::size_t most = 0;
  for (const std::vector<int>& pair : pairs_) most = std::max(most, pair.size());
  Kokkos::View<int**, Kokkos::LayoutRight> table("contact dofs", pairs_.size(), most);
  for (std::size_t p = 0; p < pairs_.size(); ++p) {
    pairs_[p].resize(most, pairs_[p].front());
    std::copy(pairs_[p].begin(), pairs_[p].end(), &table(p, 0));
  }
  pairs_.clear();
  dofs_ = table;
  group_ = assembler.add_group(dofs_);
}

int PairDofs::row(std::size_t side, int piece) const {
  const auto found = rows_.find(key(side, piece));
  return found == rows_.end() ? -1 : found->second;
}

}  // namespace mudline
