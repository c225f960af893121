#pragma once

#include "algebra/types.hpp"

namespace mudline {

/// GMRES on A P, from x = 0: brings the residual b - A x below `tolerance`, in absolute terms, as it estimates it.
/// Starts afresh after 60 search directions; room is taken for those only that a solve comes to, as on large meshes
/// they would be a fifth of its memory. Returns the iterations done, at most `max_iterations`.
int gmres(const Operator& matrix, const Operator& preconditioner, const Vector& b, Vector& x, double tolerance,
          int max_iterations);

}  // namespace mudline
