#pragma once

#include <cstddef>
#include <vector>

#include "discretisation/mesh_topology.hpp"

namespace mudline {

/// Numbers sides or edges by their keys: 0, 1, ... in the order in which they are first met. A hash table with open
/// addressing, because one allocation per key takes several times as long for millions of keys.
class SideTable {
 public:
  /// `expected`: about how many different keys there will be.
  explicit SideTable(std::size_t expected) { resize(expected); }
  /// The number of a key, which is added where it is new.
  std::size_t number(const SideKey& key) {
    if (2 * (keys_.size() + 1) > slots_.size()) resize(2 * keys_.size() + 1);
    std::size_t slot = first_slot(key);
    while (slots_[slot] != empty && keys_[slots_[slot]] != key) slot = (slot + 1) & (slots_.size() - 1);
    if (slots_[slot] == empty) {
      slots_[slot] = keys_.size();
      keys_.push_back(key);
    }
    return slots_[slot];
  }
  std::size_t size() const { return keys_.size(); }

 private:
  static constexpr std::size_t empty = static_cast<std::size_t>(-1);
  std::size_t first_slot(const SideKey& key) const { return SideKeyHash()(key) & (slots_.size() - 1); }
  void resize(std::size_t expected) {
    std::size_t size = 16;
    while (size < 2 * expected + 2) size *= 2;
    slots_.assign(size, empty);
    keys_.reserve(expected);
    for (std::size_t k = 0; k < keys_.size(); ++k) {
      std::size_t slot = first_slot(keys_[k]);
      while (slots_[slot] != empty) slot = (slot + 1) & (size - 1);
      slots_[slot] = k;
    }
  }

  std::vector<SideKey> keys_;       // by number
  std::vector<std::size_t> slots_;  // number, or empty
};

}  // namespace mudline
