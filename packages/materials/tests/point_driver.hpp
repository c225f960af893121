#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "materials/skeleton.hpp"
#include "tensor/sym6.hpp"

namespace mudline {

/// One material point under mixed control, a laboratory in 60 lines: each of the six components follows a prescribed
/// strain or keeps a prescribed stress. Newton with the law's own tangent. Strains are logarithmic, so e follows
/// 1 + e = (1 + e0) exp(tr eps). Tension positive inside, compression positive in p(), q(), v().
class PointDriver {
 public:
  PointDriver(const Skeleton& law, const std::array<double, 6>& stress, double void_ratio, double ocr = 1.0)
      : stress_(stress), void_ratio_(void_ratio), law_(law), state_(law.state_size()) {
    InitialPoint point{};
    point.stress = stress;
    point.void_ratio = void_ratio;
    point.overconsolidation_ratio = ocr;
    reason_ = law.initialise(point, state_.data());
    EXPECT_EQ(reason_, "");
  }

  double strength_factor = 1.0;  // [-] by which the law divides its strengths

  std::vector<double>& state() { return state_; }
  const std::array<double, 6>& stress() const { return stress_; }
  const std::array<double, 6>& strain() const { return strain_; }
  double p() const { return sym6::mean_pressure(stress_.data()); }
  double q() const { return sym6::invariants(stress_.data()).q; }
  double v() const { return 1.0 + void_ratio_; }
  int iterations() const { return iterations_; }

  /// One evaluation without committing; returns success.
  bool evaluate(const std::array<double, 6>& increment, std::array<double, 6>& stress, std::vector<double>& state,
                std::array<double, 36>* tangent = nullptr, bool plane = false) const {
    const int n = law_.state_size();
    PointView old_stress("", 1, 6), de("", 1, 6), e("", 1, 1), old_state("", 1, n), s("", 1, 6), now("", 1, n),
        t("", 1, 36);
    Kokkos::View<int*> failed("", 1);
    for (int c = 0; c < 6; ++c) {
      old_stress(0, c) = stress_[c];
      de(0, c) = increment[c];
    }
    e(0, 0) = void_ratio_;
    for (int c = 0; c < n; ++c) old_state(0, c) = state_[c];
    SkeletonWorkset workset{1, 0.0, 0.0, tangent != nullptr, old_stress, de, e, old_state, s, now, t, failed, plane};
    workset.strength_factor = strength_factor;
    const int failures = law_.evaluate(workset);
    EXPECT_EQ(failures, failed(0));
    for (int c = 0; c < 6; ++c) stress[c] = s(0, c);
    state.assign(now.data(), now.data() + n);
    if (tangent)
      for (int c = 0; c < 36; ++c) (*tangent)[c] = t(0, c);
    for (int c = 0; c < n; ++c) EXPECT_EQ(old_state(0, c), state_[c]) << "the law wrote into the committed state";
    return failures == 0;
  }

  /// Applies `increment`; components with hold[i] keep their stress instead, and their strain is free.
  void step(std::array<double, 6> increment, const std::array<bool, 6>& hold = {}) {
    std::array<double, 6> stress;
    std::array<double, 36> tangent;
    std::vector<double> state;
    for (int c = 0; c < 6; ++c)
      if (hold[c]) increment[c] = guess_[c];
    double size = 0.0;
    for (iterations_ = 0; iterations_ < 30; ++iterations_) {
      ASSERT_TRUE(evaluate(increment, stress, state, &tangent));
      size = 0.0;
      for (int c = 0; c < 6; ++c)
        if (hold[c]) size = std::max(size, std::abs(stress[c] - stress_[c]));
      if (size <= 1e-9 * std::abs(p())) break;
      correct(hold, stress, tangent, increment);
    }
    ASSERT_LT(iterations_, 30) << "no convergence, residual " << size << " Pa";
    commit(increment, stress, state);
  }

 private:
  /// Newton correction of the held components: K d = r with partial pivoting left out (K is positive definite here).
  void correct(const std::array<bool, 6>& hold, const std::array<double, 6>& stress,
               const std::array<double, 36>& tangent, std::array<double, 6>& increment) const {
    double a[6][7];
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) a[i][j] = hold[i] && hold[j] ? tangent[6 * i + j] : (i == j ? 1.0 : 0.0);
      a[i][6] = hold[i] ? stress_[i] - stress[i] : 0.0;
    }
    for (int k = 0; k < 6; ++k)
      for (int i = 0; i < 6; ++i) {
        if (i == k) continue;
        const double f = a[i][k] / a[k][k];
        for (int j = k; j < 7; ++j) a[i][j] -= f * a[k][j];
      }
    for (int i = 0; i < 6; ++i) increment[i] += a[i][6] / a[i][i];
  }

  void commit(const std::array<double, 6>& increment, const std::array<double, 6>& stress,
              const std::vector<double>& state) {
    double volume = 0.0;
    for (int c = 0; c < 6; ++c) strain_[c] += increment[c];
    for (int c = 0; c < 3; ++c) volume += increment[c];
    void_ratio_ = (1.0 + void_ratio_) * std::exp(volume) - 1.0;
    guess_ = increment;
    stress_ = stress;
    state_ = state;
  }

  std::array<double, 6> stress_, strain_{}, guess_{};
  double void_ratio_;
  int iterations_ = 0;
  const Skeleton& law_;
  std::vector<double> state_;
  std::string reason_;
};

/// Isotropic stress from a compressive mean stress p [Pa]. The axial component is yy, the radial ones are xx and zz, as
/// in an axisymmetric test.
inline std::array<double, 6> isotropic_stress(double p) { return {-p, -p, -p, 0.0, 0.0, 0.0}; }

enum class Path { drained, undrained, oedometric, isotropic };

/// Compresses by `axial` (negative: extends) in `steps` equal increments of logarithmic axial strain.
inline void compress(PointDriver& point, Path path, double axial, int steps) {
  const double d = -axial / steps;
  const double radial = path == Path::undrained ? -0.5 * d : path == Path::isotropic ? d : 0.0;
  const bool hold = path == Path::drained;
  for (int i = 0; i < steps; ++i) {
    if (testing::Test::HasFatalFailure()) break;
    point.step({radial, d, radial, 0.0, 0.0, 0.0}, {hold, false, hold, false, false, false});
  }
}

}  // namespace mudline
