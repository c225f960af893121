#pragma once

#include "materials/automatic_tangent.hpp"
#include "materials/embedded_steps.hpp"
#include "materials/pressure_floor.hpp"

namespace mudline {

/// Hypoplastic sand of von Wolffersdorff (1996, Mech. Cohesive-Frictional Materials 1:251) with the intergranular
/// strain of Niemunis and Herle (1997, same journal 2:279). Stress T and stretching D are tension positive, That = T/tr
/// T, p = -tr T/3, and That* is the deviator of That:
///     rate        dT = L:D + N |D|
///     linear      L = fb fe/(That:That) (F^2 I + a^2 That That)
///     other       N = fd fb fe F a/(That:That) (That + That*)
///     angle       a = sqrt(3)(3 - sin phi)/(2 sqrt(2) sin phi)
///     shape       F = sqrt(t^2/8 + (2 - t^2)/(2 + sqrt(2) t c)) - t/(2 sqrt(2)), t = sqrt(3)|That*|,
///                 c = cos 3theta = -sqrt(6) tr(That*^3)/tr(That*^2)^(3/2), -1 in triaxial compression
///     voids       ei/ei0 = ec/ec0 = ed/ed0 = exp(-(3p/hs)^n), fe = (ec/e)^beta, fd = ((e - ed)/(ec - ed))^alpha
///     pressure    fb = hs/n (ei0/ec0)^beta (1 + ei)/ei (3p/hs)^(1-n) / (3 + a^2 - a sqrt(3) ((ei0 - ed0)/(ec0 -
///     ed0))^alpha)
/// With intergranular strain h, rho = |h|/R, u = h/|h| and r = rho^chi:
///     dT = [r mT + (1 - r) mR] L:D + r (1 - mT) (L:u)(u:D) + r N (u:D)     where u:D > 0
///     dT = [r mT + (1 - r) mR] L:D + r (mR - mT) (L:u)(u:D)                elsewhere
///     dh = D - rho^betar u (u:D)                                           where u:D > 0, dh = D elsewhere
/// The void ratio follows the volume strain, 1 + e = (1 + e0) exp(tr eps).
///
/// What the papers leave open: T is the effective stress less a `pressure shift`, and starts from where return_start()
/// brings it; e stays within ed and ei in the factors; fd is linear in e - ed where that is less than 1e-4 (ec - ed),
/// for its slope is infinite at ed; F falls to zero from t = sqrt(2), where a principal stress is zero, to sqrt(2) +
/// 0.1; between twice the minimum mean stress and that stress the fall of p dies away, so that p stays above it.
///
/// Integration: embedded_steps.hpp over the strain increment, with control of the error. Code: tension positive, [Pa].
struct Hypoplasticity {
  static constexpr bool hardens_with_volume = true;
  enum { intergranular_strain, state_size = 6 };

  double friction = 30.0;                                 // [deg] phi, critical
  double hardness = 1e9;                                  // [Pa] hs
  double compression_exponent = 0.3;                      // [-] n
  double densest = 0.5, critical = 0.8, loosest = 0.9;    // [-] ed0, ec0, ei0
  double peak_exponent = 0.1, stiffness_exponent = 1.0;   // [-] alpha, beta
  double reversal = 1.0, turn = 1.0;                      // [-] mR, mT
  double range = 0.0;                                     // [-] R; 0: no intergranular strain
  double evolution_exponent = 1.0, decay_exponent = 1.0;  // [-] betar, chi
  double shift = 0.0;                                     // [Pa] that makes T of the effective stress
  double minimum_mean_stress = 10.0;                      // [Pa] of T
  double tolerance = 1e-6;                                // [-] relative error of one step
  int maximum_substeps = 10000;                           // attempts per increment

