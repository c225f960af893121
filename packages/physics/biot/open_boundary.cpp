#include "physics/biot/open_boundary.hpp"

#include "framework/element_loop.hpp"
#include "framework/residual_kernel.hpp"
#include "physics/soil_points.hpp"

namespace mudline {

void OpenBoundary::begin(const StepView& view) {
  conductance_.resize(soil_->blocks.size());
  any_ = false;
  for (std::size_t i = 0; i < view.open.extent(0); ++i) any_ = any_ || view.open(i) != 0;
  if (!view.flow || !any_) return;
  for (std::size_t k = 0; k < conductance_.size(); ++k) {
    const SoilBlock& b = soil_->blocks[k];
    const SoilPoints points(*soil_, b, *view.committed);
    if (conductance_[k].extent(0) == 0) conductance_[k] = PointView("conductance", b.elements, b.p.nodes);
    with_moving_element<1>(soil_->geometry, b, [&](auto coordinates, auto shapes) {
      using Loop = ElementLoop<decltype(coordinates), decltype(shapes)>;
      const Loop loop{b, loop_level(view, {view.time_old, view.x_old, 0.0}, b)};
      const int first = Loop::MU;  // the pore pressure is the first scalar
      const auto open = [&](int e, int c) { return view.open(b.dofs(e, first + c)) != 0; };
      for (int e = 0; e < b.elements; ++e) {
        bool any = false;
        for (int c = 0; c < Loop::NS; ++c) {
          conductance_[k](e, c) = 0;
          any = any || open(e, c);
        }
        if (!any) continue;
        loop.template for_each_point<false, true>(
            e, [&](int q, const typename Loop::Shape& s, const typename Loop::Fields&) {
              const int row = e * b.points + q;
              const double mobility = points.mobility(row);
              for (int c = 0; c < Loop::NS; ++c)
                if (open(e, c))
                  conductance_[k](e, c) += s.dv * mobility * points.along_ratios(row, s.gp[c], s.gp[c], Loop::D);
            });
      }
    });
  }
}

namespace {

/// Loop over the elements of a block with the conductances of their vertices. N: vertices of an element, whose pore
/// pressures are columns of its dofs from `first` on.
template <int N>
struct OutflowLoop {
  ElementDofs dofs;
  ConstPointView conductance;  // zero where a vertex is not open
  ConstNodalView pressure, outside;
  int first;

  KOKKOS_INLINE_FUNCTION void residual(int e, const VectorScatter& to) const {
    for (int c = 0; c < N; ++c) {
      if (!(conductance(e, c) > 0)) continue;
      const int dof = dofs(e, first + c);
      const double flow = conductance(e, c) * (pressure(dof) - outside(dof)), size = flow < 0 ? -flow : flow;
      to.add(e, first + c, flow, size, size);
      to.pass(e, first + c, -flow);
    }
  }
  /// law: derivative of the pressures with respect to the unknowns.
  KOKKOS_INLINE_FUNCTION void tangent(int e, double law, const MatrixScatter& to, double weight) const {
    double k[N][N] = {};
    for (int c = 0; c < N; ++c) k[c][c] = law * conductance(e, c);
    to.add(e, first, first, k, weight);
  }
};

}  // namespace

template <class F>
void OpenBoundary::for_each_block(const StepView& view, F&& f) const {
  if (!view.flow || !any_) return;
  for (std::size_t k = 0; k < conductance_.size(); ++k) {
    const SoilBlock& b = soil_->blocks[k];
    with_moving_element<1>(soil_->geometry, b, [&](auto coordinates, auto shapes) {
      using Shapes = decltype(shapes);
      if constexpr (Shapes::NS > 0)
        f(b, OutflowLoop<Shapes::NS>{b.dofs, conductance_[k], view.value, view.outside,
                                     static_cast<int>(decltype(coordinates)::dim * Shapes::NU)});
    });
  }
}

int OpenBoundary::residual(const StepView& view, const ResidualView& f) {
  for_each_block(view, [&](const SoilBlock& b, const auto& loop) {
    add_residuals("open boundary", b.rows, b.elements, b.dofs, loop, f);
  });
  return 0;
}

void OpenBoundary::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const double by_value = view.sensitivity[soil_->pressure].value;
  for_each_block(view, [&](const SoilBlock& b, const auto& loop) {
    add_tangents("open boundary", b.rows, 0, b.elements, loop, by_value, assembler.scatter(b.group), weight);
  });
}

}  // namespace mudline
