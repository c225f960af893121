#pragma once

#include "discretisation/mesh.hpp"
#include "framework/state.hpp"

namespace mudline {

/// The box around the nodes of a side. `node`: their `count` local numbers.
inline Bounds side_box(const int* node, int count, const ConstCoordinateView& x) {
  Bounds box = Bounds::nothing();
  for (int a = 0; a < count; ++a) box.enclose(place_of(x, node[a]));
  return box;
}

}  // namespace mudline
