#pragma once

#include "materials/plastic_path.hpp"
#include "tensor/small_lu.hpp"

namespace mudline {

/// Backward Euler ("closest point projection"; Simo & Hughes 1998, Computational Inelasticity, ch. 3) for the models of
/// plastic_path.hpp. The unknowns are stress, hardening variables and multiplier at the end:
///     sigma = E(sigma_old, deps - dlambda b(sigma, h)),  h = h_old + dlambda B(sigma, h),  f(sigma, h) = 0
/// with the model's elastic law E. Where the start lies on the surface, a model that is `trapezoidal` uses the mean of
/// b and B at start and end, which makes the integration second-order accurate (Ortiz & Popov 1985, IJNME 21:1561). It
/// may have its own (for instance exponential) hardening law. Newton's method takes the derivatives of these equations
/// by dual numbers, so a model gives first derivatives only; each iterate must lower the residual. If it does not
/// converge, the increment is subdivided, within `maximum_substeps` attempts.
/// With T = Dual the solution is differentiated implicitly: one more evaluation with the strain as independent
/// variable, and one linear solve with the last matrix for each derivative index.
template <class T, class Model>
class ImplicitReturn : public PlasticPath<T, Model> {
 public:
  using PlasticPath<T, Model>::H;
  using PlasticPath<T, Model>::N;
  using PlasticPath<T, Model>::stress;
  using PlasticPath<T, Model>::h;

  KOKKOS_INLINE_FUNCTION ImplicitReturn(const Model& model, const IntegrationOptions& options, const T* strain)
      : PlasticPath<T, Model>(model, options, strain) {}

  /// False when no admissible state was found; stress and h are then undefined.
  KOKKOS_INLINE_FUNCTION bool integrate() {
    if (!this->prepare()) return false;
    double time = 0.0, step = 1.0;
    for (int attempt = 0; attempt < options_.maximum_substeps; ++attempt) {
      if (advance(time, step)) {
        time += step;
        if (time >= 1.0) return true;
        step = ::fmin(2.0 * step, 1.0 - time);
      } else {
        step *= 0.25;  // a power of two, so that time reaches 1 exactly
        if (step < 1e-8 || exhausted()) return false;
      }
    }
    return false;
  }

 private:
  using PlasticPath<T, Model>::model_;
  using PlasticPath<T, Model>::options_;
  using PlasticPath<T, Model>::strain_;
  using PlasticPath<T, Model>::volume_;
  using PlasticPath<T, Model>::copy;
  using PlasticPath<T, Model>::admissible;

  static constexpr int unknowns = N + H + 1;

  /// Whether the increment has cost so much that it is given up: a wild iterate of the global Newton method may ask for
  /// a strain that no number of substeps reaches.
  KOKKOS_INLINE_FUNCTION bool exhausted() const { return iterations_ >= 1000 + options_.maximum_substeps; }

  int iterations_ = 0;  // of Newton's method, over all attempts

  /// Data that are constant during one subincrement.
  template <class X>
  struct Start {
    X stress[N], h[H], strain[N], middle_volume, end_volume;
    X flow[N], hardening[H];  // half of b and of the hardening rates at the start; zero in backward Euler
    double weight;            // weight of flow and hardening at the end
  };
  struct Scales {
    double stress, h[H];
  };

  KOKKOS_INLINE_FUNCTION bool advance(double time, double step) {
    Start<T> start;
    copy(stress, start.stress, N);
    copy(h, start.h, H);
    for (int i = 0; i < N; ++i) start.strain[i] = step * strain_[i];
    start.middle_volume = (time + 0.5 * step) * volume_;
    start.end_volume = (time + step) * volume_;
    T trial[N];
    model_.elastic_step(start.stress, start.strain, start.middle_volume, trial);
    const double f = value(model_.yield(trial, h));
    if (!(::fabs(f) < 1e200) || !admissible(trial, h)) return false;
    if (f <= options_.yield_tolerance) {
      copy(trial, stress, N);
      return true;
    }
    begin_flow(start, time * volume_);
    ++this->substeps;
    double x[unknowns];
    Start<double> plain;
    plain.weight = start.weight;
    Scales scales;
    for (int i = 0; i < N; ++i) {
      x[i] = value(trial[i]);
      plain.stress[i] = value(stress[i]);
      plain.strain[i] = value(start.strain[i]);
      plain.flow[i] = value(start.flow[i]);
    }
    scales.stress = ::fmax(model_.space.largest(plain.stress), model_.space.largest(x));
    for (int i = 0; i < H; ++i) {
      x[N + i] = plain.h[i] = value(h[i]);
      plain.hardening[i] = value(start.hardening[i]);
      scales.h[i] = model_.hardening_scale(i, plain.h[i]);
    }
    plain.middle_volume = value(start.middle_volume);
    plain.end_volume = value(start.end_volume);
    x[unknowns - 1] = 0.0;
    SmallLu<unknowns> matrix;
    double guess[unknowns];
    copy_plain(x, guess, unknowns);
    if (cutting_planes(plain, guess) && iterate(plain, guess, matrix, scales)) {
      copy_plain(guess, x, unknowns);
    } else if (!iterate(plain, x, matrix, scales) && !follow(plain, x, matrix, scales)) {
      return false;
    }
    write(start, x, matrix, scales);
    return true;
  }

