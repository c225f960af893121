#include "materials/point/material_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/guarded.hpp"
#include "materials/guarded_law.hpp"
#include "materials/pore_volume.hpp"
#include "tensor/midpoint_rule.hpp"
#include "tensor/sym6.hpp"

namespace mudline {

namespace {

/// The exponential of a symmetric 3 x 3 tensor: Taylor series of a 2^n-th of it, squared n times.
std::array<double, 9> exponential_of(const Six& strain) {
  double size = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) size = std::max(size, std::abs(strain[six(i, j)]));
  const int squares = size > 0.1 ? 4 + static_cast<int>(std::ceil(std::log2(size))) : 0;
  std::array<double, 9> e{}, term{}, sum{};
  for (int i = 0; i < 9; ++i) {
    e[i] = std::ldexp((i % 4 == 0 ? 1.0 : 0.5) * strain[six(i / 3, i % 3)], -squares);
    sum[i] = term[i] = i % 4 == 0 ? 1.0 : 0.0;
  }
  const auto times = [](const std::array<double, 9>& a, const std::array<double, 9>& b) {
    std::array<double, 9> result{};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) result[3 * i + j] += a[3 * i + k] * b[3 * k + j];
    return result;
  };
  for (int n = 1; n <= 12; ++n) {
    term = times(term, e);
    for (int i = 0; i < 9; ++i) sum[i] += (term[i] /= n);
  }
  for (int n = 0; n < squares; ++n) sum = times(sum, sum);
  return sum;
}

/// Writes the surroundings of a point without a position: F = V R, where the stretch V of the strain follows the
/// rotation R.
void write_surroundings(const PointMotion& motion, const double (&turn)[9], double* row) {
  std::fill_n(row, Surroundings::size, std::numeric_limits<double>::quiet_NaN());
  row[Surroundings::element] = row[Surroundings::point] = 1;
  std::copy_n(turn, 9, row + Surroundings::rotation);
  const std::array<double, 9> V = exponential_of(motion.strain);
  double* F = row + Surroundings::deformation;
  std::fill_n(F, 9, 0.0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) F[3 * i + j] += V[3 * i + k] * turn[3 * k + j];
}

}  // namespace

MaterialPoint::MaterialPoint(const Skeleton& law, const InitialPoint& start, double biot_coefficient)
    : law_(law),
      alpha_(biot_coefficient),
      void_ratio_(start.void_ratio),
      stress_(start.stress),
      state_(law.state_size()) {
  int first = 0;
  for (const StateVariable& variable : law.state_variables()) {
    if (variable.components == 6) tensors_.push_back(first);
    first += variable.components;
  }
  refusal_ = start_guarded(law, start, state_.data());
}

PointTrial MaterialPoint::evaluate(const PointMotion& motion, double dt, bool want_tangent) const {
  const int n = static_cast<int>(state_.size());
  const double turn[9] = {motion.cosine, -motion.sine, 0.0, motion.sine, motion.cosine, 0.0, 0.0, 0.0, 1.0};
  const bool turned = motion.sine != 0.0;
  Six stress = stress_;
  std::vector<double> state = state_;
  if (turned) sym6::rotate(turn, stress_.data(), stress.data());
  if (turned)
    for (const int t : tensors_) sym6::rotate(turn, &state_[t], &state[t]);

  PointView stress_old("", 1, 6), strain("", 1, 6), void_ratio("", 1, 1), state_old("", 1, n), stress_new("", 1, 6),
      state_new("", 1, n), tangent("", 1, 36);
  Kokkos::View<int*> failed("", 1);
  std::copy(stress.begin(), stress.end(), stress_old.data());
  std::copy(motion.strain.begin(), motion.strain.end(), strain.data());
  std::copy(state.begin(), state.end(), state_old.data());
  void_ratio(0, 0) = void_ratio_;
  SkeletonWorkset w{1,          time_ + dt, dt,         want_tangent, stress_old, strain,
                    void_ratio, state_old,  stress_new, state_new,    tangent,    failed};
  w.increment = increment_;
  if (law_.wants_surroundings()) {
    PointView surroundings("", 1, Surroundings::size);
    write_surroundings(motion, turn, surroundings.data());
    w.surroundings = surroundings;
  }
  PointTrial trial;
  std::string reason;
  int failures = 1;
  try {
    failures = law_.evaluate(w);
    reason = failures != 0 ? "it refuses the increment" : "it returns a number that is not finite";
  } catch (...) {
    failed(0) = 1;
    reason = "it throws: " + fault_thrown();
  }

  std::copy_n(stress_new.data(), 6, trial.stress.begin());
  std::copy_n(tangent.data(), 36, trial.tangent.begin());
  trial.state.assign(state_new.data(), state_new.data() + n);
  trial.flags_agree = failures == (failed(0) != 0 ? 1 : 0);
  trial.old_untouched = std::equal(stress.begin(), stress.end(), stress_old.data()) &&
                        std::equal(motion.strain.begin(), motion.strain.end(), strain.data()) &&
                        std::equal(state.begin(), state.end(), state_old.data()) && void_ratio(0, 0) == void_ratio_;
  const auto finite = [](double x) { return std::isfinite(x); };
  trial.ok = failures == 0 && std::all_of(trial.stress.begin(), trial.stress.end(), finite) &&
             std::all_of(trial.state.begin(), trial.state.end(), finite) &&
             (!want_tangent || std::all_of(trial.tangent.begin(), trial.tangent.end(), finite));
  if (!trial.ok) trial.failure = reason + " (" + increment_text(stress.data(), motion.strain.data()) + ")";
  return trial;
}

void MaterialPoint::commit(const PointMotion& motion, double dt, const PointTrial& trial) {
  const double old = void_ratio_ / (1.0 + void_ratio_);
  const double porosity = porosity_after(alpha_, old, sym6::trace(motion.strain.data()), 0.0);
  void_ratio_ = porosity / (1.0 - porosity);
  stress_ = trial.stress;
  state_ = trial.state;
  time_ += dt;
  ++increment_.number;
}

MaterialPoint MaterialPoint::turned(const std::array<double, 9>& rotation) const {
  MaterialPoint result = *this;
  sym6::rotate(rotation.data(), stress_.data(), result.stress_.data());
  for (const int t : tensors_) sym6::rotate(rotation.data(), &state_[t], &result.state_[t]);
  return result;
}

}  // namespace mudline
