#pragma once

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace mudline {

/// Disjoint sets (union-find) of the numbers 0, 1, ... The leader of a set is its lowest number.
class DisjointSets {
 public:
  /// `count` numbers, each in a set of its own.
  explicit DisjointSets(std::size_t count) : leader_(count) { std::iota(leader_.begin(), leader_.end(), 0); }
  int leader(int number) {
    while (leader_[number] != number) number = leader_[number] = leader_[leader_[number]];
    return number;
  }
  void join(int a, int b) {
    const auto [low, high] = std::minmax({leader(a), leader(b)});
    leader_[high] = low;
  }
  /// The leader of every number.
  const std::vector<int>& leaders() {
    for (std::size_t number = 0; number < leader_.size(); ++number) leader_[number] = leader(static_cast<int>(number));
    return leader_;
  }

 private:
  std::vector<int> leader_;
};

}  // namespace mudline