  /// Sets the contribution of the start to the flow. A start inside the surface does not contribute; the first-order
  /// error of that single increment does not accumulate.
  KOKKOS_INLINE_FUNCTION void begin_flow(Start<T>& start, const T& volume) const {
    constexpr double on_surface = 1e-7;
    start.weight = 1.0;
    for (int i = 0; i < N; ++i) start.flow[i] = T(0.0);
    for (int i = 0; i < H; ++i) start.hardening[i] = T(0.0);
    if constexpr (Model::trapezoidal) {
      if (value(model_.yield(start.stress, start.h)) < -on_surface) return;
      typename PlasticPath<T, Model>::template Flow<T> flow;
      model_.flow(start.stress, start.h, volume, flow);
      const T* b = Model::associated ? flow.yield_gradient : flow.flow_direction;
      start.weight = 0.5;
      for (int i = 0; i < N; ++i) start.flow[i] = 0.5 * b[i];
      for (int i = 0; i < H; ++i)
        start.hardening[i] = 0.5 * flow.hardening_rate[i] / model_.hardening_measure(i, start.h[i]);
    }
  }

  /// Residual of the equations, scaled to order one.
  template <class X, class S>
  KOKKOS_INLINE_FUNCTION void residual(const X* x, const Start<S>& start, const Scales& scales, X* r) const {
    typename PlasticPath<T, Model>::template Flow<X> flow;
    const X end_volume(start.end_volume), middle_volume(start.middle_volume);
    model_.flow(x, x + N, end_volume, flow);
    const X* b = Model::associated ? flow.yield_gradient : flow.flow_direction;
    const X& multiplier = x[unknowns - 1];
    X elastic[N], to[N];
    for (int i = 0; i < N; ++i) elastic[i] = start.strain[i] - multiplier * (start.weight * b[i] + start.flow[i]);
    model_.elastic_step(start.stress, elastic, middle_volume, to);
    for (int i = 0; i < N; ++i) r[i] = (x[i] - to[i]) / (scales.stress * model_.space.unit(i));
    for (int i = 0; i < H; ++i) {
      const X rate = start.weight * flow.hardening_rate[i] / model_.hardening_measure(i, x[N + i]) + start.hardening[i];
      r[N + i] = (x[N + i] - model_.hardened(i, start.h[i], multiplier * rate)) / scales.h[i];
    }
    r[unknowns - 1] = model_.yield(x, x + N);
  }

  KOKKOS_INLINE_FUNCTION bool evaluate(const double* x, const Start<double>& start, const Scales& scales,
                                       Dual<unknowns>* r, double& size) const {
    if (!model_.admissible(x, x + N)) return false;
    Dual<unknowns> y[unknowns];
    for (int i = 0; i < unknowns; ++i) y[i] = Dual<unknowns>(x[i], i);
    residual(y, start, scales, r);
    size = 0.0;
    for (int i = 0; i < unknowns; ++i) size += r[i].v * r[i].v;
    size = ::sqrt(size);
    return size < 1e200;  // not for a NaN
  }

  KOKKOS_INLINE_FUNCTION bool lowers(const double* x, const Start<double>& start, const Scales& scales, double fraction,
                                     double size) const {
    if (!model_.admissible(x, x + N)) return false;
    double r[unknowns], sum = 0.0;
    residual(x, start, scales, r);
    for (int i = 0; i < unknowns; ++i) sum += r[i] * r[i];
    return ::sqrt(sum) < (1.0 - 1e-3 * fraction) * size;
  }

  /// Cutting plane algorithm (Simo & Ortiz 1985, CMAME 49:221) from the trial stress towards the surface: a first guess
  /// for Newton's method, each plane as cheap as an explicit substep. False where it fails.
  KOKKOS_INLINE_FUNCTION bool cutting_planes(const Start<double>& start, double* x) const {
    constexpr int planes = 8;
    constexpr double near = 1e-2;
    for (int plane = 0; plane < planes; ++plane) {
      const double f = model_.yield(x, x + N);
      if (!(::fabs(f) < 1e200)) return false;
      if (::fabs(f) < near) return plane > 0;
      typename PlasticPath<T, Model>::template Flow<double> flow;
      model_.flow(x, x + N, start.end_volume, flow);
      double db[N];
      this->elastic(flow, x, Model::associated ? flow.yield_gradient : flow.flow_direction, db);
      double modulus = model_.space.work(db, flow.yield_gradient);
      for (int i = 0; i < H; ++i) modulus -= flow.hardening_gradient[i] * flow.hardening_rate[i];
      if (!(modulus > 0.0)) return false;
      const double multiplier = f / modulus;
      for (int i = 0; i < N; ++i) x[i] -= multiplier * db[i];
      for (int i = 0; i < H; ++i) x[N + i] += multiplier * flow.hardening_rate[i];
      x[unknowns - 1] += multiplier;
      if (!model_.admissible(x, x + N)) return false;
    }
    return false;
  }

