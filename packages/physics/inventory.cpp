#include "physics/inventory.hpp"

#include <Teuchos_CommHelpers.hpp>

#include "physics/element.hpp"
#include "physics/porosity.hpp"

namespace mudline {

Inventory take_inventory(const Soil& soil, const State& state) {
  double local[7] = {0, 0, 0, 0, 0, 0, 0}, total[7];
  for (const SoilBlock& b : soil.blocks) {
    const Mixture mixture(*b.material);
    const PointView void_ratio = state.arrays[b.void_ratio];
    dispatch_pair(b.shape, b.porous(), [&](auto pair) {
      constexpr int NU = decltype(pair)::NU;
      for (int e = 0; e < b.elements; ++e) {
        double x[NU][2];
        gather<NU>(b.nodes, e, state.coordinates, x);
        for (int q = 0; q < b.points; ++q) {
          PointGeometry<NU> at;
          at.compute(x, &b.u.dN(q, 0, 0), &b.u.N(q, 0), soil.axisymmetric);
          const double dv = at.volume(b.u.weights(q)), ratio = void_ratio(e * b.points + q, 0), n = ratio / (1 + ratio);
          double v[2] = {0, 0}, p = 0;
          for (int a = 0; a < NU; ++a)
            for (int i = 0; i < 2; ++i) v[i] += b.u.N(q, a) * state.rate(b.dofs(e, 2 * a + i));
          for (int c = 0; c < b.p.nodes; ++c) p += b.p.N(q, c) * state.value(b.dofs(e, 2 * NU + c));
          const double mass = mixture.density(n) * dv;
          local[0] += mass * v[0];
          local[1] += mass * v[1];
          local[2] += 0.5 * mass * (v[0] * v[0] + v[1] * v[1]);
          local[3] += (1 - n) * mixture.grain_density * dv;
          if (!b.porous()) continue;
          local[4] += n * (1 + p * mixture.fluid_compliance) * dv;
          local[5] += n * dv;
          local[6] += n * p * mixture.fluid_compliance * dv;
        }
      }
    });
  }
  Teuchos::reduceAll(*soil.space->dofs()->comm(), Teuchos::REDUCE_SUM, 7, local, total);
  return {{total[0], total[1]}, total[2], total[3], total[4], total[5], total[6]};
}

}  // namespace mudline
