#pragma once

#include <memory>
#include <vector>

#include "ale/ghosted_mesh.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// Sizes that are wanted of the elements of a mesh, as a field of place: at a vertex the mean, in the logarithm, over
/// the elements around, within bounds and no more than `growth` per distance above that of any other vertex; linear
/// between them.
class WantedSizes {
 public:
  struct Bounds {
    double smallest, largest;  // [m]
    double growth;             // per distance
  };
  /// `mesh`: all elements of the whole one; `by_element`: [m] in the order of its elements. Serial, pure.
  WantedSizes(std::shared_ptr<const GhostedMesh> mesh, const Positions& x, const std::vector<double>& by_element,
              const Bounds& bounds);
  /// [m] at a place; outside of the mesh that of its edge.
  double operator()(const Vec<double, 2>& place) const;
  /// The largest ratio of the size that an element has to the one that is wanted of it.
  double largest_ratio() const;

 private:
  void bound_growth(double growth);
  double in_block(const Vec<double, 2>& place, std::size_t block, double& outside) const;

  std::shared_ptr<const GhostedMesh> mesh_;
  Positions x_;
  std::vector<double> at_vertex_;    // (node) [m]; 0 at other nodes
  mutable std::vector<int> nearby_;  // (block) where the last place was found: the search starts there
};

}  // namespace mudline
