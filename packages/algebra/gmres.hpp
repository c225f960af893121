#pragma once

#include "algebra/types.hpp"

namespace mudline {

/// GMRES on A P, from x = 0, until its estimate of the residual norm ||b - A x|| is below `tolerance` (absolute). It
/// restarts after 60 search directions and allocates each only when a solve reaches it, because on large meshes all of
/// them would be a fifth of its memory. Returns the iterations done, at most `max_iterations`.
int gmres(const Operator& matrix, const Operator& preconditioner, const Vector& b, Vector& x, double tolerance,
          int max_iterations);

}  // namespace mudline