  void parameters(Parameters& p);
  void check(const Section& section) const;
  /// Computes constants from the parameters.
  void prepare();
  static std::vector<StateVariable> state();
  /// Refuses tensile principal stresses of T, a p below the minimum, and a void ratio outside ed to ei.
  std::string initialise(const InitialPoint& point, double* state) const;
  /// (1 - sin phi) R^sin phi, at most the passive ratio (Jaky 1944; Mayne & Kulhawy 1982).
  double k0(double overconsolidation_ratio) const;
  /// Earth pressures at the critical friction angle; the pressure shift is a cohesion.
  EarthPressures earth_pressures(double vertical, double) const;
  /// The isotropic part of L at an isotropic stress of the same p, times mR.
  KOKKOS_INLINE_FUNCTION ElasticModuli moduli(const double* stress, double void_ratio, const double*) const {
    const double p = ::fmax(sym6::mean_pressure(stress) + shift, minimum_mean_stress);
    const double f = factors(p, void_ratio).stiffness * (range > 0.0 ? reversal : 1.0);
    return {f * (1.0 + a2_ / 3.0), 1.5 * f};
  }
  template <class T>
  KOKKOS_INLINE_FUNCTION bool update(const SkeletonPoint& in, const T* strain, const double* state_old, T* stress,
                                     double* state) const;

  /// Brings a stress T that no path of the law reaches, as a transfer to another mesh may leave it, back: p below half
  /// of its minimum to that, and where t is above `most_shear`, at which F is long zero, the deviator to the size at
  /// which the largest principal stress is zero.
  KOKKOS_INLINE_FUNCTION void return_start(double* stress) const;
  static constexpr double most_shear = 1.6142135623730951;  // [-] of t, sqrt(2) + 0.2

  /// What density and pressure make of the rates.
  template <class T>
  struct Factors {
    T stiffness;  // [Pa] fb fe
    T density;    // [-] fd
  };
  template <class T>
  KOKKOS_INLINE_FUNCTION Factors<T> factors(const T& p, const T& void_ratio) const;

  /// L and N at one stress, as products with a tensor.
  template <class T>
  struct Operators {
    T direction[6];    // That
    T square, linear;  // a^2 and F^2 of L, times fb fe/(That:That)
    T along[6];        // N
    KOKKOS_INLINE_FUNCTION void apply(const T* d, T* out) const {
      T product = direction[0] * d[0];
      for (int i = 1; i < 6; ++i) product += (i < 3 ? 1.0 : 2.0) * direction[i] * d[i];
      product *= square;
      for (int i = 0; i < 6; ++i) out[i] = linear * d[i] + product * direction[i];
    }
  };
  template <class T>
  KOKKOS_INLINE_FUNCTION Operators<T> operators(const T* stress, const T& p, const T& void_ratio) const;
  /// F at the deviator of That.
  template <class T>
  KOKKOS_INLINE_FUNCTION static T shape(const T* deviator);
  /// Whether p is where the equations have finite numbers.
  KOKKOS_INLINE_FUNCTION bool admissible(double p) const {
    return p > 0.25 * minimum_mean_stress && p < 30.0 * hardness;
  }

 private:
  double a_ = 1.0, a2_ = 1.0;   // [-] a and its square
  double pressure_factor_ = 0;  // [Pa] of fb, all that does not depend on the state
};

/// The rates over one increment of strain (a tensor), for EmbeddedSteps: y is the stress T, then the intergranular
/// strain.
template <class T>
class HypoplasticPath {
 public:
  static constexpr int size = 12;

  KOKKOS_INLINE_FUNCTION HypoplasticPath(const Hypoplasticity& law, const T* strain, double void_ratio)
      : law_(law), volume_(sym6::trace(strain)), specific_volume_(1.0 + void_ratio) {
    for (int i = 0; i < 6; ++i) strain_[i] = i < 3 ? strain[i] : 0.5 * strain[i];
    size_ = norm(strain_);
  }
  /// A change of stress that goes with the error of third order.
  KOKKOS_INLINE_FUNCTION T first_step(const T* y, const T* dy) const {
    const T change = norm(dy), most = norm(y) * ::cbrt(law_.tolerance);
    return value(change) > value(most) ? most / change : T(1.0);
  }
  /// The intergranular strain tends to R D/|D| at rates up to |D|/R; the pair of methods is stable to 2.5 over that.
  KOKKOS_INLINE_FUNCTION T largest_step(const T& s, const T* y) const {
    if (!(law_.range > 0.0) || settled(value(s), y + 6)) return T(1.0);
    const double reach = law_.range / ::fmax(1.0, law_.evolution_exponent);
    return value(size_) > reach ? reach / size_ : T(1.0);
  }
  KOKKOS_INLINE_FUNCTION bool rates(const T& s, const T* y, T* dy) const {
    const T p = sym6::mean_pressure(y);
    if (!law_.admissible(value(p))) return false;
    const T e = specific_volume_ * exponential(s * volume_) - 1.0;
    const auto op = law_.operators(y, p, e);
    if (law_.range > 0.0 && !settled(value(s), y + 6))
      with_intergranular_strain(op, y + 6, dy);
    else
      without(op, dy);
    limit_fall(p, law_.minimum_mean_stress, dy);
    return true;
  }
  KOKKOS_INLINE_FUNCTION T error_squared(const T* y, const T* error) const {
    const double floor = law_.minimum_mean_stress;
    T stress = sym6::norm_squared(y);
    if (value(stress) < floor * floor) stress = T(floor * floor);
    const double tolerance = 1.0 / (law_.tolerance * law_.tolerance);
    const T of_stress = sym6::norm_squared(error) / stress * tolerance;
    if (!(law_.range > 0.0)) return of_stress;
    const double measure = 10.0 * law_.range;  // an error of the stress of about that part comes of it
    const T of_strain = sym6::norm_squared(error + 6) * (tolerance / (measure * measure));
    return value(of_strain) > value(of_stress) ? of_strain : of_stress;
  }

