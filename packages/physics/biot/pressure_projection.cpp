#include "physics/biot/pressure_projection.hpp"

#include "framework/element_loop.hpp"
#include "framework/residual_kernel.hpp"
#include "physics/soil_points.hpp"

namespace mudline {

void PressureProjection::begin(const StepView& view) {
  matrices_.resize(soil_->blocks.size());
  if (!view.flow) return;
  for (std::size_t k = 0; k < matrices_.size(); ++k) {
    const SoilBlock& b = soil_->blocks[k];
    const SoilPoints points(*soil_, b, *view.committed);
    if (matrices_[k].extent(0) == 0) matrices_[k] = PointView("projection", b.elements, b.p.nodes * b.p.nodes);
    with_element<1>(soil_->geometry, b, [&](auto coordinates, auto shapes) {
      using Loop = ElementLoop<decltype(coordinates), decltype(shapes)>;
      const Loop loop{b, loop_level(view, {view.time_old, view.x_old, 0.0}, b)};
      constexpr int N = Loop::NS;
      for (int e = 0; e < b.elements; ++e) {
        double volume = 0, shear = 0, mean[Loop::NQ] = {}, matrix[Loop::NQ][Loop::NQ] = {};
        loop.template for_each_point<false, false>(
            e, [&](int q, const typename Loop::Shape& s, const typename Loop::Fields&) {
              volume += s.dv;
              shear += s.dv * points.moduli(e * b.points + q).shear;
              for (int c = 0; c < N; ++c) {
                mean[c] += s.dv * s.Np[c];
                for (int d = 0; d < N; ++d) matrix[c][d] += s.dv * s.Np[c] * s.Np[d];
              }
            });
        const double factor = volume / (2 * shear);
        for (int c = 0; c < N; ++c)
          for (int d = 0; d < N; ++d) matrices_[k](e, N * c + d) = factor * (matrix[c][d] - mean[c] * mean[d] / volume);
      }
    });
  }
}

namespace {

/// Loop over the elements of a block with their projection matrices. N: pressure dofs per element, the last columns of
/// its dofs, starting at `first`.
template <int N>
struct ProjectionLoop {
  ElementDofs dofs;
  ConstPointView matrices;
  ConstNodalView rate;
  int first;

  KOKKOS_INLINE_FUNCTION void residual(int e, const VectorScatter& to) const {
    for (int c = 0; c < N; ++c) {
      double sum = 0;
      for (int d = 0; d < N; ++d) sum += matrices(e, N * c + d) * rate(dofs(e, first + d));
      const double size = sum < 0 ? -sum : sum;
      to.add(e, first + c, sum, size, size);
    }
  }
  /// law: derivative of the rates with respect to the unknowns.
  KOKKOS_INLINE_FUNCTION void tangent(int e, double law, const MatrixScatter& to, double weight) const {
    double k[N][N];
    for (int c = 0; c < N; ++c)
      for (int d = 0; d < N; ++d) k[c][d] = law * matrices(e, N * c + d);
    to.add(e, first, first, k, weight);
  }
};

}  // namespace

template <class F>
void PressureProjection::for_each_block(const StepView& view, F&& f) const {
  if (!view.flow) return;
  for (std::size_t k = 0; k < matrices_.size(); ++k) {
    const SoilBlock& b = soil_->blocks[k];
    with_element<1>(soil_->geometry, b, [&](auto, auto shapes) {
      constexpr int N = decltype(shapes)::NS;
      if constexpr (N > 0)
        f(b, ProjectionLoop<N>{b.dofs, matrices_[k], view.rate, static_cast<int>(b.dofs.extent(1)) - N});
    });
  }
}

int PressureProjection::residual(const StepView& view, const ResidualView& f) {
  for_each_block(view, [&](const SoilBlock& b, const auto& loop) {
    add_residuals("projection", b.rows, b.elements, b.dofs, loop, f);
  });
  return 0;
}

void PressureProjection::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const double by_rate = view.sensitivity[soil_->pressure].rate;
  for_each_block(view, [&](const SoilBlock& b, const auto& loop) {
    add_tangents("projection", b.rows, 0, b.elements, loop, by_rate, assembler.scatter(b.group), weight);
  });
}

}  // namespace mudline
