#pragma once

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "ale/ghosted_mesh.hpp"

namespace mudline {

using Ids = std::vector<long long>;

/// Sorts the numbers and removes those that are there already.
inline void sort_unique(Ids& ids) {
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
}

/// Elements by global id: shape and block, then global nodes.
class ElementRecords {
 public:
  void add(long long id, int block, CellShape shape, const long long* nodes) {
    if (!place_.emplace(id, numbers_.size()).second) return;
    numbers_.insert(numbers_.end(), {id, block, static_cast<long long>(shape)});
    numbers_.insert(numbers_.end(), nodes, nodes + mudline::num_nodes(shape));
  }
  /// Adds the records of another table.
  void add(const Ids& numbers) {
    for (std::size_t i = 0; i < numbers.size();) {
      const auto shape = static_cast<CellShape>(numbers[i + 2]);
      add(numbers[i], static_cast<int>(numbers[i + 1]), shape, &numbers[i + 3]);
      i += 3 + mudline::num_nodes(shape);
    }
  }
  bool has(long long id) const { return place_.count(id) > 0; }
  const long long* at(long long id) const { return &numbers_[place_.at(id)]; }
  static int length(const long long* record) { return 3 + mudline::num_nodes(static_cast<CellShape>(record[2])); }
  Ids ids() const {
    Ids result;
    for (const auto& [id, place] : place_) result.push_back(id);
    std::sort(result.begin(), result.end());
    return result;
  }
  const Ids& numbers() const { return numbers_; }

 private:
  std::unordered_map<long long, std::size_t> place_;
  Ids numbers_;
};

/// Finds the elements around this rank's own ones. Owners of nodes know all elements around them.
class Neighbourhood {
 public:
  explicit Neighbourhood(const Mesh& mesh);
  ElementRecords records;  // of this rank's elements and those found

  /// Adds so many layers of elements around; GhostedMesh::whole: all elements. Collective.
  void add_layers(int layers);
  /// Adds the elements near the boxes that a rank wants. Collective.
  void add_near(const GhostedMesh::Wanted& wanted);
  /// Whether all elements around a node are there.
  bool is_complete(long long node) const { return asked_.count(node) > 0; }
  /// The nodes of all elements, with repetitions.
  std::vector<const long long*> nodes() const;

 private:
  /// Tells the owners of nodes which elements are around these.
  void find_owners();
  void look_up(const std::vector<const long long*>& nodes);
  void add_layer();

  const Mesh& mesh_;
  RCP<const Map> owned_;
  ElementRecords visitors_;                    // elements around the nodes that this rank owns
  std::unordered_map<long long, Ids> around_;  // elements around each node
  std::unordered_map<long long, int> owner_;   // rank
  std::unordered_set<long long> asked_;
};

}  // namespace mudline