 private:
  KOKKOS_INLINE_FUNCTION static T norm(const T* tensor) {
    const T square = sym6::norm_squared(tensor);
    return value(square) > 0.0 ? square_root(square) : T(0.0);
  }
  /// Whether the intergranular strain is so near to R D/|D| that it changes no more, nor with the direction of D: that
  /// dies away as exp(-s |D|/R). The limit is no multiple of a substep of R.
  KOKKOS_INLINE_FUNCTION bool settled(double s, const T* h) const {
    double distance[6];
    if (!(s * value(size_) > 20.5 * law_.range)) return false;
    for (int i = 0; i < 6; ++i) distance[i] = value(h[i]) / law_.range - value(strain_[i]) / value(size_);
    return sym6::norm_squared(distance) < 1e-16;
  }
  KOKKOS_INLINE_FUNCTION void without(const typename Hypoplasticity::Operators<T>& op, T* dy) const {
    op.apply(strain_, dy);
    for (int i = 0; i < 6; ++i) {
      dy[i] += op.along[i] * size_;
      dy[i + 6] = T(0.0);
    }
  }
  KOKKOS_INLINE_FUNCTION void with_intergranular_strain(const typename Hypoplasticity::Operators<T>& op, const T* h,
                                                        T* dy) const {
    const T length = norm(h);
    T u[6], along(0.0), share(0.0), evolution(0.0);  // u:D, rho^chi, rho^betar
    for (int i = 0; i < 6; ++i) u[i] = T(0.0);
    if (value(length) > 1e-12 * law_.range) {
      for (int i = 0; i < 6; ++i) u[i] = h[i] / length;
      for (int i = 0; i < 6; ++i) along += (i < 3 ? 1.0 : 2.0) * u[i] * strain_[i];
      const T rho = length / law_.range;
      share = value(rho) < 1.0 ? power(rho, law_.decay_exponent) : T(1.0);
      evolution = power(rho, law_.evolution_exponent);
    }
    const bool onward = value(along) > 0.0;
    const T all = share * law_.turn + (1.0 - share) * law_.reversal;
    const T more = share * along * (onward ? 1.0 - law_.turn : law_.reversal - law_.turn);
    T d[6];
    for (int i = 0; i < 6; ++i) d[i] = all * strain_[i] + more * u[i];
    op.apply(d, dy);
    for (int i = 0; i < 6; ++i) dy[i + 6] = strain_[i];
    if (!onward) return;
    const T slip = share * along, fade = evolution * along;
    for (int i = 0; i < 6; ++i) {
      dy[i] += slip * op.along[i];
      dy[i + 6] -= fade * u[i];
    }
  }

