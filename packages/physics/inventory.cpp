#include "physics/inventory.hpp"

#include <cmath>

#include "algebra/over_ranks.hpp"
#include "framework/element_loop.hpp"
#include "physics/mixture.hpp"

namespace mudline {

Inventory take_inventory(const Soil& soil, const State& state) {
  constexpr int shared = 8;  // momentum (3) and the other members of Inventory in their order; then grains by material
  std::vector<double> local(shared + soil.materials.size(), 0.0);
  const LoopLevel level = level_of(state);
  for (const SoilBlock& b : soil.blocks) {
    const ByMaterial<Mixture> mixture_of = mixtures_of(soil, b, state);
    const PointView void_ratio = state.arrays[b.void_ratio];
    const std::size_t made_of = b.made_of.size();
    std::vector<double> shares(b.points, 1.0);  // (point, material) of one element
    with_moving_element(soil.geometry, b, [&](auto coordinates, auto shapes) {
      using Loop = ElementLoop<decltype(coordinates), decltype(shapes)>;
      const Loop loop{b, level};
      for (int e = 0; e < b.elements; ++e) {
        if (made_of > 1) shares = soil.layer_shares(b, state, e);
        loop.template for_each_point<true, false>(e, [&](int q, const typename Loop::Shape& s,
                                                         const typename Loop::Fields& at) {
          const int row = e * b.points + q;
          const Mixture& mixture = mixture_of(row);
          const double ratio = void_ratio(row, 0), n = ratio / (1 + ratio);
          const double mass = mixture.density(n, at) * s.dv;
          for (int i = 0; i < Loop::D; ++i) {
            local[i] += mass * at.velocity[i];
            local[3] += 0.5 * mass * at.velocity[i] * at.velocity[i];
          }
          double warmth = mixture.reference;
          if constexpr (Loop::S > 0)
            if (mixture.temperature >= 0) warmth = at.value[mixture.temperature];
          for (std::size_t k = 0; k < made_of; ++k) {
            const int material = b.made_of[k];
            const double grains =
                shares[q * made_of + k] * (1 - n) * mixture_of.of(material).grain_density_at(warmth) * s.dv;
            local[4] += grains;
            local[shared + material] += grains;
          }
          if constexpr (Loop::S > 0) {
            const double pressed = mixture.pressure >= 0 ? at.value[mixture.pressure] * mixture.fluid_compliance : 0.0;
            const double squeezed = mixture.temperature >= 0
                                        ? std::expm1(pressed - mixture.fluid_expansion * (warmth - mixture.reference))
                                        : pressed;
            double air = 0;  // share of the pores, by the saturation of the nodes as in pore_air()
            for (int c = 0; c < (b.dries ? Loop::NS : 0); ++c)
              air += s.Np[c] * (1 - mixture.retention.saturation(level.value(b.dofs(e, Loop::MU + c))));
            local[5] += n * (1 + squeezed - air) * s.dv;
            local[6] += n * s.dv;
            local[7] += n * (squeezed - air) * s.dv;
          }
        });
      }
    });
  }
  const std::vector<double> total = sum_over_ranks(*soil.space->dofs()->comm(), local);
  return {{total[0], total[1], total[2]},        total[3], total[4], total[5], total[6],
          {total.begin() + shared, total.end()}, total[7]};
}

}  // namespace mudline
