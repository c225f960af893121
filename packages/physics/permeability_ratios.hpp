#pragma once

#include <array>
#include <vector>

#include "core/parameters.hpp"

namespace mudline {

/// Directions of the permeability of a material at the start: the conductivity in three perpendicular directions over
/// the one that the permeability law gives.
class PermeabilityRatios {
 public:
  void parameters(Parameters& p);
  /// Whether the deck gives ratios.
  bool given() const { return !ratios_.empty(); }
  /// Symmetric tensor of the ratios, components as in sym6; of ones without ratios.
  const std::array<double, 6>& tensor() const { return tensor_; }

 private:
  std::vector<double> ratios_;    // [-] by principal direction
  std::vector<double> rotation_;  // [deg] of the principal directions
  std::array<double, 6> tensor_ = {1, 1, 1, 0, 0, 0};
};

}  // namespace mudline
