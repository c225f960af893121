#pragma once

#include "materials/plastic_path.hpp"

namespace mudline {

/// Explicit elastoplastic integration with error control:
///     dlambda = a.D deps / (a.D b - df/dh.B)
/// elastic up to the yield surface (Pegasus), then substeps, each followed by a correction of the drift from the yield
/// surface at fixed strain. A substep is modified Euler, whose local error is the difference from forward Euler, or the
/// six-stage Runge-Kutta pair of orders 5 and 4 of Dormand and Prince.
/// Source: Sloan 1987, IJNME 24:893; Sloan, Abbo & Sheng 2001, Engineering Computations 18:121; Dormand & Prince 1980,
/// J. Comput. Appl. Math. 6:19 (RK5(4)6M).
///
/// With T = Dual and a strain whose components are the independent variables, the result carries the derivative of
/// the update as it was computed: the crossing point, the substep sizes and the drift correction are differentiated
/// too, only the number of substeps is fixed.
template <class T, class Model>
class Substepping : public PlasticPath<T, Model> {
 public:
  using PlasticPath<T, Model>::H;
  using PlasticPath<T, Model>::N;
  using PlasticPath<T, Model>::stress;
  using PlasticPath<T, Model>::h;

  KOKKOS_INLINE_FUNCTION Substepping(const Model& model, const IntegrationOptions& options, const T* strain)
      : PlasticPath<T, Model>(model, options, strain) {
    for (int i = 0; i < N; ++i) plain_strain_[i] = value(strain[i]);
  }

  /// False when no admissible state was found; stress and h are then undefined.
  KOKKOS_INLINE_FUNCTION bool integrate() {
    if (!this->prepare()) return false;
    T trial[N];
    model_.elastic(stress, strain_, trial);
    const double f = value(model_.yield(trial, h));
    if (!(::fabs(f) < 1e200)) return false;  // also rejects NaN
    if (f <= options_.yield_tolerance) {
      copy(trial, stress, N);
      return admissible(stress, h);
    }
    const double crossing = find_crossing(f);
    if (crossing <= 0.0) return integrate_plastic(T(0.0));
    return integrate_plastic(advance_to_yield(crossing));
  }

 private:
  using PlasticPath<T, Model>::model_;
  using PlasticPath<T, Model>::options_;
  using PlasticPath<T, Model>::strain_;
  using PlasticPath<T, Model>::volume_;
  using PlasticPath<T, Model>::copy;
  using PlasticPath<T, Model>::admissible;
  using PlasticPath<T, Model>::correct_drift;
  using PlasticPath<T, Model>::plastic_modulus;

  /// Yield function after the elastic fraction t of the increment, values only.
  KOKKOS_INLINE_FUNCTION double elastic_yield(double t) const {
    double part[N], from[N], to[N], x[H];
    for (int i = 0; i < N; ++i) part[i] = t * plain_strain_[i];
    for (int i = 0; i < N; ++i) from[i] = value(stress[i]);
    for (int i = 0; i < H; ++i) x[i] = value(h[i]);
    model_.elastic(from, part, to);
    return model_.yield(to, x);
  }

  /// Rate of the yield function along the elastic path at stress `sigma` after the fraction t, values only;
  /// `size` is the product of the norms, for judging the angle.
  KOKKOS_INLINE_FUNCTION double elastic_yield_rate(const T* sigma, double t, double& size) const {
    double s[N], x[H], d[N];
    typename PlasticPath<T, Model>::template Flow<double> flow;
    for (int i = 0; i < N; ++i) s[i] = value(sigma[i]);
    for (int i = 0; i < H; ++i) x[i] = value(h[i]);
    model_.flow(s, x, t * value(volume_), flow);
    this->elastic(flow, s, plain_strain_, d);
    size = ::sqrt(model_.space.norm_squared(flow.yield_gradient) * model_.space.norm_squared(d));
    return model_.space.work(d, flow.yield_gradient);
  }

  /// Fraction of the increment at which the elastic path leaves the surface; 0 when it does so at once.
  KOKKOS_INLINE_FUNCTION double find_crossing(double f_end) const {
    const double f_start = elastic_yield(0.0);
    if (f_start < -options_.yield_tolerance) return pegasus(0.0, f_start, 1.0, f_end);
    double size;
    const double rate = elastic_yield_rate(stress, 0.0, size);
    if (!(rate < -1e-6 * size)) return 0.0;
    // Unloading first: look for a bracket on ever finer divisions of the beginning.
    double end = 1.0;
    for (int level = 0; level < 6; ++level) {
      double inside = 0.0, f_inside = 0.0;
      for (int i = 1; i <= 10; ++i) {
        const double t = 0.1 * i * end, f = elastic_yield(t);
        if (f < -options_.yield_tolerance) {
          inside = t;
          f_inside = f;
        } else if (f > options_.yield_tolerance) {
          if (inside > 0.0) return pegasus(inside, f_inside, t, f);
          end = t;
          break;
        }
      }
    }
    return 0.0;  // the excursion is below the tolerance
  }

