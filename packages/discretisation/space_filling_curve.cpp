#include "discretisation/space_filling_curve.hpp"

#include <algorithm>

namespace mudline {

namespace {

constexpr int bits = 16;
constexpr std::uint32_t cells = 1u << bits;

std::uint32_t cell(double t) { return static_cast<std::uint32_t>(std::min(std::max(t, 0.0) * cells, cells - 1.0)); }

std::uint64_t in_square(std::uint32_t a, std::uint32_t b) {
  std::uint64_t position = 0;
  for (std::uint32_t s = cells / 2; s > 0; s /= 2) {
    const std::uint32_t right = (a & s) != 0, upper = (b & s) != 0;
    position += static_cast<std::uint64_t>(s) * s * ((3 * right) ^ upper);
    if (upper == 0) {
      if (right == 1) {
        a = cells - 1 - a;
        b = cells - 1 - b;
      }
      std::swap(a, b);
    }
  }
  return position;
}

/// The algorithm of Skilling 2004, "Programming the Hilbert curve".
std::uint64_t in_cube(std::uint32_t (&x)[3]) {
  for (std::uint32_t q = cells / 2; q > 1; q /= 2)
    for (std::uint32_t& here : x) {
      const std::uint32_t below = q - 1;
      if (here & q) {
        x[0] ^= below;
      } else {
        const std::uint32_t change = (x[0] ^ here) & below;
        x[0] ^= change;
        here ^= change;
      }
    }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t change = 0;
  for (std::uint32_t q = cells / 2; q > 1; q /= 2)
    if (x[2] & q) change ^= q - 1;
  std::uint64_t position = 0;
  for (int bit = bits - 1; bit >= 0; --bit)
    for (const std::uint32_t here : x) position = 2 * position + (((here ^ change) >> bit) & 1u);
  return position;
}

}  // namespace

std::uint64_t along_curve(const double* t, int dimension) {
  if (dimension == 2) return in_square(cell(t[0]), cell(t[1]));
  std::uint32_t x[3] = {cell(t[0]), cell(t[1]), cell(t[2])};
  return in_cube(x);
}

}  // namespace mudline
