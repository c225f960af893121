#pragma once

#include "framework/point_fields.hpp"
#include "tensor/mat.hpp"
#include "tensor/midpoint_rule.hpp"

namespace mudline {

/// Evaluates the midpoint rule from the gradients at a point in the configuration of the end. Returns false where the
/// midpoint configuration is inverted.
template <class C, int S, class T>
KOKKOS_INLINE_FUNCTION bool find_motion(const PointFields<C, S, T>& at, MidpointRule<C::dim>& motion) {
  constexpr int D = C::dim;
  Mat<double, D> half, back, H;  // dx_{n+1/2} / dx_{n+1} = 1 - moved/2
  for (int i = 0; i < C::dim; ++i)
    for (int j = 0; j < C::dim; ++j) half[i][j] = (i == j ? 1.0 : 0.0) - 0.5 * at.moved[i][j];
  const double det = determinant(half), hoop = 1 - 0.5 * at.hoop_moved;
  const bool valid = det > 0 && hoop > 0;
  if (valid) invert(half, det, back);
  for (int i = 0; i < C::dim; ++i)
    for (int j = 0; j < C::dim; ++j) {
      H[i][j] = 0;
      if (valid)
        for (int k = 0; k < D; ++k) H[i][j] += at.moved[i][k] * back[k][j];
    }
  motion.evaluate(H, valid ? at.hoop_moved / hoop : 0.0, valid);
  return valid;
}

}  // namespace mudline