  /// Root of the yield function on the elastic path, f(low) < 0 < f(high).
  KOKKOS_INLINE_FUNCTION double pegasus(double low, double f_low, double high, double f_high) const {
    for (int i = 0; i < 60; ++i) {
      const double t = high - f_high * (high - low) / (f_high - f_low);
      const double f = elastic_yield(t);
      if (::fabs(f) <= options_.yield_tolerance) return t;
      if (f * f_high < 0.0) {
        low = high;
        f_low = f_high;
      } else {
        f_low *= f_high / (f_high + f);
      }
      high = t;
      f_high = f;
    }
    return f_high <= 0.0 ? high : low;
  }

  /// Moves the stress elastically to the crossing; returns the crossing with its derivative from f(t, strain) = 0.
  KOKKOS_INLINE_FUNCTION T advance_to_yield(double crossing) {
    T part[N], at[N];
    for (int i = 0; i < N; ++i) part[i] = strain_[i] * crossing;
    model_.elastic(stress, part, at);
    const T f = model_.yield(at, h);
    double size;
    const double rate = elastic_yield_rate(at, crossing, size);
    T fraction(crossing);
    // One Newton step improves the root and gives its derivative. A path that grazes the surface has no derivative.
    if (rate > 1e-10 * size) fraction -= f / rate;
    for (int i = 0; i < N; ++i) part[i] = strain_[i] * fraction;
    model_.elastic(stress, part, at);
    copy(at, stress, N);
    return fraction;
  }

  KOKKOS_INLINE_FUNCTION bool integrate_plastic(T time) {
    constexpr double smallest = 1e-8;
    T step = 1.0 - time, new_stress[N], new_h[H], error_squared = 0.0;
    bool rejected = false;
    for (int attempt = 0; attempt < options_.maximum_substeps; ++attempt) {
      ++this->substeps;
      if (!substep(time, step, new_stress, new_h, error_squared)) {
        step *= 0.25;
        rejected = true;
      } else if (!(value(error_squared) <= options_.stress_tolerance * options_.stress_tolerance)) {
        step *= step_factor(error_squared, 0.1, 1.0);
        rejected = true;
      } else {
        copy(new_stress, stress, N);
        copy(new_h, h, H);
        time += step;
        if (!correct_drift(time)) return false;
        if (exhausted() || value(time) >= 1.0 - smallest) return true;
        step *= step_factor(error_squared, 0.1, rejected ? 1.0 : 2.0);
        if (value(time) + value(step) > 1.0) step = 1.0 - time;
        rejected = false;
      }
      if (!(value(step) >= smallest)) return false;
    }
    return false;
  }

  KOKKOS_INLINE_FUNCTION bool exhausted() const {
    double s[N];
    for (int i = 0; i < N; ++i) s[i] = value(stress[i]);
    return model_.exhausted(s);
  }

  /// 0.9 (tolerance/error)^(1/order) within bounds.
  KOKKOS_INLINE_FUNCTION T step_factor(const T& error_squared, double low, double high) const {
    if (options_.method == IntegrationOptions::Method::dormand_prince) return step_factor_5(error_squared, low, high);
    const double target = 0.6561 * options_.stress_tolerance * options_.stress_tolerance;  // (0.9^4) tolerance^2
    const double raw = target / value(error_squared);                                      // factor^4
    if (!(raw < high * high * high * high)) return T(high);
    if (raw < low * low * low * low) return T(low);
    return square_root(square_root(target / error_squared));
  }
  KOKKOS_INLINE_FUNCTION T step_factor_5(const T& error_squared, double low, double high) const {
    const T ratio = options_.stress_tolerance * options_.stress_tolerance / error_squared;
    const double factor = 0.9 * ::pow(value(ratio), 0.1);
    if (!(factor < high)) return T(high);
    if (factor < low) return T(low);
    return chain(ratio, factor, 0.1 * factor / value(ratio));
  }

  KOKKOS_INLINE_FUNCTION bool substep(const T& time, const T& step, T* new_stress, T* new_h, T& error_squared) const {
    return options_.method == IntegrationOptions::Method::dormand_prince
               ? dormand_prince(time, step, new_stress, new_h, error_squared)
               : modified_euler(time, step, new_stress, new_h, error_squared);
  }

