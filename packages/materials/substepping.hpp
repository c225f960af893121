#pragma once

#include "tensor/sym6.hpp"

namespace mudline {

struct SubsteppingOptions {
  double stress_tolerance = 1e-4;  // relative local error that a substep may have
  double yield_tolerance = 1e-9;   // on the model's dimensionless yield function
  int maximum_substeps = 1000;     // attempts per increment
};

/// All that the plastic rate equations need of a model at one state. Gradients with respect to stress are strain-like
/// six-vectors (engineering shear), H is the number of hardening variables.
template <class T, int H>
struct PlasticFlow {
  T bulk, shear;            // [Pa] tangential elastic moduli
  T yield_gradient[6];      // a = df/dsigma
  T flow_direction[6];      // b = dg/dsigma; unused by associated models
  T hardening_gradient[H];  // df/dh
  T hardening_rate[H];      // B in dh = dlambda B
};

/// Explicit elastoplastic integration with error control, for any model of rate-independent plasticity with isotropic
/// tangential elasticity:
///     dsigma = D (deps - dlambda b),  dh = dlambda B,  dlambda = a.D deps / (a.D b - df/dh.B)
/// elastic up to the yield surface (Pegasus), then modified Euler substeps whose local error is the difference from
/// forward Euler, each followed by a correction of the drift from the yield surface at fixed strain.
/// Source: Sloan 1987, IJNME 24:893; Sloan, Abbo & Sheng 2001, Engineering Computations 18:121.
///
/// With T = Dual<6> and a strain whose components are the independent variables, the result carries the derivative of
/// the update as it was computed: the crossing point, the substep sizes and the drift correction are differentiated
/// too, only the number of substeps is fixed.
///
/// A Model provides (KOKKOS_INLINE_FUNCTION, tension positive):
///     static constexpr int hardening;                       number of hardening variables, at least 1
///     static constexpr bool associated;                     b = a
///     T yield(const T* stress, const T* h) const;           dimensionless, negative inside, of order 1 outside
///     void flow(const T* stress, const T* h, const T& volume_strain, PlasticFlow<T, hardening>&) const;
///     void elastic(const T* stress, const T* strain, T* out) const;    exact, from the start of the increment
///     bool admissible(const double* stress, const double* h) const;    where all of the above are defined
///     bool exhausted(const double* stress) const;           stop here: the model deals with such states itself
///     double hardening_scale(int i, double h) const;        what the error of variable i is measured by
/// volume_strain: trace of the strain since the start of the increment.
template <class T, class Model>
class Substepping {
 public:
  static constexpr int H = Model::hardening;

  KOKKOS_INLINE_FUNCTION Substepping(const Model& model, const SubsteppingOptions& options, const T* strain)
      : model_(model), options_(options), volume_(sym6::trace(strain)) {
    for (int i = 0; i < 6; ++i) strain_[i] = strain[i];
    for (int i = 0; i < 6; ++i) plain_strain_[i] = value(strain[i]);
  }

  T stress[6];  // [Pa] before integrate: old; after: new
  T h[H];       // hardening variables, likewise

  /// False when no admissible state was found; stress and h are then undefined.
  KOKKOS_INLINE_FUNCTION bool integrate() {
    if (!admissible(stress, h)) return false;
    // A remapped state may lie outside its surface.
    if (value(model_.yield(stress, h)) > options_.yield_tolerance && !correct_drift(T(0.0))) return false;
    T trial[6];
    model_.elastic(stress, strain_, trial);
    const double f = value(model_.yield(trial, h));
    if (!(::fabs(f) < 1e200)) return false;  // also not a number
    if (f <= options_.yield_tolerance) {
      copy(trial, stress, 6);
      return admissible(stress, h);
    }
    const double crossing = find_crossing(f);
    if (crossing <= 0.0) return integrate_plastic(T(0.0));
    return integrate_plastic(advance_to_yield(crossing));
  }

 private:
  static KOKKOS_INLINE_FUNCTION void copy(const T* from, T* to, int n) {
    for (int i = 0; i < n; ++i) to[i] = from[i];
  }

  KOKKOS_INLINE_FUNCTION bool admissible(const T* sigma, const T* hardening) const {
    double s[6], x[H];
    for (int i = 0; i < 6; ++i) s[i] = value(sigma[i]);
    for (int i = 0; i < H; ++i) x[i] = value(hardening[i]);
    return model_.admissible(s, x);
  }

