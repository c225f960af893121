#pragma once

#include "ale/mesh_paths.hpp"
#include "ale/remap.hpp"

namespace mudline {

/// Volume of the soil [m3; plane strain: per metre] by its own quadrature, as the balances take it. Collective.
double soil_volume(const GhostedMesh& mesh, const Soil& soil, const Positions& x);

/// Directions in which nodes of the free boundary move to change the soil's volume: normals, outwards, without the
/// prescribed components, as long as the node is free. Of this rank's nodes.
struct FreeBoundary {
  struct Mover {
    int node;
    Point normal;
  };
  std::vector<Mover> movers;
  double area = 0;  // change of the whole soil's volume per common distance [m2]

  /// `freedom`: (node) 0 to 1; `held`: (node, component) nonzero where the displacement is prescribed.
  FreeBoundary(const GhostedMesh& mesh, const Soil& soil, const std::vector<double>& freedom,
               const std::vector<double>& held, const Positions& x);

 private:
  template <int Dim>
  void find(const GhostedMesh& mesh, const Soil& soil, const std::vector<double>& freedom,
            const std::vector<double>& held, const Positions& x);
};

/// Grains of one material in a block [m3].
struct Grains {
  double before = 0;      // the transfer
  double missing = 0;     // after it, and put back
  double unresolved = 0;  // what the points of cut elements seem to have lost by it: not put back
  double lost() const { return before > 0 ? missing / before : 0; }  // [-]
};

/// Void ratios that each material of a block has, or would have, at each point: (row, material of the block). Read
/// where the material has a share of the point.
struct LayerRatios {
  std::vector<double> before, after;
};

/// Makes up for the grains of each material that a transfer lost: the dry density 1/(1+e) of every point changes in
/// proportion to how far the point moved, on another mesh by the same everywhere, by one factor for each material of
/// the block and in proportion to what the material has of the point (Soil::layer_shares). Points at rest keep theirs.
/// Where an interface cuts elements, shares are known to some per cent of an element, and a point has the void ratio of
/// one side only. What a layer seems to gain or lose by these is no loss: the points do not resolve it, and no void
/// ratio changes for it. It stays within what the cut elements hold: it does not add up. `ratios`: read where there are
/// several materials. `void_ratio`, `origin`: columns, as in a SoilTable. Returns what was lost, in the order of the
/// block's materials; nothing is done where nothing moved. Collective.
std::vector<Grains> restore_grains(const PointTransfer& transfer, const Soil& soil, int void_ratio, int origin,
                                   const LayerRatios& ratios = {});

}  // namespace mudline
