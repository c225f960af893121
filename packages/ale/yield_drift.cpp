#include "ale/yield_drift.hpp"

#include <cmath>

#include "algebra/over_ranks.hpp"

namespace mudline {

double yield_drift(const Soil& soil, const State& remapped, const State& evaluated) {
  std::vector<double> sum(2, 0.0);  // of squares: of the change, of the stress
  for (const SoilBlock& b : soil.blocks) {
    const PointView before = remapped.arrays[b.stress], after = evaluated.arrays[b.stress];
    for (std::size_t i = 0; i < before.extent(0); ++i)
      for (int c = 0; c < 6; ++c) {
        const double weight = c < 3 ? 1 : 2, change = after(i, c) - before(i, c);
        sum[0] += weight * change * change;
        sum[1] += weight * after(i, c) * after(i, c);
      }
  }
  sum = sum_over_ranks(*soil.space->mesh().comm(), sum);
  return sum[1] > 0 ? std::sqrt(sum[0] / sum[1]) : 0;
}

}  // namespace mudline