  const Hypoplasticity& law_;
  T strain_[6], volume_, size_;
  double specific_volume_;
};

template <class T>
KOKKOS_INLINE_FUNCTION Hypoplasticity::Factors<T> Hypoplasticity::factors(const T& p, const T& void_ratio) const {
  const T x = p * (3.0 / hardness), y = power(x, compression_exponent), compressed = exponential(-1.0 * y);
  const T ed = densest * compressed, ec = critical * compressed, ei = loosest * compressed;
  const T e = value(void_ratio) > value(ei) ? ei : value(void_ratio) < value(ed) ? ed : void_ratio;
  const T fb = pressure_factor_ * (1.0 + ei) / ei * x / y, fe = power(ec / e, stiffness_exponent);
  constexpr double edge = 1e-4;  // below this fd is linear
  const T density = (e - ed) / (ec - ed);
  const T fd = value(density) > edge ? power(density, peak_exponent) : density * ::pow(edge, peak_exponent - 1.0);
  return {fb * fe, fd};
}

template <class T>
KOKKOS_INLINE_FUNCTION T Hypoplasticity::shape(const T* deviator) {
  constexpr double root2 = 1.4142135623730951, fade = 0.1;
  const T square = sym6::norm_squared(deviator);
  if (value(square) < 1e-24) return T(1.0);
  const T length = square_root(square);
  T cosine = sym6::determinant(deviator) / (square * length) * (-3.0 * ::sqrt(6.0));
  if (!(::fabs(value(cosine)) < 1.0)) cosine = T(value(cosine) > 0.0 ? 1.0 : -1.0);
  const T tangent = length * ::sqrt(3.0);
  const double most = 0.999 * root2;
  const T t = value(tangent) < most ? tangent : T(most);
  const T inside = t * t * 0.125 + (2.0 - t * t) / (2.0 + root2 * t * cosine);
  const T f = square_root(inside) - t * (0.5 / root2);
  if (!(value(tangent) > root2)) return f;
  return value(tangent) < root2 + fade ? f * (1.0 - (tangent - root2) / fade) : T(0.0);
}

template <class T>
KOKKOS_INLINE_FUNCTION Hypoplasticity::Operators<T> Hypoplasticity::operators(const T* stress, const T& p,
                                                                              const T& void_ratio) const {
  Operators<T> r;
  const T scale = -1.0 / (3.0 * p);  // 1/tr T
  for (int i = 0; i < 6; ++i) r.direction[i] = stress[i] * scale;
  T deviator[6];
  for (int i = 0; i < 6; ++i) deviator[i] = i < 3 ? r.direction[i] - 1.0 / 3.0 : r.direction[i];
  const T f = shape(deviator);
  const Factors<T> with = factors(p, void_ratio);
  const T stiffness = with.stiffness / sym6::norm_squared(r.direction);
  r.linear = stiffness * f * f;
  r.square = stiffness * a2_;
  const T n = with.density * stiffness * f * a_;
  for (int i = 0; i < 6; ++i) r.along[i] = n * (r.direction[i] + deviator[i]);
  return r;
}

KOKKOS_INLINE_FUNCTION void Hypoplasticity::return_start(double* stress) const {
  double p = sym6::mean_pressure(stress);
  const double raise = p < 0.5 * minimum_mean_stress ? minimum_mean_stress - p : 0.0;
  for (int i = 0; i < 3; ++i) stress[i] -= raise;
  p += raise;
  double deviator[6], principal[3];
  sym6::deviator(stress, deviator);
  const double t = ::sqrt(3.0 * sym6::norm_squared(deviator)) / (3.0 * p);
  if (!(t > most_shear)) return;
  sym6::principal_values(stress, principal);
  const double kept = p / (principal[0] + p);
  for (int i = 0; i < 6; ++i) stress[i] = kept * deviator[i] - (i < 3 ? p : 0.0);
}

template <class T>
KOKKOS_INLINE_FUNCTION bool Hypoplasticity::update(const SkeletonPoint& in, const T* strain, const double* state_old,
                                                   T* stress, double* state) const {
  T y[HypoplasticPath<T>::size];
  double start[6];
  for (int i = 0; i < 6; ++i) start[i] = in.stress[i] - (i < 3 ? shift : 0.0);
  return_start(start);
  for (int i = 0; i < 6; ++i) {
    y[i] = T(start[i]);
    y[i + 6] = T(state_old[i]);
  }
  const HypoplasticPath<T> path(*this, strain, in.void_ratio);
  EmbeddedSteps<T, HypoplasticPath<T>::size, HypoplasticPath<T>> steps(path);
  if (!steps.integrate(y, maximum_substeps)) return false;
  for (int i = 0; i < 6; ++i) {
    stress[i] = i < 3 ? y[i] + shift : y[i];
    state[i] = value(y[i + 6]);
  }
  return true;
}

// Compiled once, in the source of the law.
extern template class PointwiseSkeleton<AutomaticTangent<Hypoplasticity>>;

}  // namespace mudline
