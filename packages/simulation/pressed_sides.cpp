#include "simulation/pressed_sides.hpp"

#include <algorithm>

namespace mudline {

std::vector<Side> pressed_sides(const Model& model, const Contact& contact) {
  const std::vector<double> pressed = contact.nodal_pressure(model.store().committed());
  std::vector<Side> result;
  for (const Side& side : model.mesh().side_sets().at(contact.partners().surface)) {
    const ElementBlock& block = model.mesh().blocks()[side.block];
    const std::vector<int>& nodes = side_nodes(block.shape, side.side);
    if (std::all_of(nodes.begin(), nodes.end(), [&](int a) { return pressed[block.nodes(side.element, a)] > 0; }))
      result.push_back(side);
  }
  return result;
}

}  // namespace mudline
