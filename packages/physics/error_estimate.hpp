#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framework/patch_recovery.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Discretisation error of a state as estimated from recovered fields.
struct ErrorEstimate {
  // The vectors are by element of this rank, block after block.
  std::vector<double> stress;    // [Pa] root mean square error of the effective stress in the element
  std::vector<double> pressure;  // [Pa] root mean square error of the pore pressure; empty without pore fluid
  std::vector<double> size;      // [m] side of the equilateral or square element of the same size
  std::vector<double> wanted;    // [m] size with which each element would have an equal share of the target
  double stress_share = 0;       // [-] energy norm of the stress's error over that of its change since the start
  double flow_share = 0;  // [-] the same ratio for the gradient of the excess pore pressure, in the norm of Darcy's law
  double power = 0;  // [W] power of the stress error on the strain rate error, sum of absolute values of the elements
};

/// Estimates the discretisation error after Zienkiewicz & Zhu (1992): the change of the effective stress since the
/// start is recovered as a continuous field, and the difference from it is the error. Strain rate and pore pressure are
/// treated alike. Each region has its own recovered fields, because they jump where the soil changes.
class ErrorEstimator {
 public:
  /// Declares the stress at the start in `store`. Collective.
  ErrorEstimator(const Soil& soil, StateStore& store);
  /// Stores the present effective stress as the reference of later changes.
  void start(const State& state) const;
  /// excess: excess pore pressure [Pa] by overlap dof, unused without pore fluid; target: wanted stress_share [-].
  /// Collective.
  ErrorEstimate estimate(const State& state, const NodalView& excess, double target) const;

 private:
  /// Values at the quadrature points of a block, and its samples for the recovery.
  struct BlockTables;
  struct Sums;
  /// Blocks of one region, as indices into Soil::blocks.
  using Region = std::vector<int>;
  BlockTables tabulate_block(int block, const State& state, const NodalView& excess) const;
  /// Add samples of stress and strain rate at the points where they are most accurate, and of the pore pressure at the
  /// corners.
  void add_samples(const BlockTables& tables, PatchRecovery& stress) const;
  void add_corners(const BlockTables& tables, PatchRecovery& pressure) const;
  /// Root mean square error of the pore pressure in an element [Pa]. It has its own quadrature rule because in cells
  /// whose pressures satisfy Laplace's equation the error vanishes at two points per direction.
  double pressure_error(const BlockTables& tables, int element, const State& state,
                        const PatchRecovery& pressure) const;
  void measure_block(const BlockTables& tables, const State& state, const PatchRecovery& stress,
                     const PatchRecovery* pressure, ErrorEstimate& to, std::vector<double>& energy, Sums& sums) const;

  const Soil& soil_;
  const Mesh& mesh_;
  NodalExchange exchange_;
  std::vector<Region> regions_;
  std::vector<int> start_;  // (block) state handle
};

}  // namespace mudline
