#pragma once

#include "tensor/sym6.hpp"

namespace mudline {

/// Takes what would bring p' below its minimum out of a stress rate: between twice the minimum and the minimum the fall
/// of p' dies away. For laws that are integrated as rates.
template <class T>
KOKKOS_INLINE_FUNCTION void limit_fall(const T& p, double minimum, T* stress_rate) {
  const T loss = sym6::trace(stress_rate) * (1.0 / 3.0);
  if (!(value(loss) > 0.0 && value(p) < 2.0 * minimum)) return;
  const T kept = value(p) > minimum ? p / minimum - 1.0 : T(0.0);
  for (int i = 0; i < 3; ++i) stress_rate[i] -= loss * (1.0 - kept);
}

}  // namespace mudline
