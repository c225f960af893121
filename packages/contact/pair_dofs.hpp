#pragma once

#include <unordered_map>
#include <vector>

#include "framework/term.hpp"

namespace mudline {

/// Dofs of the sides of a slave with the pieces of a target that they may meet. All of them have their matrix entries
/// from the start: the graph, and with it the order of all sums, never changes.
class PairDofs {
 public:
  void add(std::size_t side, int piece, std::vector<int> dofs);
  /// Registers the pairs as a group of the assembler.
  void sparsity(Assembler& assembler);

  /// Row of a pair in dofs(); -1: they never meet.
  int row(std::size_t side, int piece) const;
  /// (row, dof). Rows of pairs with fewer dofs repeat the first, where nothing may be added.
  const ElementDofs& dofs() const { return dofs_; }
  int group() const { return group_; }

 private:
  static long long key(std::size_t side, int piece) { return static_cast<long long>(side) << 32 | piece; }
  std::unordered_map<long long, int> rows_;
  std::vector<std::vector<int>> pairs_;
  ElementDofs dofs_;
  int group_ = -1;
};

}  // namespace mudline
