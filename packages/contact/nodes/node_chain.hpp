#pragma once

#include <vector>

#include "contact/master_surface.hpp"

namespace mudline {

/// Nodes of a surface one after the other, its body on their left.
struct NodeChain {
  std::vector<int> nodes;  // local; of a closed chain each one once
  bool closed = false;
};

/// The sides of a surface joined end to end, with the mid-side nodes of quadratic ones. A chain ends where three sides
/// meet.
std::vector<NodeChain> node_chains(const std::vector<MasterSurface::MasterSide>& sides);

/// The chains cut at their corners, where straight lines between neighbouring nodes turn by more than `angle` [rad].
std::vector<NodeChain> cut_at_corners(const std::vector<NodeChain>& chains, double angle, const ConstCoordinateView& x);

}  // namespace mudline
