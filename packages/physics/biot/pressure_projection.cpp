#include "physics/biot/pressure_projection.hpp"

#include "framework/element_loop.hpp"

namespace mudline {

template <class F>
void PressureProjection::for_each_element(const StepView& view, F&& f) const {
  for (const SoilBlock& b : soil_->blocks) {
    const PointView stress = view.committed->arrays[b.stress], void_ratio = view.committed->arrays[b.void_ratio],
                    law = view.committed->arrays[b.law];
    with_element(soil_->geometry, b, [&](auto coordinates, auto shapes) {
      using Loop = ElementLoop<decltype(coordinates), decltype(shapes)>;
      const Loop loop{b, loop_level(view, {view.time_old, view.x_old, 0.0}, b)};
      constexpr int N = Loop::NQ;
      for (int e = 0; e < b.elements; ++e) {
        double volume = 0, shear = 0, mean[N] = {}, matrix[N][N] = {};
        loop.template for_each_point<false>(e, [&](int q, const typename Loop::Shape& s, const typename Loop::Fields&) {
          const int row = e * b.points + q;
          volume += s.dv;
          shear +=
              s.dv *
              b.material->skeleton->moduli(&stress(row, 0), void_ratio(row, 0), law.data() + row * law.extent(1)).shear;
          for (int c = 0; c < Loop::NS; ++c) {
            mean[c] += s.dv * s.Np[c];
            for (int d = 0; d < Loop::NS; ++d) matrix[c][d] += s.dv * s.Np[c] * s.Np[d];
          }
        });
        const double factor = volume / (2 * shear);
        for (int c = 0; c < N; ++c)
          for (int d = 0; d < N; ++d) matrix[c][d] = factor * (matrix[c][d] - mean[c] * mean[d] / volume);
        f(b, Loop::MU, e, matrix);
      }
    });
  }
}

int PressureProjection::residual(const StepView& view, const ResidualView& f) {
  if (!view.flow) return 0;
  for_each_element(view, [&](const SoilBlock& b, int first, int e, const auto& matrix) {
    const int nodes = b.p.nodes;
    for (int c = 0; c < nodes; ++c) {
      double sum = 0;
      for (int d = 0; d < nodes; ++d) sum += matrix[c][d] * view.rate(b.dofs(e, first + d));
      f.add(b.dofs(e, first + c), sum);
    }
  });
  return 0;
}

void PressureProjection::jacobian(const StepView& view, Assembler& assembler, double weight) {
  if (!view.flow) return;
  const double by_rate = weight * view.sensitivity[soil_->pressure].rate;
  for_each_element(view, [&](const SoilBlock& b, int first, int e, const auto& matrix) {
    const MatrixScatter to = assembler.scatter(b.group);
    for (int c = 0; c < b.p.nodes; ++c)
      for (int d = 0; d < b.p.nodes; ++d) to.add(e, first + c, first + d, by_rate * matrix[c][d]);
  });
}

}  // namespace mudline