  /// Newton's method. `matrix` returns the factorised derivative at the solution, up to the last tiny correction.
  KOKKOS_INLINE_FUNCTION bool iterate(const Start<double>& start, double* x, SmallLu<unknowns>& matrix,
                                      const Scales& scales) {
    Dual<unknowns> r[unknowns];
    double size;
    if (!evaluate(x, start, scales, r, size)) return false;
    for (int iteration = 0; iteration < 30; ++iteration) {
      if (exhausted()) return false;
      ++iterations_;
      double step[unknowns];
      for (int i = 0; i < unknowns; ++i) {
        step[i] = -r[i].v;
        for (int j = 0; j < unknowns; ++j) matrix.a[i][j] = r[i].d[j];
      }
      if (!matrix.factorise()) return false;
      matrix.solve(step);
      if (size < 1e-9) {  // the last correction reduces it to rounding
        for (int i = 0; i < unknowns; ++i) x[i] += step[i];
        return x[unknowns - 1] >= 0.0 && model_.admissible(x, x + N);
      }
      double y[unknowns], fraction = 1.0, new_size;
      bool lower = false;
      for (int cut = 0; cut < 7; ++cut, fraction *= 0.5) {
        for (int i = 0; i < unknowns; ++i) y[i] = x[i] + fraction * step[i];
        // shorter steps are tried without derivatives first, at a fraction of the cost
        lower = (cut == 0 || lowers(y, start, scales, fraction, size)) && evaluate(y, start, scales, r, new_size) &&
                new_size < (1.0 - 1e-3 * fraction) * size;
        if (lower) break;
      }
      if (!lower) return false;
      copy_plain(y, x, unknowns);
      size = new_size;
    }
    return false;
  }

  /// Continuation method where Newton's method fails from the trial stress: solves for growing parts of the strain
  /// increment, each starting from the solution of the one before. It ends at the same solution as iterate(), so the
  /// result does not jump between the two methods.
  KOKKOS_INLINE_FUNCTION bool follow(const Start<double>& start, double* x, SmallLu<unknowns>& matrix,
                                     const Scales& scales) {
    Start<double> part = start;
    double y[unknowns], done = 0.0, step = 0.25;
    copy_plain(start.stress, x, N);
    copy_plain(start.h, x + N, H);
    x[unknowns - 1] = 0.0;
    for (int attempt = 0; attempt < 120; ++attempt) {
      if (!(done < 1.0 && step > 1e-10) || exhausted()) break;
      for (int i = 0; i < N; ++i) part.strain[i] = (done + step) * start.strain[i];
      model_.elastic_step(part.stress, part.strain, part.middle_volume, y);
      copy_plain(start.h, y + N, H);
      bool ok = model_.admissible(y, y + N);
      if (ok && model_.yield(y, y + N) > options_.yield_tolerance) {
        if (x[unknowns - 1] > 0.0) {
          copy_plain(x, y, unknowns);
          y[unknowns - 1] *= (done + step) / done;  // far outside, the flow goes on in its direction
        } else {
          y[unknowns - 1] = 0.0;
        }
        ok = iterate(part, y, matrix, scales);
      } else {
        y[unknowns - 1] = 0.0;
      }
      if (ok) {
        copy_plain(y, x, unknowns);
        done += step;
        step = ::fmin(2.0 * step, 1.0 - done);
      } else {
        step *= 0.5;
      }
    }
    return done >= 1.0;
  }

  static KOKKOS_INLINE_FUNCTION void copy_plain(const double* from, double* to, int n) {
    for (int i = 0; i < n; ++i) to[i] = from[i];
  }

  /// Stores the solution, with derivatives where T has them: (dR/dx) dx = -dR/d(strain).
  KOKKOS_INLINE_FUNCTION void write(const Start<T>& start, const double* x, const SmallLu<unknowns>& matrix,
                                    const Scales& scales) {
    T y[unknowns];
    for (int i = 0; i < unknowns; ++i) y[i] = T(x[i]);
    if constexpr (!std::is_same_v<T, double>) {
      T r[unknowns];
      residual(y, start, scales, r);
      constexpr int directions = sizeof(r[0].d) / sizeof(double);
      for (int j = 0; j < directions; ++j) {
        double column[unknowns];
        for (int i = 0; i < unknowns; ++i) column[i] = -r[i].d[j];
        matrix.solve(column);
        for (int i = 0; i < unknowns; ++i) y[i].d[j] = column[i];
      }
    }
    copy(y, stress, N);
    copy(y + N, h, H);
  }
};

}  // namespace mudline
