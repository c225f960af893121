#pragma once

#include <memory>
#include <vector>

#include "ale/ghosted_mesh.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// Field of the wanted element sizes of a mesh: at a vertex the geometric mean over the elements around, within bounds,
/// and above that of any other vertex by at most `growth` per distance; linear between vertices.
class WantedSizes {
 public:
  struct Bounds {
    double smallest, largest;  // [m]
    double growth;             // increase of the size per distance [-]
  };
  /// `mesh`: with all elements of the whole mesh; `by_element`: [m] in the order of its elements. Serial, pure.
  WantedSizes(std::shared_ptr<const GhostedMesh> mesh, const Positions& x, const std::vector<double>& by_element,
              const Bounds& bounds);
  /// Size at a place [m]; outside of the mesh that at its boundary.
  double operator()(const Vec<double, 2>& place) const;
  /// The largest ratio of an element's size to its wanted size.
  double largest_ratio() const;

 private:
  void bound_growth(double growth);
  double in_block(const Vec<double, 2>& place, std::size_t block, double& outside) const;

  std::shared_ptr<const GhostedMesh> mesh_;
  Positions x_;
  std::vector<double> at_vertex_;    // (node) [m]; 0 at other nodes
  mutable std::vector<int> nearby_;  // (block) element of the last place found: the search starts there
};

}  // namespace mudline
