#include "physics/solid/stress_update.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "materials/pore_volume.hpp"
#include "physics/solid/kinematics.hpp"

namespace mudline {

StressUpdate::StressUpdate(const Soil& soil, const SoilBlock& block, bool want_tangent)
    : soil_(soil), block_(block), want_tangent_(want_tangent) {
  const int rows = batch * block.points;
  const int state_size = block.material->skeleton->state_size();
  strain_ = PointView("strain", rows, 6);
  stress_old_ = PointView("rotated stress", rows, 6);
  void_ratio_old_ = PointView("void ratio", rows, 1);
  state_old_ = PointView("rotated state", rows, state_size);
  tangent_ = PointView("tangent", want_tangent ? rows : 0, 36);
  failed_ = Kokkos::View<int*>("failed", rows);
  int column = 0;
  std::vector<int> tensors;
  for (const StateVariable& v : block.material->skeleton->state_variables()) {
    if (v.components == 6) tensors.push_back(column);
    column += v.components;
  }
  tensors_ = Kokkos::View<int*>("tensors", tensors.size());
  std::copy(tensors.begin(), tensors.end(), tensors_.data());
}

template <int NU, int NP>
int StressUpdate::kinematics(const StepView& view, int first, int last) {
  const int points = block_.points;
  const PointView committed = view.committed->arrays[block_.stress], committed_law = view.committed->arrays[block_.law];
  const PointView e_old = view.committed->arrays[block_.void_ratio], e_new = view.trial->arrays[block_.void_ratio];
  const auto strain = strain_, stress_old = stress_old_, state_old = state_old_, void_ratio_old = void_ratio_old_;
  const auto N = block_.u.N;
  const auto dN = block_.u.dN;
  const auto Np = block_.p.N;
  const auto nodes = block_.nodes;
  const auto dofs = block_.dofs;
  const bool axisymmetric = soil_.axisymmetric;
  const double alpha = block_.material->biot_coefficient;
  const double grain_compliance =
      block_.material->grain_bulk_modulus > 0 ? 1 / block_.material->grain_bulk_modulus : 0.0;
  const int state_size = static_cast<int>(state_old.extent(1));
  const auto tensors = tensors_;
  int inverted = 0;
  Kokkos::parallel_reduce(
      "kinematics", Kokkos::RangePolicy<>(first, last),
      KOKKOS_LAMBDA(int e, int& failures) {
        double x_old[NU][2], x_end[NU][2], du[NU][2];
        gather<NU>(nodes, e, view.x_old, x_old);
        gather<NU>(nodes, e, view.x_end, x_end);
        gather_increment<NU>(dofs, e, view.value_old, view.value_end, du);
        double p_change[NP > 0 ? NP : 1] = {0};
        if constexpr (NP > 0)
          if (grain_compliance > 0)
            for (int c = 0; c < NP; ++c) {
              const int dof = dofs(e, 2 * NU + c);
              p_change[c] = view.value_end(dof) - view.value_old(dof);
            }
        for (int q = 0; q < points; ++q) {
          IncrementKinematics<NU> k;
          k.compute(x_old, x_end, du, &dN(q, 0, 0), &N(q, 0), axisymmetric);
          const int row = e * points + q, i = (e - first) * points + q;
          double de[4] = {0, 0, 0, 0};
          if (k.ok)
            k.strain(de);
          else
            ++failures;  // the law sees no strain; the step fails anyway
          const double full[6] = {de[0], de[1], de[2], 0, 0, de[3]};
          for (int c = 0; c < 6; ++c) strain(i, c) = full[c];
          rotate_symmetric(&committed(row, 0), k.cosine, k.sine, &stress_old(i, 0));
          for (int c = 0; c < state_size; ++c) state_old(i, c) = committed_law(row, c);
          for (std::size_t t = 0; t < tensors.extent(0); ++t)
            rotate_symmetric(&committed_law(row, tensors(t)), k.cosine, k.sine, &state_old(i, tensors(t)));
          void_ratio_old(i, 0) = e_old(row, 0);
          double dp = 0;
          if constexpr (NP > 0)
            for (int c = 0; c < NP; ++c) dp += Np(q, c) * p_change[c];
          const double n_old = e_old(row, 0) / (1 + e_old(row, 0));
          const double n = porosity_after(alpha, n_old, k.log_volume, dp * grain_compliance);
          e_new(row, 0) = n / (1 - n);
          e_new(row, 1) = e_old(row, 1);
        }
      },
      inverted);
  return inverted;
}

int StressUpdate::run(const StepView& view, int first, int last) {
  int failures = dispatch_pair(block_.shape, block_.porous(), [&](auto pair) {
    return kinematics<decltype(pair)::NU, decltype(pair)::NP>(view, first, last);
  });
  const int count = (last - first) * block_.points, row = first * block_.points;
  const PointView stress = view.trial->arrays[block_.stress], law = view.trial->arrays[block_.law];
  SkeletonWorkset w;
  w.points = count;
  w.time = view.time_end;
  w.dt = view.flow ? view.dt : 0.0;
  w.want_tangent = want_tangent_;
  w.stress_old = stress_old_;
  w.strain = strain_;
  w.void_ratio_old = void_ratio_old_;
  w.state_old = state_old_;
  w.stress = PointView(stress.data() + row * 6, count, 6);
  w.state = PointView(law.data() + row * law.extent(1), count, law.extent(1));
  w.tangent = tangent_;
  w.failed = failed_;
  if (failures > 0 && failure_.empty())
    failure_ = "material '" + block_.material->name + "': the motion turns elements inside out";
  LawFailure failure;
  failures += evaluate_guarded(*block_.material->skeleton, w, failure);
  if (failure.point >= 0 && failure_.empty()) {
    failure_ = describe(view, first, failure);
    law_is_broken_ = !failure.refused;
  }
  return failures;
}

std::string StressUpdate::describe(const StepView& view, int first, const LawFailure& failure) const {
  const int e = first + failure.point / block_.points, q = failure.point % block_.points;
  double at[2] = {0, 0};
  for (int a = 0; a < block_.u.nodes; ++a)
    for (int i = 0; i < 2; ++i) at[i] += block_.u.N(q, a) * view.x_end(block_.nodes(e, a), i);
  char place[80];
  std::snprintf(place, sizeof place, "(%.4g, %.4g)", at[0], at[1]);
  return "the law of material '" + block_.material->name + "' fails at " + place + ": " + failure.reason + " (" +
         increment_text(&stress_old_(failure.point, 0), &strain_(failure.point, 0)) + ")";
}

}  // namespace mudline
