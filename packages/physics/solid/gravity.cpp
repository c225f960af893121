#include "physics/solid/gravity.hpp"

#include <cmath>

namespace mudline {

Point Gravity::up(int dimension) const {
  Point result{};
  const double size = std::hypot(vector[0], vector[1], vector[2]);
  if (size == 0) result[dimension - 1] = 1;
  if (size > 0)
    for (int i = 0; i < 3; ++i) result[i] = -vector[i] / size;
  return result;
}

}  // namespace mudline
