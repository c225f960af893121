#pragma once

#include "materials/pressure_floor.hpp"
#include "materials/skeleton/modified_cam_clay.hpp"

namespace mudline {

struct SClay1sModel;

/// Natural clay: Modified Cam Clay with three parts, each switched on by its numbers.
///     fabric    the yield surface is inclined and turns with plastic strain: S-CLAY1 (Wheeler, Naatanen, Karstunen &
///               Lojander 2003, Canadian Geotechnical Journal 40:403)
///     bonding   the surface is larger than that of the remoulded clay, and plastic strain breaks the bonds: S-CLAY1S
///               (Karstunen, Krenn, Wheeler, Koskinen & Zentar 2005, Int. J. Geomech. 5:87)
///     creep     in place of plastic strain there is viscous strain at every stress: Creep-SCLAY1S (Sivasithamparam,
///               Karstunen & Bonnier 2015, Computers and Geotechnics 69:46)
/// Compression positive in these equations; s is the deviator of the effective stress, a the fabric (a deviator, per
/// p'), A^2 = 3/2 a:a, and v = 1 + e.
///     size          F = p' + 3/2 (s - p' a):(s - p' a)/((M^2 - A^2) p'), the p' at the tip of the ellipse through the
///                   stress; M = M(S) at the Lode measure S of s - p' a, by the option of Modified Cam Clay
///     surface       F = pm with pm = (1 + chi) pi, pi the size of the remoulded clay, associated
///     hardening     dpi = pi v/(lambda - kappa) dev
///     fabric        da = omega [(3/4 s/p' - a) <dev> + omega_d (1/3 s/p' - a) des]
///     bonding       dchi = -xi chi (|dev| + xi_d des)
/// dev and des are volume strain and shear strain sqrt(2/3 e:e) of the plastic strain increment, or of the creep:
///     creep         de/dt = mu/(v tau) (F/pm)^((lambda - kappa)/mu) (M^2 - A0^2)/(M^2 - eta0^2) dF/dsigma
/// with eta0 and A0 of one-dimensional virgin compression, where the volume rate at F = pm is mu/(v tau).
/// The papers derive the following from M with K0 = 1 - sin phi, sin phi = 3M/(6 + M), eta0 = 3(1 - K0)/(1 + 2 K0):
///     inclination   A0 = (eta0^2 + 3 eta0 - M^2)/3
///     shear weight  omega_d = 3/8 (4M^2 - 4 eta0^2 - 3 eta0)/(eta0^2 - M^2 + 2 eta0)
///
/// Integration: the plastic parts by substepping.hpp or implicit_return.hpp, creep by embedded_steps.hpp with the
/// strain at a constant rate over the increment. An increment without time (dt = 0) has no creep. Code: tension
/// positive, [Pa]; the fabric is stored like a stress over p', so that it lies along the stress that formed it.
struct SClay1s {
  static constexpr bool hardens_with_volume = true, small_strain = true;
  enum class Axis { stress, x, y, z };
  enum { preconsolidation, plastic_shear_strain, initial_specific_volume, bonding, fabric, state_size = fabric + 6 };
  /// Hardening variables of the integration: pi, plastic shear strain, chi, then the fabric.
  static constexpr int hardening = 9, chi = 2, alpha = 3;

  ModifiedCamClay clay;            // lambda is that of the remoulded clay
  double rotation = 0.0;           // [-] omega; 0: no fabric
  double shear_weight = 0.0;       // [-] omega_d; 0: that of the papers
  double inclination = 0.0;        // [-] A at the start; 0: A0
  Axis axis = Axis::stress;        // direction of the fabric at the start
  double initial_bonding = 0.0;    // [-] chi at the start; 0: no bonding
  double degradation = 0.0;        // [-] xi
  double degradation_shear = 0.0;  // [-] xi_d
  double creep_slope = 0.0;        // [-] mu, slope of e over ln t; 0: no creep
  double reference_time = 86400;   // [s] tau

