#pragma once

#include <memory>
#include <vector>

#include "discretisation/mesh.hpp"

namespace mudline {

/// Adds up node-based values over the ranks that share a node.
class NodalExchange {
 public:
  /// Which of the mesh's nodes have values.
  enum class Nodes { all, vertices };
  /// Collective.
  explicit NodalExchange(const Mesh& mesh, Nodes nodes = Nodes::all);
  ~NodalExchange();

  /// `values` by local node, owned and ghost, `columns` of them each: every copy of a node gets the sum over all ranks'
  /// copies. Collective.
  void sum_shared(std::vector<double>& values, int columns = 1) const;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace mudline
