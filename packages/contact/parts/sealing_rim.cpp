#include "contact/parts/sealing_rim.hpp"

#include <utility>

namespace mudline {

SealingRim::SealingRim(const ContactSurface& surface, int sides, std::function<double(int, int)> consolidation)
    : surface_(surface), sides_(sides), consolidation_(std::move(consolidation)), exchange_(surface.mesh()) {}

std::vector<char> SealingRim::around(const std::vector<char>& covered, const ConstCoordinateView& x, double dt) const {
  const auto& sides = surface_.sides();
  std::vector<char> flags = covered;
  std::vector<double> marked(surface_.mesh().num_nodes());
  for (int ring = 0; ring < sides_; ++ring) {
    for (std::size_t s = 0; s < flags.size(); ++s)
      for (int a = 0; a < sides[s].count && flags[s]; ++a) marked[sides[s].node[a]] = 1;
    exchange_.sum_shared(marked);
    for (std::size_t s = 0; s < flags.size(); ++s)
      for (int a = 0; a < sides[s].count; ++a)
        if (marked[sides[s].node[a]] > 0) flags[s] = 1;
  }
  for (std::size_t s = 0; s < flags.size(); ++s) {
    if (covered[s] || !flags[s]) continue;
    const double h = edges(sides[s], x).second;
    flags[s] = 6 * consolidation_(sides[s].block, sides[s].element) * dt < h * h;
  }
  return flags;
}

}  // namespace mudline
