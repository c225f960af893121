#pragma once

#include <cstdint>

namespace mudline {

/// Position along the Hilbert curve of the point t of the unit square (dimension 2) or cube (3): points that are close
/// on the curve are close to each other.
std::uint64_t along_curve(const double* t, int dimension);

}  // namespace mudline
