#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framework/patch_recovery.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// What recovered fields say of the discretisation error of a state.
struct ErrorEstimate {
  // By element of this rank, block after block.
  std::vector<double> stress;    // [Pa] root mean square over the element of the error of the effective stress
  std::vector<double> pressure;  // [Pa] the same of the pore pressure; empty without pore fluid
  std::vector<double> size;      // [m] of the side of an equilateral or square element as large
  std::vector<double> wanted;    // [m] with which each element would have an equal share of the target
  double stress_share = 0;       // [-] energy norm of the stress's error over that of its change since the start
  double flow_share = 0;         // [-] the same of the gradient of the excess pore pressure, in the norm of Darcy's law
  double power = 0;              // [W] of the stress's error on that of the strain rate, by elements in absolute value
};

/// Estimates the discretisation error after Zienkiewicz & Zhu (1992): the change of the effective stress since the
/// start is recovered as a continuous field, and what differs from it is the error. The same of the rate of strain and
/// of the pore pressure. A region has its own recovered fields: they jump where the soil changes.
class ErrorEstimator {
 public:
  /// Declares the stress at the start in `store`. Collective.
  ErrorEstimator(const Soil& soil, StateStore& store);
  /// The present effective stress is the start from which its change is counted.
  void start(const State& state) const;
  /// excess: excess pore pressure by overlap dof; not looked at without pore fluid. target: wanted stress_share.
  /// Collective.
  ErrorEstimate estimate(const State& state, const NodalView& excess, double target) const;

 private:
  /// What a block has at its quadrature points, and its samples for the recovery.
  struct BlockTables;
  struct Sums;
  /// Blocks of one region, by their place in the soil.
  using Region = std::vector<int>;
  BlockTables tabulate_block(int block, const State& state, const NodalView& excess) const;
  /// Samples of stress and strain rate, where they are most exact; of the pore pressure at the corners.
  void add_samples(const BlockTables& tables, PatchRecovery& stress) const;
  void add_corners(const BlockTables& tables, PatchRecovery& pressure) const;
  /// [Pa] Root mean square over an element of the error of the pore pressure. It is integrated by a rule of its own: in
  /// cells whose pressures satisfy Laplace's equation the error vanishes at two points per direction.
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
