#pragma once

#include <vector>

#include "framework/nodal_exchange.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// The volume strain of a step that the laws of saturated soil see.
///
/// The balance of the water is fulfilled for the shapes of the pore pressure only. In soil that cannot drain, the
/// volume strain of the motion has no moment with any of them, but within the elements, and between neighbours, it
/// deviates from zero by a share of the shear strain. A law that hardens with its volume keeps the error, and it grows
/// beside rough walls.
///
/// So the volume strain is projected to the shapes of the pore pressure, by least squares over all elements. The law
/// sees its share s of the difference between the projection and the strain of the motion: s = sum N (1 - w), with the
/// drained share of each node
///     w = dt C / (dt C + V),  C = int grad(N) . c_v grad(N) dv,  V = int N dv,
/// and the coefficient of consolidation c_v: what a node's part of the soil loses in a step of its own pressure by
/// flow. So soil that cannot drain within a step keeps its volume as the water does, and soil that drains
/// at once sees its own motion. The difference has no moment with s, so that the total volume stays that of the motion.
/// To this, a multiple of s is added in each material, so that the mass of its grains stays too.
class WaterDilatation {
 public:
  explicit WaterDilatation(const Soil& soil) : soil_(soil), exchange_(soil.space->mesh()) {}

  /// The volume strain that the law of each point sees beyond that of the motion (ln J, swelling positive), by block:
  /// (point, 0). It is zero in blocks that do not ask for it (SoilBlock::sees_water). Collective.
  std::vector<PointView> find(const StepView& view) const;

 private:
  using Values = std::vector<double>;  // by local node
  /// Solves the equations of the projection by conjugate gradients. volume: of the points, by block [m3]; lumped:
  /// volumes of the nodes [m3]; load: moments of the volume strain [m3].
  Values project(const std::vector<PointView>& volume, const Values& lumped, const Values& load) const;
  double product(const Values& a, const Values& b) const;
  /// Adds to `beyond` multiples of `shares`, one in each material, with which the grains of every material have the
  /// mass that they have in the trial state, whose void ratios are still those of the motion. shares: of the points in
  /// the difference, by block.
  void keep_grains(const StepView& view, const std::vector<PointView>& shares,
                   const std::vector<PointView>& beyond) const;

  const Soil& soil_;
  NodalExchange exchange_;
};

}  // namespace mudline
