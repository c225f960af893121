#pragma once

#include "algebra/types.hpp"

namespace mudline {

/// |A| |x|: the sum of the absolute values of the products in A x, before they cancel. It measures the rounding of A x.
/// Collective.
Vector absolute_product(const CrsMatrix& A, const Vector& x);

}  // namespace mudline
