#include "physics/inventory.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <math.h>  // unqualified functions, as in tensor/dual.hpp

#include "algebra/ordered_sum.hpp"
#include "framework/element_loop.hpp"
#include "physics/mixture.hpp"

namespace mudline {

namespace {

constexpr int count = 8;  // momentum (3), then the others of an Inventory in their order, without grains by material

/// What runs on every element: adds what it has.
template <class Loop>
struct ElementInventory {
  Loop loop;
  Mixtures mixtures;
  ConstPointView void_ratio;

  KOKKOS_FUNCTION void operator()(int e, double (&sum)[count]) const {
    loop.template for_each_point<true>(e, [&](int q, const typename Loop::Shape& s, const typename Loop::Fields& at) {
      const int row = e * loop.b.points + q;
      const Mixture& mixture = mixtures(row);
      const double ratio = void_ratio(row, 0), n = ratio / (1 + ratio);
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

/// Adds the grains of one material, where a block has several.
template <class Loop>
struct ElementGrains {
  ElementInventory<Loop> here;
  int material;

  KOKKOS_FUNCTION void operator()(int e, double (&sum)[1]) const {
    here.loop.template for_each_point<true>(
        e, [&](int q, const typename Loop::Shape& s, const typename Loop::Fields& at) {
          const int row = e * here.loop.b.points + q;
          if (static_cast<int>(here.mixtures.which(row, 0)) != material) return;
          const Mixture& mixture = here.mixtures(row);
          const double warmth = Loop::S > 1 ? at.value[Loop::SQ - 1] : mixture.reference;
          sum[0] += mixture.grain_density_at(warmth) * s.dv / (1 + here.void_ratio(row, 0));
        });
  }
};

}  // namespace

Inventory take_inventory(const Soil& soil, const State& state) {
  std::vector<double> local(count + soil.materials.size(), 0.0), total(local);
  LoopLevel level;
  level.x = state.coordinates;
  level.value = level.value_old = level.value_end = state.value;
  level.rate = state.rate;
  level.acceleration = state.acceleration;
  for (const SoilBlock& b : soil.blocks)
    with_element(soil.geometry, b, [&](auto coordinates, auto shapes) {
      using Loop = ElementLoop<decltype(coordinates), decltype(shapes)>;
      const ElementInventory<Loop> here{{b, level}, Mixtures(soil, b, state), state.arrays[b.void_ratio]};
      const auto sums = ordered_sum<count>("inventory", 0, b.elements, here);
      for (int i = 0; i < count; ++i) local[i] += sums[i];
      for (int k : b.made_of)
        local[count + k] +=
            b.made_of.size() == 1 ? sums[4] : ordered_sum<1>("grains", 0, b.elements, ElementGrains<Loop>{here, k})[0];
    });
  Teuchos::reduceAll(*soil.space->dofs()->comm(), Teuchos::REDUCE_SUM, static_cast<int>(local.size()), local.data(),
                     total.data());
  return {{total[0], total[1], total[2]},       total[3], total[4], total[5], total[6],
          {total.begin() + count, total.end()}, total[7]};
}

}  // namespace mudline
