#include "algebra/joined_nodes.hpp"

#include <Teuchos_DefaultSerialComm.hpp>

#include "algebra/tpetra_compat.hpp"

namespace mudline {

namespace {

/// The block of the joined nodes as a matrix of this rank alone.
RCP<CrsMatrix> extract(const NodeMatrix& matrix, const std::vector<int>& nodes) {
  const int n = matrix.components();
  std::vector<int> place(matrix.nodes(), -1);
  for (std::size_t k = 0; k < nodes.size(); ++k) place[nodes[k]] = static_cast<int>(k);
  const auto place_of = [&](int column) { return column < matrix.nodes() ? place[column] : -1; };
  std::vector<std::size_t> counts;
  for (const int node : nodes) {
    std::size_t blocks = 0;
    matrix.for_each_block(node, [&](int column, const float*) { blocks += place_of(column) >= 0; });
    counts.insert(counts.end(), n, n * blocks);
  }
  const RCP<const Map> map = make_dense_map(n * nodes.size(), rcp(new Teuchos::SerialComm<int>));
  const auto block = rcp(new CrsMatrix(map, Teuchos::arrayViewFromVector(counts)));
  for (std::size_t k = 0; k < nodes.size(); ++k)
    matrix.for_each_block(nodes[k], [&](int column, const float* values) {
      if (place_of(column) < 0) return;
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const double value = values[n * i + j];
          const GlobalOrdinal to = n * static_cast<GlobalOrdinal>(place_of(column)) + j;
          block->insertGlobalValues(static_cast<GlobalOrdinal>(n * k) + i, 1, &value, &to);
        }
    });
  block->fillComplete();
  return block;
}

}  // namespace

JoinedNodes::JoinedNodes(const NodeMatrix& matrix, const std::vector<char>& joined) : components_(matrix.components()) {
  for (std::size_t node = 0; node < joined.size(); ++node)
    if (joined[node]) nodes_.push_back(static_cast<int>(node));
  if (nodes_.empty()) return;
  const RCP<CrsMatrix> block = extract(matrix, nodes_);
  std::vector<GlobalOrdinal> node_of_row;
  for (std::size_t row = 0; row < components_ * nodes_.size(); ++row)
    node_of_row.push_back(static_cast<GlobalOrdinal>(row / components_));
  factor_ = std::make_unique<MumpsFactor>(*block, true, node_of_row);
  if (factor_->analysis().empty() && factor_->factor(*block).empty()) {
    right_ = rcp(new MultiVector(block->getRowMap(), 1));
    solution_ = rcp(new MultiVector(block->getRowMap(), 1));
  } else {
    nodes_.clear();
    factor_.reset();
  }
}

const MultiVector& JoinedNodes::solve(const MultiVector& x) const {
  {
    const auto from = x.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto to = right_->getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t k = 0; k < nodes_.size(); ++k)
      for (int i = 0; i < components_; ++i) to(components_ * k + i, 0) = from(components_ * nodes_[k] + i, 0);
  }
  factor_->solve(*right_, *solution_);
  return *solution_;
}

}  // namespace mudline