  void parameters(Parameters& p);
  void check(const Section& section) const;
  void prepare();
  static std::vector<StateVariable> state();
  /// pi = R F/(1 + chi), the surface through the initial stress times the overconsolidation ratio R; or from the void
  /// ratio, as in Modified Cam Clay, where a line of normal compression is given: that of the remoulded clay.
  std::string initialise(const InitialPoint& point, double* state) const;
  double void_ratio(const InitialPoint& point) const;
  /// With a fabric 1 - sin phi times R^(sin phi), else that of Modified Cam Clay.
  double k0(double overconsolidation_ratio) const;
  /// With a part switched on pm/F alone, for the strength depends on path and rate.
  SoilState soil_state(const double* stress, double void_ratio, const double* state) const;
  EarthPressures earth_pressures(double vertical, double height) const {
    return clay.earth_pressures(vertical, height);
  }
  KOKKOS_INLINE_FUNCTION ElasticModuli moduli(const double* stress, double void_ratio, const double* state) const {
    return clay.moduli(stress, void_ratio, state);
  }
  KOKKOS_INLINE_FUNCTION bool plain() const {
    return !(rotation > 0.0) && !(initial_bonding > 0.0) && !(creep_slope > 0.0);
  }
  template <class T>
  KOKKOS_INLINE_FUNCTION bool update(const SkeletonPoint& in, const T* strain, const double* state_old, T* stress,
                                     double* state) const;

  /// F of a stress [Pa].
  double size(const double* stress, const double* fabric) const;
  /// Whether stress and fabric leave room for an ellipse.
  KOKKOS_INLINE_FUNCTION bool admissible(double p, const double* h) const {
    return p > 0.0 && h[0] > 0.0 && 1.5 * sym6::norm_squared(h + alpha) < 0.99 * weakest_;
  }
  /// Inclination that the fabric does not exceed: the critical stress ratio in extension less a margin, for a steeper
  /// surface has no room. The papers leave this open.
  KOKKOS_INLINE_FUNCTION double largest_inclination() const { return ::sqrt(0.95 * weakest_); }
  /// omega_d.
  KOKKOS_INLINE_FUNCTION double weight() const { return weight_; }
  /// mu/tau times the factor of virgin compression [1/s], and the exponent of F/pm.
  KOKKOS_INLINE_FUNCTION double creep_rate() const { return creep_rate_; }
  KOKKOS_INLINE_FUNCTION double creep_exponent() const { return (clay.compression - clay.swelling) / creep_slope; }
  /// A0 and omega_d of the papers for M; the latter may be negative where M is small or large.
  double virgin_inclination() const;
  double virgin_weight() const;

 private:
  /// Writes the fabric of the start. Returns "" or why there is none.
  std::string start_fabric(const double* stress, double* fabric) const;
  /// Where p' is below the minimum of Modified Cam Clay: sets it there, with r inside the surface, and returns true.
  KOKKOS_INLINE_FUNCTION bool raise_to_minimum(double* stress, double* h) const;
  template <class T>
  KOKKOS_INLINE_FUNCTION bool creep(const SClay1sModel& model, double duration, const T* strain, T* stress, T* h) const;

  double weakest_ = 1.0;     // [-] smallest M(S)^2
  double weight_ = 0.0;      // [-] omega_d
  double start_ = 0.0;       // [-] A at the start
  double creep_rate_ = 0.0;  // [1/s]
};

/// The ellipse through a stress, for a fabric.
template <class T>
struct InclinedEllipse {
  T p, s[6];     // [Pa] p' and deviator
  T shear;       // [Pa2] 3/2 r:r/(M^2 - A^2), r = s - p' a
  T along[6];    // [Pa] its derivative by r, a strain
  T per_fabric;  // [Pa2] its derivative by the fabric at fixed r is this times a
  T volume;      // [Pa] d(p' F)/dp' at fixed s

  /// `factor` times the derivative of p' (F - size) by the stress, a strain.
  KOKKOS_INLINE_FUNCTION void gradient(const T& factor, const T& size, T* out) const {
    const T third = (volume - size) * (1.0 / 3.0);
    for (int i = 0; i < 6; ++i) out[i] = factor * (i < 3 ? along[i] - third : along[i]);
  }
};

/// The rate-independent law for stress integration over one increment. f = p' (F - pm) times a scale.
struct SClay1sModel : ModifiedCamClayModel<SixComponents> {
  using CamClay = ModifiedCamClayModel<SixComponents>;
  static constexpr int hardening = SClay1s::hardening, chi = SClay1s::chi, alpha = SClay1s::alpha;

  const SClay1s& clay;

  KOKKOS_INLINE_FUNCTION SClay1sModel(const SClay1s& l, double specific_volume, double size)
      : CamClay(l.clay, SixComponents(), specific_volume, size), clay(l) {}

