#include "physics/solid/stress_divergence.hpp"

#include <algorithm>
#include <stdexcept>

#include "discretisation/agree.hpp"
#include "framework/element_loop.hpp"
#include "physics/mixture.hpp"
#include "physics/soil_points.hpp"
#include "physics/solid/step_motion.hpp"
#include "physics/solid/stress_update.hpp"

namespace mudline {

namespace {

/// Total stress sigma' - alpha p from the point data. Its derivatives consist of the law's tangent D, which an
/// isotropic law gives for a strain increment in the axes of the end, and of the rotation of the stress with the
/// material.
struct TotalStress : PointLaw {
  static constexpr bool stresses = true, stands = true, rates = false;
  ByMaterial<Mixture> mixtures;
  PointView stress, stress_old;
  ConstPointView tangent;  // of the batch
  int first_row = 0;       // of the batch

  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    T pressure = 0.0;
    if constexpr (S > 0) {
      const Mixture& here = mixtures(row);
      if (here.pressure >= 0) pressure = here.acting(at.value[here.pressure]);
    }
    for (int i = 0; i < C::dim; ++i)
      for (int j = 0; j < C::dim; ++j) out.stress[i][j] = stress(row, six(i, j));
    out.hoop_stress = stress(row, 2);
    if constexpr (std::is_same_v<T, double>)
      change(row, at, out);
    else
      derivatives(row, at, out);
    for (int i = 0; i < C::dim; ++i) out.stress[i][i] -= pressure;
    out.hoop_stress -= pressure;
  }

 private:
  template <class C, int S>
  KOKKOS_INLINE_FUNCTION void change(int row, const PointFields<C, S, double>& at,
                                     PointBalance<C, S, double>& out) const {
    for (int i = 0; i < C::dim; ++i)
      for (int j = 0; j < C::dim; ++j) out.stress_change[i][j] = stress(row, six(i, j)) - stress_old(row, six(i, j));
    out.hoop_change = stress(row, 2) - stress_old(row, 2);
    out.pressure_change = 0;
    if constexpr (S > 0) {
      const Mixture& here = mixtures(row);
      if (here.pressure >= 0) {
        const double now = at.value[here.pressure], change = at.change[here.pressure];
        out.pressure_change =
            here.retention.acts() ? here.acting(now - change) - here.acting(now) : -here.alpha * change;
      }
    }
  }

  /// d sigma' = D (de - [W, e]) + [W, sigma'] for a further displacement with strain de and rotation W.
  template <class C, int S, class T>
  KOKKOS_FORCEINLINE_FUNCTION void derivatives(int row, const PointFields<C, S, T>& at,
                                               PointBalance<C, S, T>& out) const {
    using Rule = MidpointRule<C::dim>;
    constexpr int N = Rule::components, motions = LawDirections<C, S, TotalStress>::motions;
    Rule motion;
    find_motion(at, motion);
    double e[N][Rule::width], turn[Rule::spins][Rule::width], turned[Rule::spins][6], by[N][Rule::width];
    motion.variations(e, turn);
    for (int k = 0; k < Rule::spins; ++k) {
      double unit[Rule::spins] = {};
      unit[k] = 1;
      Rule::stress_rotation_rate(unit, &stress(row, 0), turned[k]);
    }
    const double* stiffness = &tangent(row - first_row, 0);
    for (int a = 0; a < N; ++a)
      for (int way = 0; way < Rule::width; ++way) {
        double sum = turned[0][Rule::place(a)] * turn[0][way];
        for (int k = 1; k < Rule::spins; ++k) sum += turned[k][Rule::place(a)] * turn[k][way];
        for (int b = 0; b < N; ++b) sum += stiffness[6 * Rule::place(a) + Rule::place(b)] * e[b][way];
        by[a][way] = sum;
      }
    for (int i = 0; i < C::dim; ++i)
      for (int j = 0; j < C::dim; ++j)
        for (int way = 0; way < motions; ++way) out.stress[i][j].d[way] = by[Rule::number(i, j)][way];
    for (int way = 0; way < motions; ++way) out.hoop_stress.d[way] = by[2][way];
    if constexpr (S > 0) {
      const Mixture& here = mixtures(row);
      if (here.temperature < 0) return;
      const double strain = -here.grain_expansion / 3;  // of the law in warmer soil [1/K]
      const int way = LawDirections<C, S, TotalStress>::value + here.temperature;
      const auto warmed = [&](int c) {
        return strain * (stiffness[6 * c] + stiffness[6 * c + 1] + stiffness[6 * c + 2]);
      };
      for (int i = 0; i < C::dim; ++i)
        for (int j = 0; j < C::dim; ++j) out.stress[i][j].d[way] = warmed(six(i, j));
      out.hoop_stress.d[way] = warmed(2);
    }
  }
};

/// Mixes elastic stiffness into the tangents of `rows` points from row `first` of the block on.
void mix_elastic(const Soil& soil, const SoilBlock& b, const StepView& view, const PointView& tangent, int first,
                 int rows) {
  const double share = view.elastic_share;
  if (share == 0) return;
  const SoilPoints points(soil, b, *view.committed);
  double elastic[36];
  for (int i = 0; i < rows; ++i) {
    const ElasticModuli m = points.moduli(first + i);
    sym6::isotropic_stiffness(m.bulk, m.shear, elastic);
    for (int c = 0; c < 36; ++c) tangent(i, c) += share * (elastic[c] - tangent(i, c));
  }
}

TotalStress total_stress(const Soil& soil, const SoilBlock& b, const StepView& view) {
  return {
      {}, mixtures_of(soil, b, *view.committed), view.trial->arrays[b.stress], view.committed->arrays[b.stress], {}};
}

}  // namespace