  /// Yield function after the elastic fraction t of the increment, values only.
  KOKKOS_INLINE_FUNCTION double elastic_yield(double t) const {
    double part[6], from[6], to[6], x[H];
    for (int i = 0; i < 6; ++i) part[i] = t * plain_strain_[i];
    for (int i = 0; i < 6; ++i) from[i] = value(stress[i]);
    for (int i = 0; i < H; ++i) x[i] = value(h[i]);
    model_.elastic(from, part, to);
    return model_.yield(to, x);
  }

  /// Rate of the yield function along the elastic path at stress `sigma` after the fraction t, values only;
  /// `size` is the product of the norms, for judging the angle.
  KOKKOS_INLINE_FUNCTION double elastic_yield_rate(const T* sigma, double t, double& size) const {
    double s[6], x[H], d[6];
    PlasticFlow<double, H> flow;
    for (int i = 0; i < 6; ++i) s[i] = value(sigma[i]);
    for (int i = 0; i < H; ++i) x[i] = value(h[i]);
    model_.flow(s, x, t * value(volume_), flow);
    sym6::isotropic(flow.bulk, flow.shear, plain_strain_, d);
    size = ::sqrt(sym6::norm_squared(flow.yield_gradient) * sym6::norm_squared(d));
    return sym6::work(d, flow.yield_gradient);
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

  /// Moves stress elastically to the crossing; returns the crossing with its derivative from f(t, strain) = 0.
  KOKKOS_INLINE_FUNCTION T advance_to_yield(double crossing) {
    T part[6], at[6];
    for (int i = 0; i < 6; ++i) part[i] = strain_[i] * crossing;
    model_.elastic(stress, part, at);
    const T f = model_.yield(at, h);
    double size;
    const double rate = elastic_yield_rate(at, crossing, size);
    T fraction(crossing);
    // A Newton step: it polishes the root and gives it its derivative. A grazing path has none.
    if (rate > 1e-10 * size) fraction -= f / rate;
    for (int i = 0; i < 6; ++i) part[i] = strain_[i] * fraction;
    model_.elastic(stress, part, at);
    copy(at, stress, 6);
    return fraction;
  }

  KOKKOS_INLINE_FUNCTION bool integrate_plastic(T time) {
    constexpr double smallest = 1e-8;
    T step = 1.0 - time, new_stress[6], new_h[H], error_squared;
    bool rejected = false;
    for (int attempt = 0; attempt < options_.maximum_substeps; ++attempt) {
      if (!modified_euler(time, step, new_stress, new_h, error_squared)) {
        step *= 0.25;
        rejected = true;
      } else if (!(value(error_squared) <= options_.stress_tolerance * options_.stress_tolerance)) {
        step *= step_factor(error_squared, 0.1, 1.0);
        rejected = true;
      } else {
        copy(new_stress, stress, 6);
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
    double s[6];
    for (int i = 0; i < 6; ++i) s[i] = value(stress[i]);
    return model_.exhausted(s);
  }

  /// 0.9 sqrt(tolerance/error) within bounds.
  KOKKOS_INLINE_FUNCTION T step_factor(const T& error_squared, double low, double high) const {
    const double target = 0.6561 * options_.stress_tolerance * options_.stress_tolerance;  // (0.9^4) tolerance^2
    const double raw = target / value(error_squared);                                      // factor^4
    if (!(raw < high * high * high * high)) return T(high);
    if (raw < low * low * low * low) return T(low);
    return square_root(square_root(target / error_squared));
  }

  /// One substep; false where the rates are undefined on the way.
  KOKKOS_INLINE_FUNCTION bool modified_euler(const T& time, const T& step, T* new_stress, T* new_h,
                                             T& error_squared) const {
    T s1[6], h1[H], s2[6], h2[H];
    if (!rates(stress, h, time, step, s1, h1)) return false;
    for (int i = 0; i < 6; ++i) new_stress[i] = stress[i] + s1[i];
    for (int i = 0; i < H; ++i) new_h[i] = h[i] + h1[i];
    if (!admissible(new_stress, new_h)) return false;
    if (!rates(new_stress, new_h, time + step, step, s2, h2)) return false;
    for (int i = 0; i < 6; ++i) new_stress[i] = stress[i] + 0.5 * (s1[i] + s2[i]);
    for (int i = 0; i < H; ++i) new_h[i] = h[i] + 0.5 * (h1[i] + h2[i]);
    if (!admissible(new_stress, new_h)) return false;
    for (int i = 0; i < 6; ++i) s2[i] -= s1[i];
    error_squared = sym6::norm_squared(s2) / (4.0 * sym6::norm_squared(new_stress));
    for (int i = 0; i < H; ++i) {
      const double scale = model_.hardening_scale(i, value(new_h[i]));
      const T e = (h2[i] - h1[i]) / (2.0 * scale);
      if (value(e) * value(e) > value(error_squared)) error_squared = e * e;
    }
    return true;
  }

  KOKKOS_INLINE_FUNCTION bool rates(const T* sigma, const T* hardening, const T& time, const T& step, T* d_stress,
                                    T* d_hardening) const {
    PlasticFlow<T, H> flow;
    T d[6], db[6], modulus;
    model_.flow(sigma, hardening, volume_ * time, flow);
    if (!plastic_modulus(flow, db, modulus)) return false;
    for (int i = 0; i < 6; ++i) d_stress[i] = strain_[i] * step;
    sym6::isotropic(flow.bulk, flow.shear, d_stress, d);
    T multiplier = sym6::work(d, flow.yield_gradient) / modulus;
    if (value(multiplier) < 0.0) multiplier = T(0.0);
    for (int i = 0; i < 6; ++i) d_stress[i] = d[i] - multiplier * db[i];
    for (int i = 0; i < H; ++i) d_hardening[i] = multiplier * flow.hardening_rate[i];
    return true;
  }

  /// D b and a.D b - df/dh.B; false where the latter is not positive (softening faster than elastic unloading).
  KOKKOS_INLINE_FUNCTION bool plastic_modulus(const PlasticFlow<T, H>& flow, T* db, T& modulus) const {
    const T* b = Model::associated ? flow.yield_gradient : flow.flow_direction;
    sym6::isotropic(flow.bulk, flow.shear, b, db);
    modulus = sym6::work(db, flow.yield_gradient);
    for (int i = 0; i < H; ++i) modulus -= flow.hardening_gradient[i] * flow.hardening_rate[i];
    return value(modulus) > 0.0;
  }

  /// Returns to the surface at fixed strain: dlambda = f/(a.D b - df/dh.B), or normal to it where that goes away from
  /// it.
  KOKKOS_INLINE_FUNCTION bool correct_drift(const T& time) {
    T f = model_.yield(stress, h);
    for (int iteration = 0; iteration < 30; ++iteration) {
      if (::fabs(value(f)) <= options_.yield_tolerance) return true;
      PlasticFlow<T, H> flow;
      T db[6], modulus, s[6], x[H];
      model_.flow(stress, h, volume_ * time, flow);
      bool consistent = plastic_modulus(flow, db, modulus);
      if (consistent) {
        const T multiplier = f / modulus;
        for (int i = 0; i < 6; ++i) s[i] = stress[i] - multiplier * db[i];
        for (int i = 0; i < H; ++i) x[i] = h[i] + multiplier * flow.hardening_rate[i];
        consistent = admissible(s, x) && ::fabs(value(model_.yield(s, x))) < ::fabs(value(f));
      }
      if (!consistent) {
        copy(h, x, H);
        for (int i = 0; i < 6; ++i) db[i] = flow.yield_gradient[i] * (i < 3 ? 1.0 : 0.5);  // the gradient as a tensor
        const T step = f / sym6::work(flow.yield_gradient, db);
        for (int i = 0; i < 6; ++i) s[i] = stress[i] - step * db[i];
        if (!admissible(s, x)) return false;
      }
      copy(s, stress, 6);
      copy(x, h, H);
      f = model_.yield(stress, h);
    }
    return false;
  }

  const Model& model_;
  const SubsteppingOptions& options_;
  T strain_[6], volume_;
  double plain_strain_[6];
};

/// d stress_i / d strain_j, row-major, from a stress that was computed with the strain as independent variables.
KOKKOS_INLINE_FUNCTION void write_tangent(const Dual<6>* stress, double* tangent) {
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) tangent[6 * i + j] = stress[i].d[j];
}
KOKKOS_INLINE_FUNCTION void write_tangent(const double*, double*) {}

}  // namespace mudline
