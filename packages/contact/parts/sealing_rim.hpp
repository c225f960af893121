#pragma once

#include <functional>
#include <vector>

#include "contact/contact_surface.hpp"
#include "framework/nodal_exchange.hpp"

namespace mudline {

/// The sides beside those that a body covers, which are closed to the pore water with them in a step in which their
/// soil cannot drain.
class SealingRim {
 public:
  /// sides: number of sides from a covered one on; consolidation: coefficient c_v [m2/s] of an element (block,
  /// element). Collective.
  SealingRim(const ContactSurface& surface, int sides, std::function<double(int block, int element)> consolidation);
  /// Flags by side: those that are covered, and their rim in a step of dt [s]. A side h long drains from dt = h^2/(6
  /// c_v) on, as far as a mesh resolves that. x: coordinates at the start of the step. Collective.
  std::vector<char> around(const std::vector<char>& covered, const ConstCoordinateView& x, double dt) const;

 private:
  const ContactSurface& surface_;
  int sides_;
  std::function<double(int block, int element)> consolidation_;
  NodalExchange exchange_;
};

}  // namespace mudline