int StressDivergence::run(StressUpdate& update, const SoilBlock& block) {
  const int batch = elements_of_batch();
  int failures = 0;
  for (int first = 0; first < block.elements; first += batch)
    failures += update.run(first, std::min(first + batch, block.elements));
  if (failure_.empty()) failure_ = update.failure();
  return failures;
}

int StressDivergence::residual(const StepView& view, const ResidualView& f) {
  int failures = 0;
  failure_.clear();
  kept_ = false;
  tangents_.resize(soil_->blocks.size());
  for (std::size_t k = 0; k < soil_->blocks.size(); ++k) {
    const SoilBlock& b = soil_->blocks[k];
    PointView& all = tangents_[k];
    const std::size_t points = static_cast<std::size_t>(b.elements) * b.points;
    if (keeps_ && all.extent(0) != points)
      all = PointView(Kokkos::view_alloc(Kokkos::WithoutInitializing, "tangents"), points, 36);
    using Tangent = StressUpdate::Tangent;
    StressUpdate update(*soil_, b, view, keeps_ ? Tangent::all : Tangent::none, all);
    failures += run(update, b);
    add_residual(soil_->geometry, b, update.level(), total_stress(*soil_, b, view), f);
  }
  kept_ = keeps_ && failures == 0;
  return failures;
}

void StressDivergence::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const int batch = elements_of_batch();
  std::string broken;
  for (std::size_t k = 0; k < soil_->blocks.size(); ++k) {
    const SoilBlock& b = soil_->blocks[k];
    TotalStress law = total_stress(*soil_, b, view);
    const MatrixScatter to = assembler.scatter(b.group);
    if (kept_) {
      mix_elastic(*soil_, b, view, tangents_[k], 0, b.elements * b.points);
      law.tangent = tangents_[k];
      add_tangent(soil_->geometry, b, end_level(view, b), law, to, weight);
      law.tangent = tangents_[k] = PointView();  // frees memory for the linear solve
      continue;
    }
    StressUpdate update(*soil_, b, view, StressUpdate::Tangent::batch);
    for (int first = 0; first < b.elements; first += batch) {
      const int last = std::min(first + batch, b.elements);
      update.run(first, last);
      if (broken.empty() && update.law_is_broken()) broken = update.failure();
      mix_elastic(*soil_, b, view, update.tangent(), first * b.points, (last - first) * b.points);
      law.tangent = update.tangent();
      law.first_row = first * b.points;
      add_tangent(soil_->geometry, b, update.level(), law, to, weight, first, last);
    }
  }
  kept_ = false;                                          // stored tangents serve one matrix only
  if (!broken.empty()) throw std::runtime_error(broken);  // after all element matrices, so that the ranks stay in step
}

int StressDivergence::complete(const StepView& view, const NodalView& forces) {
  const auto sees = [](const SoilBlock& b) { return b.sees_water; };
  if (!view.flow || std::none_of(soil_->blocks.begin(), soil_->blocks.end(), sees)) return 0;
  if (!dilatation_) dilatation_ = std::make_unique<WaterDilatation>(*soil_);
  const std::vector<PointView> dilatations = dilatation_->find(view);
  Kokkos::deep_copy(forces, 0.0);
  failure_.clear();
  int failures = 0;
  for (std::size_t k = 0; k < soil_->blocks.size(); ++k) {
    const SoilBlock& b = soil_->blocks[k];
    if (b.sees_water) {
      StressUpdate update(*soil_, b, view, StressUpdate::Tangent::none);
      update.add_dilatation(dilatations[k]);
      failures += run(update, b);
    }
    add_residual(soil_->geometry, b, end_level(view, b), total_stress(*soil_, b, view), forces);
  }
  return failures;
}

std::string StressDivergence::hint(const StepView&) const { return broadcast(*soil_->space->dofs()->comm(), failure_); }

}  // namespace mudline
