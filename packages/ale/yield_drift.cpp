#include "ale/yield_drift.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <cmath>

namespace mudline {

double yield_drift(const Soil& soil, const State& remapped, const State& evaluated) {
  double local[2] = {0, 0}, sum[2];
  for (const SoilBlock& b : soil.blocks) {
    const PointView before = remapped.arrays[b.stress], after = evaluated.arrays[b.stress];
    for (std::size_t i = 0; i < before.extent(0); ++i)
      for (int c = 0; c < 6; ++c) {
        const double weight = c < 3 ? 1 : 2, change = after(i, c) - before(i, c);
        local[0] += weight * change * change;
        local[1] += weight * after(i, c) * after(i, c);
      }
  }
  Teuchos::reduceAll(*soil.space->mesh().comm(), Teuchos::REDUCE_SUM, 2, local, sum);
  return sum[1] > 0 ? std::sqrt(sum[0] / sum[1]) : 0;
}

}  // namespace mudline
