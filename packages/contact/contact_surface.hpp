#pragma once

#include <string>
#include <vector>

#include "framework/nodal_exchange.hpp"
#include "framework/state.hpp"

namespace mudline {

/// One side of the soil's surface on this rank.
struct SurfaceSide {
  int block, element, side;
  CellShape shape;
  int count;      // nodes
  int node[9];    // local, in the order of the shape
  int row;        // among the sides of its shape
  double height;  // [m] height of the element above the side, in the mesh at the start
};

/// The sides of a side set that may touch a target: nodes, neighbours over the ranks.
class ContactSurface {
 public:
  /// Collective.
  ContactSurface(const Mesh& mesh, const std::string& side_set);

  const std::vector<SurfaceSide>& sides() const { return sides_; }
  const Mesh& mesh() const { return mesh_; }
  /// Number of sides over all ranks.
  long long num_global_sides() const { return num_global_sides_; }
  /// The shapes that this rank's sides have, in a fixed order.
  const std::vector<CellShape>& shapes() const { return shapes_; }

  /// Shortest and longest edge of a side, between its corners [m], over all ranks. Collective.
  double shortest(const ConstCoordinateView& x) const;
  double longest(const ConstCoordinateView& x) const;

  /// Weighted mean, by local node and over all ranks, of values that were summed with their weights. Collective.
  std::vector<double> mean(std::vector<double> weighted, std::vector<double> weights) const;

 private:
  const Mesh& mesh_;
  NodalExchange exchange_;
  std::vector<SurfaceSide> sides_;
  std::vector<CellShape> shapes_;
  long long num_global_sides_ = 0;
};

/// Shortest and longest edge of one side [m].
std::pair<double, double> edges(const SurfaceSide& side, const ConstCoordinateView& x);

}  // namespace mudline
