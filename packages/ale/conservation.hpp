#pragma once

#include "ale/mesh_paths.hpp"
#include "ale/remap.hpp"

namespace mudline {

/// Volume of the soil [m3; plane strain: per metre] by the soil's own quadrature, as in the balances. Collective.
double soil_volume(const GhostedMesh& mesh, const Soil& soil, const Positions& x);

/// Directions in which nodes of the free boundary move to change the soil's volume: outward normals without the
/// prescribed components, scaled by the node's freedom. Holds this rank's nodes.
struct FreeBoundary {
  struct Mover {
    int node;
    Point normal;
  };
  std::vector<Mover> movers;
  double area = 0;  // change of the whole soil's volume per distance that all movers share [m2]

  /// `freedom`: (node) 0 to 1; `held`: (node, component) nonzero where the displacement is prescribed.
  FreeBoundary(const GhostedMesh& mesh, const Soil& soil, const std::vector<double>& freedom,
               const std::vector<double>& held, const Positions& x);

 private:
  template <int Dim>
  void find(const GhostedMesh& mesh, const Soil& soil, const std::vector<double>& freedom,
            const std::vector<double>& held, const Positions& x);
};

/// Volumes [m3; plane strain: per metre] of the points of a block, ghosts among them: (row of gather_points).
std::vector<double> point_volumes(const BlockPoints& at, Geometry geometry);

/// Grains of one material in a block [m3].
struct Grains {
  double before = 0;      // before the transfer
  double missing = 0;     // lost by the transfer, and put back
  double unresolved = 0;  // lost by the shares of points in cut elements alone: not put back
  double lost() const { return before > 0 ? missing / before : 0; }  // [-]
};

/// Void ratios of each material of a block, continued to all its points: (row, material of the block). They are used
/// where the material has a share of the point.
struct LayerRatios {
  std::vector<double> before, after;
};

/// Restores the grains of each material that a transfer lost: the dry density 1/(1+e) of every point changes by one
/// factor for each material of the block, times the material's share of the point (Soil::layer_shares), times a weight:
/// on the moved mesh the distance that the point moved over its size, at most 1; on another mesh 1. Points at rest keep
/// theirs. Where an interface cuts elements, shares are known to some per cent of an element, and a point has the void
/// ratio of one side only. Gains and losses by these shares alone are not resolved by the points, and no void ratio
/// changes for them. They are bounded by the content of the cut elements and do not accumulate. `ratios`: used where
/// there are several materials. `void_ratio`, `origin`: columns, as in a SoilTable. Returns the losses, in the order of
/// the block's materials; nothing is done where nothing moved. Collective.
std::vector<Grains> restore_grains(const PointTransfer& transfer, const Soil& soil, int void_ratio, int origin,
                                   const LayerRatios& ratios = {});

}  // namespace mudline
