#include "physics/biot/pressure_projection.hpp"

#include "framework/element_loop.hpp"
#include "physics/soil_points.hpp"

namespace mudline {

void PressureProjection::begin(const StepView& view) {
  matrices_.resize(soil_->blocks.size());
  for (std::size_t k = 0; view.flow && k < matrices_.size(); ++k) {
    const SoilBlock& b = soil_->blocks[k];
    const SoilPoints points(*soil_, b, *view.committed);
    if (matrices_[k].extent(0) == 0) matrices_[k] = PointView("projection", b.elements, b.p.nodes * b.p.nodes);
    with_element(soil_->geometry, b, [&](auto coordinates, auto shapes) {
      using Loop = ElementLoop<decltype(coordinates), decltype(shapes)>;
      const Loop loop{b, loop_level(view, {view.time_old, view.x_old, 0.0}, b)};
      constexpr int N = Loop::NS;
      for (int e = 0; e < b.elements; ++e) {
        double volume = 0, shear = 0, mean[Loop::NQ] = {}, matrix[Loop::NQ][Loop::NQ] = {};
        loop.template for_each_point<false>(e, [&](int q, const typename Loop::Shape& s, const typename Loop::Fields&) {
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

template <class F>
void PressureProjection::for_each_row(F&& f) const {
  for (std::size_t k = 0; k < matrices_.size(); ++k) {
    const SoilBlock& b = soil_->blocks[k];
    const int nodes = b.p.nodes, first = static_cast<int>(b.dofs.extent(1)) - nodes;  // the pressures come last
    for (int e = 0; e < b.elements; ++e)
      for (int c = 0; c < nodes; ++c) f(b, e, first, c, &matrices_[k](e, nodes * c));
  }
}

int PressureProjection::residual(const StepView& view, const ResidualView& f) {
  if (!view.flow) return 0;
  for_each_row([&](const SoilBlock& b, int e, int first, int c, const double* row) {
    double sum = 0;
    for (int d = 0; d < b.p.nodes; ++d) sum += row[d] * view.rate(b.dofs(e, first + d));
    f.add(b.dofs(e, first + c), sum);
  });
  return 0;
}

void PressureProjection::jacobian(const StepView& view, Assembler& assembler, double weight) {
  if (!view.flow) return;
  const double by_rate = weight * view.sensitivity[soil_->pressure].rate;
  for_each_row([&](const SoilBlock& b, int e, int first, int c, const double* row) {
    const MatrixScatter to = assembler.scatter(b.group);
    for (int d = 0; d < b.p.nodes; ++d) to.add(e, first + c, first + d, by_rate * row[d]);
  });
}

}  // namespace mudline
