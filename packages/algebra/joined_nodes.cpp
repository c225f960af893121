#include "algebra/joined_nodes.hpp"

#include <Teuchos_DefaultSerialComm.hpp>

#include <algorithm>
#include <utility>

#include "algebra/tpetra_compat.hpp"

namespace mudline {

namespace {

constexpr int largest_dense = 450;  // rows

/// Calls action(row, column, value) for the entries of the block of the nodes, row by row.
template <class Action>
void for_each_entry(const NodeMatrix& matrix, const std::vector<int>& nodes, Action&& action) {
  const int n = matrix.components();
  std::vector<int> place(matrix.nodes(), -1);
  for (std::size_t k = 0; k < nodes.size(); ++k) place[nodes[k]] = static_cast<int>(k);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (int i = 0; i < n; ++i)
      matrix.for_each_block(nodes[k], [&](int column, const float* values) {
        if (column >= matrix.nodes() || place[column] < 0) return;
        for (int j = 0; j < n; ++j) action(n * static_cast<int>(k) + i, n * place[column] + j, values[n * i + j]);
      });
}

/// The block of the joined nodes as a matrix of this rank alone.
RCP<CrsMatrix> extract(const NodeMatrix& matrix, const std::vector<int>& nodes) {
  std::vector<std::size_t> counts(matrix.components() * nodes.size(), 0);
  for_each_entry(matrix, nodes, [&](int row, int, double) { ++counts[row]; });
  const RCP<const Map> map = make_dense_map(counts.size(), rcp(new Teuchos::SerialComm<int>));
  const auto block = rcp(new CrsMatrix(map, Teuchos::arrayViewFromVector(counts)));
  for_each_entry(matrix, nodes, [&](int row, int column, double value) {
    const GlobalOrdinal to = column;
    block->insertGlobalValues(row, 1, &value, &to);
  });
  block->fillComplete();
  return block;
}

}  // namespace

JoinedNodes::JoinedNodes(const NodeMatrix& matrix, const std::vector<char>& joined) : components_(matrix.components()) {
  for (std::size_t node = 0; node < joined.size(); ++node)
    if (joined[node]) nodes_.push_back(static_cast<int>(node));
  if (nodes_.empty()) return;
  solution_.resize(components_ * nodes_.size());
  const bool small = static_cast<int>(solution_.size()) <= largest_dense;
  if (!(small ? factor_dense(matrix) : factor_sparse(matrix))) nodes_.clear();
}

bool JoinedNodes::factor_dense(const NodeMatrix& matrix) {
  const int rows = static_cast<int>(solution_.size());
  std::vector<double> block(static_cast<std::size_t>(rows) * rows, 0);
  for_each_entry(matrix, nodes_, [&](int row, int column, double value) {
    block[static_cast<std::size_t>(rows) * column + row] = value;
  });
  dense_ = DenseFactor(std::move(block), rows);
  return dense_.regular();
}

bool JoinedNodes::factor_sparse(const NodeMatrix& matrix) {
  const RCP<CrsMatrix> block = extract(matrix, nodes_);
  std::vector<GlobalOrdinal> node_of_row;
  for (std::size_t row = 0; row < solution_.size(); ++row)
    node_of_row.push_back(static_cast<GlobalOrdinal>(row / components_));
  sparse_ = std::make_unique<MumpsFactor>(*block, true, node_of_row);
  if (!sparse_->analysis().empty() || !sparse_->factor(*block).empty()) return false;
  right_ = rcp(new MultiVector(block->getRowMap(), 1));
  left_ = rcp(new MultiVector(block->getRowMap(), 1));
  return true;
}

const std::vector<double>& JoinedNodes::solve(const MultiVector& x) const {
  {
    const auto from = x.getLocalViewHost(Tpetra::Access::ReadOnly);
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      for (int i = 0; i < components_; ++i) solution_[components_ * k + i] = from(components_ * nodes_[k] + i, 0);
  }
  if (!sparse_) {
    dense_.solve(solution_);
    return solution_;
  }
  std::copy(solution_.begin(), solution_.end(), right_->getLocalViewHost(Tpetra::Access::OverwriteAll).data());
  sparse_->solve(*right_, *left_);
  std::copy_n(left_->getLocalViewHost(Tpetra::Access::ReadOnly).data(), solution_.size(), solution_.begin());
  return solution_;
}

}  // namespace mudline
