#pragma once

#include "algebra/types.hpp"

namespace mudline {

/// |A| |x|: the sum of the sizes of the products of A x before they cancel. Its rounding is that of A x. Collective.
Vector absolute_product(const CrsMatrix& A, const Vector& x);

}  // namespace mudline
