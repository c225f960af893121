#pragma once

#include <algorithm>
#include <cmath>

#include "ale/mesh_paths.hpp"
#include "ale/remap.hpp"

namespace mudline {

/// Volume of the soil [m3; plane strain: per metre] by its own quadrature, as the balances take it.
double soil_volume(const WholeMesh& mesh, const Soil& soil, const Positions& x);

/// Directions in which nodes of the free boundary move to change the soil's volume: normals, outwards, without the
/// prescribed components, as long as the node is free.
struct FreeBoundary {
  struct Mover {
    int node;
    std::array<double, 2> normal;
  };
  std::vector<Mover> movers;
  double area = 0;  // change of volume per common distance [m2]

  /// `freedom`: (node) 0 to 1; `held`: (node, component) nonzero where the displacement is prescribed.
  FreeBoundary(const WholeMesh& mesh, const Soil& soil, const std::vector<double>& freedom,
               const std::vector<double>& held, const Positions& x);
};

/// Volumes of the points of a block [m3], by row of gather_points.
std::vector<double> point_volumes(const PointTransfer& transfer, Geometry geometry, const Positions& x);

/// Grains of one material in a block [m3].
struct Grains {
  double before = 0;   // the transfer
  double missing = 0;  // after it, and put back
  double changed = 0;  // of points that have come to the material or left it, both
  /// What the transfer lost, which points of one material or another do not explain [-].
  double lost() const {
    return before > 0 ? std::copysign(std::max(0.0, std::abs(missing) - changed), missing) / before : 0;
  }
};

/// Makes up for the grains of each material that a transfer lost: the dry density 1/(1+e) of every point changes in
/// proportion to how far the point moved, by one factor for the block. Points at rest keep theirs. Where a block has
/// several materials, all points of one get the same: its points come and go as a whole, which may be more than those
/// few could take that moved. `column`: that of the void ratio; `was`, `is`: (row) numbers of the materials, before and
/// after. Returns what it did by material; nothing is done where nothing moved.
std::vector<Grains> restore_grains(const PointTransfer& transfer, Geometry geometry, int column,
                                   const std::vector<char>& was, const std::vector<char>& is, std::size_t materials);

/// Grains of a block of soil at x: the sum of volumes over 1 + e [m3]. `column`: that of the void ratio in a table of
/// so many columns.
double grains(const WholeMesh& mesh, const SoilBlock& block, const Positions& x, Geometry geometry,
              const std::vector<double>& table, int columns, int column);
/// The same by one factor for all points of a block that has `before` of them to hold; the share that was missing.
double restore_all_grains(const WholeMesh& mesh, const SoilBlock& block, const Positions& x, Geometry geometry,
                          std::vector<double>& table, int columns, int column, double before);

}  // namespace mudline
