#pragma once

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

/// Makes up for the mass of grains that a transfer lost: the dry density 1/(1+e) of every point changes in proportion
/// to how far the point moved, by one factor for the block. Points at rest keep theirs. Returns the share of the grains
/// that was missing [-]; 0 where nothing moved. `column`: that of the void ratio.
double restore_grains(const PointTransfer& transfer, Geometry geometry, int column);

/// Grains of a block of soil at x: the sum of volumes over 1 + e [m3]. `column`: that of the void ratio in a table of
/// so many columns.
double grains(const WholeMesh& mesh, const SoilBlock& block, const Positions& x, Geometry geometry,
              const std::vector<double>& table, int columns, int column);
/// The same by one factor for all points of a block that has `before` of them to hold; the share that was missing.
double restore_all_grains(const WholeMesh& mesh, const SoilBlock& block, const Positions& x, Geometry geometry,
                          std::vector<double>& table, int columns, int column, double before);

}  // namespace mudline
