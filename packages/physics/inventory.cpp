#include "physics/inventory.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <math.h>  // unqualified functions, as in tensor/dual.hpp

#include "algebra/ordered_sum.hpp"
#include "framework/element_loop.hpp"
#include "physics/mixture.hpp"

namespace mudline {

namespace {

constexpr int count = 8;  // momentum (3), then the others of an Inventory in their order

/// What runs on every element: adds what it has.
template <class Loop>
struct ElementInventory {
  Loop loop;
  Mixture mixture;
  ConstPointView void_ratio;

  KOKKOS_FUNCTION void operator()(int e, double (&sum)[count]) const {
    loop.template for_each_point<true>(e, [&](int q, const typename Loop::Shape& s, const typename Loop::Fields& at) {
      const double ratio = void_ratio(e * loop.b.points + q, 0), n = ratio / (1 + ratio);
      const double mass = mixture.density(n, at) * s.dv;
      for (int i = 0; i < Loop::D; ++i) {
        sum[i] += mass * at.velocity[i];
        sum[3] += 0.5 * mass * at.velocity[i] * at.velocity[i];
      }
      const double warmth = Loop::S > 1 ? at.value[Loop::SQ - 1] : mixture.reference;
      sum[4] += (1 - n) * mixture.grain_density_at(warmth) * s.dv;
      if constexpr (Loop::S > 0) {
        const double squeezed = Loop::S > 1 ? ::expm1(at.value[0] * mixture.fluid_compliance -
                                                      mixture.fluid_expansion * (warmth - mixture.reference))
                                            : at.value[0] * mixture.fluid_compliance;
        sum[5] += n * (1 + squeezed) * s.dv;
        sum[6] += n * s.dv;
        sum[7] += n * squeezed * s.dv;
      }
    });
  }
};

}  // namespace

Inventory take_inventory(const Soil& soil, const State& state) {
  double local[count] = {}, total[count];
  LoopLevel level;
  level.x = state.coordinates;
  level.value = level.value_old = level.value_end = state.value;
  level.rate = state.rate;
  level.acceleration = state.acceleration;
  for (const SoilBlock& b : soil.blocks)
    with_element(soil.geometry, b, [&](auto coordinates, auto shapes) {
      using Loop = ElementLoop<decltype(coordinates), decltype(shapes)>;
      const ElementInventory<Loop> here{{b, level}, Mixture(soil, b), state.arrays[b.void_ratio]};
      const auto sums = ordered_sum<count>("inventory", 0, b.elements, here);
      for (int i = 0; i < count; ++i) local[i] += sums[i];
    });
  Teuchos::reduceAll(*soil.space->dofs()->comm(), Teuchos::REDUCE_SUM, count, local, total);
  return {{total[0], total[1], total[2]}, total[3], total[4], total[5], total[6], total[7]};
}

}  // namespace mudline
