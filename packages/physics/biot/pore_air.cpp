#include "physics/biot/pore_air.hpp"

#include "framework/element_loop.hpp"
#include "framework/residual_kernel.hpp"
#include "physics/mixture.hpp"

namespace mudline {

namespace {

/// Loop over the elements of a block at the end of a step. The pore pressure is the only scalar field.
template <class Loop>
struct AirLoop {
  static constexpr int D = Loop::D, NU = Loop::NU, N = Loop::NQ, first = Loop::MU;
  Loop loop;
  ByMaterial<Mixture> mixtures;
  PointView void_ratio;  // (point; e and initial e) at the start of the step
  double dt;

  /// Volumes of pores that belong to the nodes, and what of them air takes [m3].
  struct Contents {
    double old[N] = {}, now[N] = {};
    double by_pressure[N] = {};              // derivative of `now` with respect to the node's pressure [m3/Pa]
    double by_displacement[N][D * NU] = {};  // and to displacements [m2]
  };
  KOKKOS_INLINE_FUNCTION Contents contents(int e) const {
    Contents found;
    double before[N];
    Dual<1> pressure[N];
    for (int c = 0; c < N; ++c) {
      const int dof = loop.b.dofs(e, first + c);
      before[c] = loop.at.value_old(dof);
      pressure[c] = Dual<1>(loop.at.value_end(dof), 0);
    }
    loop.template for_each_point<false, false>(
        e, [&](int q, const typename Loop::Shape& s, const typename Loop::Fields& at) {
          const int row = e * loop.b.points + q;
          const Mixture& mixture = mixtures(row);
          const double ratio = void_ratio(row, 0), old = ratio / (1 + ratio) * s.dv / at.volume_ratio,
                       now = mixture.porosity(ratio, at) * s.dv;
          for (int c = 0; c < N; ++c) {
            const Dual<1> air = 1.0 - mixture.retention.saturation(pressure[c]);
            found.old[c] += s.Np[c] * old * (1 - mixture.retention.saturation(before[c]));
            found.now[c] += s.Np[c] * now * air.v;
            found.by_pressure[c] += s.Np[c] * now * air.d[0];
            for (int a = 0; a < NU; ++a)  // the volume of the pores grows by that of the soil
              for (int i = 0; i < D; ++i)
                found.by_displacement[c][D * a + i] += s.Np[c] * air.v * s.dv * (s.g[a][i] + (i == 0 ? s.h[a] : 0.0));
          }
        });
    return found;
  }

  KOKKOS_INLINE_FUNCTION void residual(int e, const VectorScatter& to) const {
    const Contents found = contents(e);
    for (int c = 0; c < N; ++c) {
      const double sum = (found.old[c] - found.now[c]) / dt, size = sum < 0 ? -sum : sum;
      to.add(e, first + c, sum, size, size + (found.old[c] + found.now[c]) / dt);
    }
  }
  /// moves: derivative of the coordinates with respect to the unknown displacements.
  KOKKOS_INLINE_FUNCTION void tangent(int e, double moves, const MatrixScatter& to, double weight) const {
    const Contents found = contents(e);
    double k[N][D * NU + N] = {};
    for (int c = 0; c < N; ++c) {
      for (int a = 0; a < D * NU; ++a) k[c][a] = -moves * found.by_displacement[c][a] / dt;
      k[c][D * NU + c] = -found.by_pressure[c] / dt;
    }
    to.add(e, first, 0, k, weight);
  }
};

class PoreAir : public Term {
 public:
  explicit PoreAir(std::shared_ptr<const Soil> soil) : soil_(std::move(soil)) {}
  std::string name() const override { return "pore air"; }
  Role role() const override { return Role::balance; }
  int residual(const StepView& view, const ResidualView& f) override {
    for_each_block(view, [&](const SoilBlock& b, const auto& air) {
      add_residuals("pore air", b.rows, b.elements, b.dofs, air, f);
    });
    return 0;
  }
  void jacobian(const StepView& view, Assembler& assembler, double weight) override {
    for_each_block(view, [&](const SoilBlock& b, const auto& air) {
      add_tangents("pore air", b.rows, 0, b.elements, air, air.loop.at.geometry_weight, assembler.scatter(b.group),
                   weight);
    });
  }

 private:
  template <class F>
  void for_each_block(const StepView& view, F&& f) const {
    for (const SoilBlock& b : soil_->blocks) {
      if (!view.flow || !b.dries) continue;
      with_element<1>(soil_->geometry, b, [&](auto coordinates, auto shapes) {
        using Loop = ElementLoop<decltype(coordinates), decltype(shapes)>;
        f(b, AirLoop<Loop>{{b, end_level(view, b)},
                           mixtures_of(*soil_, b, *view.committed),
                           view.committed->arrays[b.void_ratio],
                           view.dt});
      });
    }
  }
  std::shared_ptr<const Soil> soil_;
};

}  // namespace

std::unique_ptr<Term> pore_air(std::shared_ptr<const Soil> soil) { return std::make_unique<PoreAir>(std::move(soil)); }

}  // namespace mudline
