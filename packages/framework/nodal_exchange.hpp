#pragma once

#include <memory>
#include <vector>

#include "discretisation/mesh.hpp"

namespace mudline {

/// Adds up node-based values over the ranks that share a node.
class NodalExchange {
 public:
  /// Collective.
  explicit NodalExchange(const Mesh& mesh);
  ~NodalExchange();

  /// `values` by local node, owned and ghost: every copy of a node gets the sum over all ranks' copies. Collective.
  void sum_shared(std::vector<double>& values) const;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace mudline