  template <class T>
  KOKKOS_INLINE_FUNCTION void evaluate(const T* stress, const T* fabric, InclinedEllipse<T>& at) const {
    at.p = sym6::deviator(stress, at.s);
    T r[6], cubic[6];
    for (int i = 0; i < 6; ++i) r[i] = at.s[i] - at.p * fabric[i];
    const T square = 1.5 * sym6::norm_squared(r), incline = 1.5 * sym6::norm_squared(fabric);
    T room = 1.0 / inverse_m2 - incline, factor(3.0);
    const bool lode = has_lode(value(square));
    if (lode) {  // d(shear) = ((1 - 3/2 k S) d(r:r) 3/2 + 27/2 k dJ3/|r|)/room with k = M^2 w'/(w^2 room)
      const T length = square_root(square), measure = 13.5 * sym6::determinant(r) / (square * length);
      T slope;
      const T w = shape(measure, slope);
      room = 1.0 / (inverse_m2 * w) - incline;
      const T k = slope / (inverse_m2 * w * w * room);
      factor = 3.0 * (1.0 - 1.5 * k * measure);
      sym6::determinant_gradient(r, square, cubic);
      const T across = 13.5 * k / (length * room);
      for (int i = 0; i < 6; ++i) cubic[i] *= across;
    }
    at.shear = square / room;
    factor /= room;
    at.volume = 2.0 * at.p;
    for (int i = 0; i < 6; ++i) {
      at.along[i] = (i < 3 ? 1.0 : 2.0) * factor * r[i];
      if (lode) at.along[i] += cubic[i];
      at.volume -= fabric[i] * at.along[i];
    }
    at.per_fabric = 3.0 * at.shear / room;
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION T yield(const T* stress, const T* h) const {
    InclinedEllipse<T> at;
    evaluate(stress, h + alpha, at);
    return scale * (at.p * (at.p - (1.0 + h[chi]) * h[0]) + at.shear);
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION void flow(const T* stress, const T* h, const T& volume_strain,
                                   PlasticFlow<T, hardening>& out) const {
    InclinedEllipse<T> at;
    evaluate(stress, h + alpha, at);
    const T v = specific_volume(volume_strain);
    elastic_moduli(at.s, at.p, v, out.bulk, out.shear, out.coupling);
    at.gradient(T(scale), (1.0 + h[chi]) * h[0], out.yield_gradient);
    out.hardening_gradient[0] = -scale * at.p * (1.0 + h[chi]);
    out.hardening_gradient[1] = T(0.0);
    out.hardening_gradient[chi] = -scale * at.p * h[0];
    for (int i = 0; i < 6; ++i)
      out.hardening_gradient[alpha + i] =
          scale * ((i < 3 ? 1.0 : 2.0) * at.per_fabric * h[alpha + i] - at.p * at.along[i]);
    harden(at, h, out.yield_gradient, v, out.hardening_rate);
  }

  /// Rates of the hardening variables for a rate g of the plastic strain.
  template <class T>
  KOKKOS_INLINE_FUNCTION void harden(const InclinedEllipse<T>& at, const T* h, const T* g, const T& v, T* rate) const {
    const T volume = -1.0 * sym6::trace(g), third = volume * (1.0 / 3.0);
    T square(0.0), shear(0.0);
    for (int i = 0; i < 3; ++i) square += (g[i] + third) * (g[i] + third) + 0.5 * g[i + 3] * g[i + 3];
    if (value(square) > 1e-24 * value(volume) * value(volume) && value(square) > 0.0)
      shear = square_root((2.0 / 3.0) * square);
    const T size = value(volume) < 0.0 ? -1.0 * volume : volume;
    rate[0] = h[0] * v * volume * (1.0 / (law.compression - law.swelling));
    rate[1] = shear;
    rate[chi] = -clay.degradation * h[chi] * (size + clay.degradation_shear * shear);
    const T compressed = value(volume) > 0.0 ? volume : T(0.0), sheared = clay.weight() * shear;
    const T to = clay.rotation * (compressed * leaning(at, 0.75) + sheared * leaning(at, 1.0 / 3.0)),
            fading = clay.rotation * (compressed + sheared);
    for (int i = 0; i < 6; ++i) rate[alpha + i] = to * at.s[i] - fading * h[alpha + i];
  }

  /// The fabric that strain tends to is this times the deviator: a fraction of s/p', within the largest inclination.
  template <class T>
  KOKKOS_INLINE_FUNCTION T leaning(const InclinedEllipse<T>& at, double fraction) const {
    const T square = 1.5 * fraction * fraction * sym6::norm_squared(at.s);
    const double most = clay.largest_inclination();
    if (value(square) <= most * most * value(at.p) * value(at.p)) return fraction / at.p;
    return fraction * most / square_root(square);
  }

  KOKKOS_INLINE_FUNCTION bool admissible(const double* stress, const double* h) const {
    return clay.admissible(sym6::mean_pressure(stress), h);
  }
  KOKKOS_INLINE_FUNCTION double hardening_scale(int i, double h) const {
    return i == 0 ? h : i == chi ? ::fmax(1.0, h) : 1.0;
  }
};

/// The rates of the viscous law over one increment, for EmbeddedSteps: y is the stress, then the hardening variables.
template <class T>
class IsotachePath {
 public:
  static constexpr int size = 6 + SClay1s::hardening;

  KOKKOS_INLINE_FUNCTION IsotachePath(const SClay1sModel& model, const T* strain, double duration)
      : model_(model), strain_(strain), volume_(sym6::trace(strain)), duration_(duration) {}

  /// A change of stress that goes with the error of third order.
  KOKKOS_INLINE_FUNCTION T first_step(const T* y, const T* dy) const {
    const T most = sym6::norm_squared(y) * ::pow(tolerance(), 2.0 / 3.0), change = sym6::norm_squared(dy);
    return value(change) > value(most) ? square_root(most / change) : T(1.0);
  }
  /// Creep relaxes an excess of stress at a rate of its multiplier times (lambda - kappa)/mu g:D:g/F, with g =
  /// dF/dsigma; the pair of methods is stable to 2.5 over that.
  KOKKOS_INLINE_FUNCTION T largest_step(const T& s, const T* y) const {
    double plain[size];
    for (int i = 0; i < size; ++i) plain[i] = value(y[i]);
    return most_of_creep / relaxation(value(s), value(volume_), plain) < 1.0 ? most_of_creep / relaxation(s, volume_, y)
                                                                             : T(1.0);
  }
  KOKKOS_INLINE_FUNCTION bool rates(const T& s, const T* y, T* dy) const {
    double plain[SClay1s::hardening];
    for (int i = 0; i < SClay1s::hardening; ++i) plain[i] = value(y[6 + i]);
    if (!model_.clay.admissible(value(sym6::mean_pressure(y)), plain)) return false;
    const Creep<T> at(model_, duration_, s, volume_, y);
    if (!(value(at.multiplier) < 1e30)) return false;
    T flow[6], elastic[6];
    for (int i = 0; i < 6; ++i) flow[i] = at.multiplier * at.direction[i];
    for (int i = 0; i < 6; ++i) elastic[i] = strain_[i] - flow[i];
    elastic_rate(model_.space, at.bulk, at.shear, at.coupling, y, elastic, dy);
    model_.harden(at.ellipse, y + 6, flow, at.v, dy + 6);
    limit_fall(at.ellipse.p, model_.law.minimum_mean_stress, dy);
    return true;
  }
  KOKKOS_INLINE_FUNCTION T error_squared(const T* y, const T* error) const {
    const double floor = model_.law.minimum_mean_stress;
    T stress = sym6::norm_squared(y);
    if (value(stress) < floor * floor) stress = T(floor * floor);
    T worst = sym6::norm_squared(error) / stress;
    for (int i = 0; i < SClay1s::hardening; ++i) {
      const T e = error[6 + i] / model_.hardening_scale(i, value(y[6 + i]));
      if (value(e) * value(e) > value(worst)) worst = e * e;
    }
    return worst / (tolerance() * tolerance());
  }

 private:
  static constexpr double most_of_creep = 1.5;

  /// Creep at a state, over the increment; X is T or double.
  template <class X>
  struct Creep {
    InclinedEllipse<X> ellipse;
    X v, size, multiplier;  // [-], F [Pa], of `direction`
    X direction[6];         // dF/dsigma
    X bulk, shear;          // [Pa]
    X coupling;             // [1/Pa]
    KOKKOS_INLINE_FUNCTION Creep(const SClay1sModel& model, double duration, const X& s, const X& volume, const X* y) {
      const X* h = y + 6;
      model.evaluate(y, h + SClay1s::alpha, ellipse);
      v = model.specific_volume(s * volume);
      size = ellipse.p + ellipse.shear / ellipse.p;
      const X excess = power(size / ((1.0 + h[SClay1s::chi]) * h[0]), model.clay.creep_exponent());
      multiplier = excess * (duration * model.clay.creep_rate()) / v;
      ellipse.gradient(1.0 / ellipse.p, size, direction);
      model.elastic_moduli(ellipse.s, ellipse.p, v, bulk, shear, coupling);
    }
  };
  template <class X>
  KOKKOS_INLINE_FUNCTION X relaxation(const X& s, const X& volume, const X* y) const {
    const Creep<X> at(model_, duration_, s, volume, y);
    X stress[6];
    elastic_rate(model_.space, at.bulk, at.shear, at.coupling, y, at.direction, stress);
    return at.multiplier * model_.clay.creep_exponent() * sym6::work(stress, at.direction) / at.size;
  }
  KOKKOS_INLINE_FUNCTION double tolerance() const { return model_.law.integration.stress_tolerance; }

  const SClay1sModel& model_;
  const T* strain_;
  T volume_;
  double duration_;  // [s]
};

KOKKOS_INLINE_FUNCTION bool SClay1s::raise_to_minimum(double* stress, double* h) const {
  const double least = clay.minimum_mean_stress;
  double r[6];
  const double p = sym6::deviator(stress, r);
  if (!(p < least)) return false;
  const double* a = h + alpha;
  for (int i = 0; i < 6; ++i) r[i] -= p * a[i];
  h[0] = ::fmax(h[0], 2.0 * least / (1.0 + h[chi]));
  const double room = weakest_ - 1.5 * sym6::norm_squared(a), square = 1.5 * sym6::norm_squared(r);
  const double allowed = room * least * ((1.0 + h[chi]) * h[0] - least);
  const double factor = square > allowed ? ::sqrt(allowed / square) : 1.0;
  for (int i = 0; i < 6; ++i) stress[i] = factor * r[i] + least * a[i] - (i < 3 ? least : 0.0);
  return true;
}

template <class T>
KOKKOS_INLINE_FUNCTION bool SClay1s::creep(const SClay1sModel& model, double duration, const T* strain, T* stress,
                                           T* h) const {
  T y[IsotachePath<T>::size];
  for (int i = 0; i < 6; ++i) y[i] = stress[i];
  for (int i = 0; i < hardening; ++i) y[6 + i] = h[i];
  const IsotachePath<T> path(model, strain, duration);
  EmbeddedSteps<T, IsotachePath<T>::size, IsotachePath<T>> steps(path);
  if (!steps.integrate(y, clay.integration.maximum_substeps)) return false;
  for (int i = 0; i < 6; ++i) stress[i] = y[i];
  for (int i = 0; i < hardening; ++i) h[i] = y[6 + i];
  return true;
}

template <class T>
KOKKOS_INLINE_FUNCTION bool SClay1s::update(const SkeletonPoint& in, const T* strain, const double* state_old,
                                            T* stress, double* state) const {
  double start[6],
      plain[hardening] = {state_old[preconsolidation], state_old[plastic_shear_strain], state_old[bonding]};
  for (int i = 0; i < 6; ++i) start[i] = in.stress[i];
  for (int i = 0; i < 6; ++i) plain[alpha + i] = state_old[fabric + i];
  raise_to_minimum(start, plain);
  T h[hardening];
  for (int i = 0; i < 6; ++i) stress[i] = T(start[i]);
  for (int i = 0; i < hardening; ++i) h[i] = T(plain[i]);
  const SClay1sModel model(*this, clay.specific_volume(in.void_ratio, state_old), plain[0]);
  const bool viscous = creep_slope > 0.0;
  if (!(viscous ? creep(model, in.dt, strain, stress, h)
                : integrate_plasticity(model, clay.integration, strain, stress, h)))
    return false;
  for (int i = 0; i < 6; ++i) start[i] = value(stress[i]);
  for (int i = 0; i < hardening; ++i) plain[i] = value(h[i]);
  if (!viscous && raise_to_minimum(start, plain)) {  // the tangent there is the elastic one
    const ElasticModuli m = moduli(start, in.void_ratio, state_old);
    T change[6];
    for (int i = 0; i < 6; ++i) change[i] = strain[i] - value(strain[i]);
    sym6::isotropic(m.bulk, m.shear, change, stress);
    for (int i = 0; i < 6; ++i) stress[i] += start[i];
  }
  state[preconsolidation] = plain[0];
  state[plastic_shear_strain] = plain[1];
  state[bonding] = plain[chi];
  for (int i = 0; i < 6; ++i) state[fabric + i] = plain[alpha + i];
  return true;
}

/// The law as a deck has it: without any part it is Modified Cam Clay, by the same code.
struct SClay1sByParts : AutomaticTangent<SClay1s> {
  KOKKOS_INLINE_FUNCTION bool operator()(const SkeletonPoint& in, const double* state_old, double* state,
                                         SkeletonResponse& out) const {
    if (!plain()) return AutomaticTangent<SClay1s>::operator()(in, state_old, state, out);
    for (int i = bonding; i < state_size; ++i) state[i] = state_old[i];
    return clay(in, state_old, state, out);
  }
};

// Compiled once, in the source of the law.
extern template class PointwiseSkeleton<SClay1sByParts>;

}  // namespace mudline