  /// One substep; false where the rates are undefined within it.
  KOKKOS_INLINE_FUNCTION bool modified_euler(const T& time, const T& step, T* new_stress, T* new_h,
                                             T& error_squared) const {
    T s1[N], h1[H], s2[N], h2[H];
    if (!rates(stress, h, time, step, s1, h1)) return false;
    for (int i = 0; i < N; ++i) new_stress[i] = stress[i] + s1[i];
    for (int i = 0; i < H; ++i) new_h[i] = h[i] + h1[i];
    if (!admissible(new_stress, new_h)) return false;
    if (!rates(new_stress, new_h, time + step, step, s2, h2)) return false;
    for (int i = 0; i < N; ++i) new_stress[i] = stress[i] + 0.5 * (s1[i] + s2[i]);
    for (int i = 0; i < H; ++i) new_h[i] = h[i] + 0.5 * (h1[i] + h2[i]);
    if (!admissible(new_stress, new_h)) return false;
    for (int i = 0; i < N; ++i) s2[i] -= s1[i];
    error_squared = model_.space.norm_squared(s2) / (4.0 * model_.space.norm_squared(new_stress));
    for (int i = 0; i < H; ++i) {
      const double scale = model_.hardening_scale(i, value(new_h[i]));
      const T e = (h2[i] - h1[i]) / (2.0 * scale);
      if (value(e) * value(e) > value(error_squared)) error_squared = e * e;
    }
    return true;
  }

  KOKKOS_INLINE_FUNCTION bool dormand_prince(const T& time, const T& step, T* new_stress, T* new_h,
                                             T& error_squared) const {
    constexpr double node[6] = {0.0, 1.0 / 5, 3.0 / 10, 3.0 / 5, 2.0 / 3, 1.0};
    constexpr double weight[7][6] = {{},
                                     {1.0 / 5},
                                     {3.0 / 40, 9.0 / 40},
                                     {3.0 / 10, -9.0 / 10, 6.0 / 5},
                                     {226.0 / 729, -25.0 / 27, 880.0 / 729, 55.0 / 729},
                                     {-181.0 / 270, 5.0 / 2, -266.0 / 297, -91.0 / 27, 189.0 / 55},
                                     {19.0 / 216, 0.0, 1000.0 / 2079, -125.0 / 216, 81.0 / 88, 5.0 / 56}};
    constexpr double fourth_order[6] = {31.0 / 540, 0.0, 190.0 / 297, -145.0 / 108, 351.0 / 220, 1.0 / 20};
    T s[6][N], x[6][H], stress_error[N], h_error[H];
    for (int stage = 0; stage <= 6; ++stage) {
      copy(stress, new_stress, N);
      copy(h, new_h, H);
      for (int j = 0; j < stage; ++j) {
        if (weight[stage][j] == 0.0) continue;
        for (int i = 0; i < N; ++i) new_stress[i] += weight[stage][j] * s[j][i];
        for (int i = 0; i < H; ++i) new_h[i] += weight[stage][j] * x[j][i];
      }
      if (stage > 0 && !admissible(new_stress, new_h)) return false;
      if (stage < 6 && !rates(new_stress, new_h, time + step * node[stage], step, s[stage], x[stage])) return false;
    }
    for (int i = 0; i < N; ++i) stress_error[i] = T(0.0);
    for (int i = 0; i < H; ++i) h_error[i] = T(0.0);
    for (int j = 0; j < 6; ++j) {
      const double difference = weight[6][j] - fourth_order[j];
      for (int i = 0; i < N; ++i) stress_error[i] += difference * s[j][i];
      for (int i = 0; i < H; ++i) h_error[i] += difference * x[j][i];
    }
    error_squared = model_.space.norm_squared(stress_error) / model_.space.norm_squared(new_stress);
    for (int i = 0; i < H; ++i) {
      const T e = h_error[i] / model_.hardening_scale(i, value(new_h[i]));
      if (value(e) * value(e) > value(error_squared)) error_squared = e * e;
    }
    return true;
  }

  KOKKOS_INLINE_FUNCTION bool rates(const T* sigma, const T* hardening, const T& time, const T& step, T* d_stress,
                                    T* d_hardening) const {
    typename PlasticPath<T, Model>::template Flow<T> flow;
    T d[N], db[N], modulus;
    model_.flow(sigma, hardening, volume_ * time, flow);
    if (!plastic_modulus(flow, sigma, db, modulus)) return false;
    for (int i = 0; i < N; ++i) d_stress[i] = strain_[i] * step;
    this->elastic(flow, sigma, d_stress, d);
    T multiplier = model_.space.work(d, flow.yield_gradient) / modulus;
    if (value(multiplier) < 0.0) multiplier = T(0.0);
    for (int i = 0; i < N; ++i) d_stress[i] = d[i] - multiplier * db[i];
    for (int i = 0; i < H; ++i) d_hardening[i] = multiplier * flow.hardening_rate[i];
    return true;
  }

  double plain_strain_[N];
};

}  // namespace mudline
