#pragma once

#include "materials/automatic_tangent.hpp"
#include "materials/embedded_steps.hpp"

namespace mudline {

/// Modified Cam Clay (Roscoe & Burland 1968; Wood 1990, Soil Behaviour and Critical State Soil Mechanics, ch. 5).
/// p', q, strains and pc are compression positive in these equations; v = 1 + e is the specific volume.
///     yield         f = q^2/M(S)^2 + p'(p' - pc) = 0, associated
///     hardening     dpc = pc v/(lambda - kappa) deps_v^p
///     elasticity    K = v p'/kappa, G = 3 K (1-2nu)/(2(1+nu)) or constant; integrated exactly on an elastic path
///     with energy   by option the elastic stress has a potential psi(w) with w = eps_v + g e:e, e the deviator of the
///                   elastic strain: p' = psi'(w) is the swelling line with w in place of eps_v, and s = 2 g p' e, G =
///                   g p'. With a constant v this is Houlsby, Amorosi & Rojas 2005, Geotechnique 55:383, with n = 1.
///                   Since g e:e = h = q^2/(6 g p'^2), shear at constant p' dilates by h
///     volume        dv = -v deps_v: the volumetric strain is logarithmic (or, by option, v keeps its initial value)
///     Lode measure  M(S) = M [2 a^4/(1 + a^4 + (1 - a^4) S)]^(1/4), by option,
///                   a = (3 - sin phi)/(3 + sin phi), sin phi = 3M/(6+M); S = -1 in triaxial compression
///                   (Sheng, Sloan & Yu 2000, Computational Mechanics 26:185)
///     CASM          by option the yield surface is f = ln(p'/pc) + ln(r) (q/(M(S) p'))^n = 0, non-associated: the flow
///                   is normal to the ellipse through the stress, which has a direction at q = 0. At the critical state
///                   pc = r p' (surface: Yu 1998, Int. J. Numer. Anal. Meth. Geomech. 22:621, who takes Rowe's flow).
///                   n = 2 and more, so that the surface is smooth at q = 0.
/// Stress integration and tangent: substepping.hpp or implicit_return.hpp. Code: tension positive, [Pa].
/// The mean effective stress does not fall below `minimum_mean_stress` (a tension cut-off): there p' is set to it, pc
/// and q are adjusted to the yield surface, and the tangent is the elastic one.
struct ModifiedCamClay {
  static constexpr bool hardens_with_volume = true, small_strain = true;
  enum class Lode { none, sheng };
  enum class Volume { current, initial };
  enum { preconsolidation, plastic_shear_strain, initial_specific_volume, state_size };

  double ratio = 1.0;                  // [-] M in triaxial compression
  double compression = 0.2;            // [-] lambda
  double swelling = 0.02;              // [-] kappa
  double poisson = 0.0;                // [-] used unless shear_modulus or shear_ratio is positive
  double shear_modulus = 0.0;          // [Pa]
  double shear_ratio = 0.0;            // [-] g = G/p' of the elasticity with energy, which it switches on
  double minimum_mean_stress = 100.0;  // [Pa]
  double normal_volume = 0.0;          // [-] N; used if positive
  double critical_volume = 0.0;        // [-] Gamma, instead of N
  double reference_pressure = 1000.0;  // [Pa] at which N and Gamma are read
  double spacing = 0.0;                // [-] r of CASM; 0: the ellipse, where it is 2
  double exponent = 2.0;               // [-] n of CASM
  Lode lode = Lode::none;
  Volume volume = Volume::current;
  IntegrationOptions integration;

  void parameters(Parameters& p);
  void check(const Section& section) const;
  static std::vector<StateVariable> state();
  /// pc = R (p' + q^2/(M^2 p')), or R p' r^((q/(M p'))^n): the yield surface through the initial stress, scaled by the
  /// overconsolidation ratio R.
  /// With N, the specific volume at p' = p_ref on the isotropic normal compression line v = N - lambda ln(p'/p_ref), pc
  /// follows from the initial stress and void ratio instead: ln(pc/p_ref) = (N - v - kappa ln(p'/p_ref))/(lambda -
  /// kappa).
  std::string initialise(const InitialPoint& point, double* state) const;
  /// Void ratio from the pc that belongs to stress and overconsolidation ratio: v = N - lambda ln(pc/p_ref) + kappa
  /// ln(pc/p'). `no_void_ratio` without N. Gamma is v on the critical state line at p_ref, where pc = r p', so that N =
  /// Gamma + (lambda - kappa) ln r, r = 2 for the ellipse.
  double void_ratio(const InitialPoint& point) const;
  /// "" or why the law cannot start from a point, its surface aside.
  std::string cannot_start(const InitialPoint& point) const;
  /// The same as initialise() and void_ratio() with another surface: `on_surface` is the pc [Pa] of that through the
  /// initial stress.
  std::string start(const InitialPoint& point, double on_surface, double* state) const;
  double void_ratio(const InitialPoint& point, double on_surface) const;
  /// K0 = K0nc R^(sin phi) (Mayne & Kulhawy 1982 with the friction angle of M). K0nc is the limit of the stress ratio
  /// in one-dimensional virgin compression: 2 eta (lambda-kappa)/(M^2-eta^2) + eta kappa/(3g) = 2 lambda/3 with g =
  /// G/K, K0nc = (3-eta)/(3+2 eta); the elastic shear strain (second term) is left out when G is constant, and is none
  /// where s/p' decides it (`shear_ratio`). The flow decides, so it is the same for both surfaces. Here R is the ratio
  /// of vertical stresses.
  double k0(double overconsolidation_ratio) const;
  /// Undrained strength in triaxial compression from the present stress, that of the critical state: s_u = M/2 p'
  /// (pc/(r p'))^((lambda - kappa)/lambda), r = 2 for the ellipse (Wood 1990, ch. 7). With a `shear_ratio` times
  /// exp(v (h_cs - h)/lambda), to the first power of h.
  SoilState soil_state(const double* stress, double void_ratio, const double* state) const;
  /// Earth pressures at the critical state.
  EarthPressures earth_pressures(double vertical, double) const;

  KOKKOS_INLINE_FUNCTION double specific_volume(double void_ratio, const double* state) const {
    return volume == Volume::initial ? state[initial_specific_volume] : 1.0 + void_ratio;
  }
  /// a^4 of the Lode measure.
  KOKKOS_INLINE_FUNCTION double lode_ratio_4() const {
    const double sine = 3.0 * ratio / (6.0 + ratio), a = (3.0 - sine) / (3.0 + sine);
    return a * a * a * a;
  }
  /// h = s:s/(4 g p'^2) of the elasticity with energy: strain by which shear dilates at constant p'.
  template <class T>
  KOKKOS_INLINE_FUNCTION T dilation(const T& square, const T& p) const {
    return square / (4.0 * shear_ratio * p * p);
  }
  KOKKOS_INLINE_FUNCTION double shear_to_bulk() const { return 1.5 * (1.0 - 2.0 * poisson) / (1.0 + poisson); }
  KOKKOS_INLINE_FUNCTION ElasticModuli moduli(const double* stress, double void_ratio, const double* state) const {
    const double p = ::fmax(sym6::mean_pressure(stress), minimum_mean_stress);
    double bulk = specific_volume(void_ratio, state) * p / swelling;
    if (shear_ratio > 0.0) {
      double s[6];
      sym6::deviator(stress, s);
      if (volume == Volume::current) bulk *= ::exp(-dilation(sym6::norm_squared(s), p));
      return {bulk, shear_ratio * p};
    }
    return {bulk, shear_modulus > 0.0 ? shear_modulus : shear_to_bulk() * bulk};
  }
  KOKKOS_INLINE_FUNCTION bool operator()(const SkeletonPoint& in, const double* state_old, double* state,
                                         SkeletonResponse& out) const;

 private:
  /// Update by the model of the chosen yield surface.
  template <class Space, class T>
  KOKKOS_INLINE_FUNCTION bool integrate(const Space& space, double specific_volume, const T* strain, T* stress,
                                        T* h) const;
  /// Update with a Lode measure, in all six components.
  template <class T>
  KOKKOS_INLINE_FUNCTION bool update_six_components(const double* start, const double* h, double specific_volume,
                                                    const T* strain, double* state, SkeletonResponse& out) const;
  /// Update without a Lode measure, in the space of the deviators of the old stress and of the strain increment.
  template <class T>
  KOKKOS_INLINE_FUNCTION bool update_two_deviators(const double* start, const double* h, double specific_volume,
                                                   const double* strain, double* state, SkeletonResponse& out) const;
  KOKKOS_INLINE_FUNCTION bool raise_to_minimum(double* stress, double* h) const;
  /// Specific volume over that at rest, at the same p' and no shear stress: 1 without a `shear_ratio`.
  double dilated(const double* stress) const;
  /// N, given or from Gamma; 0 if neither is given.
  double normal_line() const;
  /// pc/p' at the critical state.
  KOKKOS_INLINE_FUNCTION double critical_spacing() const { return spacing > 0.0 ? spacing : 2.0; }
  /// pc of the yield surface through a stress [Pa].
  double through(const double* stress) const;
};

/// The model of the law for stress integration over one increment. h = (pc, plastic shear strain).
template <class Space>
struct ModifiedCamClayModel {
  static constexpr int hardening = 2, N = Space::size;
  static constexpr bool associated = true, trapezoidal = true, coupled = true, has_third_invariant = N == 6;

  const ModifiedCamClay& law;
  Space space;
  double volume0;     // [-] specific volume at the start of the increment
  double scale;       // [1/Pa^2] makes f dimensionless: 1/pc^2 at the start
  double a4;          // [-] a^4 of the Lode dependence
  double inverse_m2;  // [-] 1/M^2

  KOKKOS_INLINE_FUNCTION ModifiedCamClayModel(const ModifiedCamClay& l, const Space& how, double specific_volume,
                                              double pc)
      : law(l),
        space(how),
        volume0(specific_volume),
        scale(1.0 / (pc * pc)),
        a4(l.lode_ratio_4()),
        inverse_m2(1.0 / (l.ratio * l.ratio)) {}

  /// w = M^2/M(S)^2 and dw/dS.
  template <class T>
  KOKKOS_INLINE_FUNCTION T shape(const T& s, T& slope) const {
    const T w = square_root((1.0 + a4 + (1.0 - a4) * s) / (2.0 * a4));
    slope = (1.0 - a4) / (4.0 * a4) / w;
    return w;
  }

  /// False where the deviator is too small to have a Lode measure; w is not needed there.
  KOKKOS_INLINE_FUNCTION bool has_lode(double q_squared) const {
    return has_third_invariant && law.lode == ModifiedCamClay::Lode::sheng && q_squared * scale > 1e-24;
  }

  /// Returns p' and computes q^2 M^2/M(S)^2.
  template <class T>
  KOKKOS_INLINE_FUNCTION T invariants(const T* stress, T& q2) const {
    T s[N];
    const T p = space.deviator(stress, s);
    q2 = 1.5 * space.norm_squared(s);
    if constexpr (has_third_invariant)
      if (has_lode(value(q2))) {
        T slope;
        q2 *= shape(13.5 * sym6::determinant(s) / (q2 * square_root(q2)), slope);
      }
    return p;
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION T yield(const T* stress, const T* h) const {
    T q2;
    const T p = invariants(stress, q2);
    return scale * (inverse_m2 * q2 + p * (p - h[0]));
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION void flow(const T* stress, const T* h, const T& volume_strain,
                                   PlasticFlow<T, 2, N>& out) const {
    T s[N];
    const T p = space.deviator(stress, s);
    const T v = specific_volume(volume_strain);
    elastic_moduli(s, p, v, out.bulk, out.shear, out.coupling);
    const T q2 = 1.5 * space.norm_squared(s), mean = scale * (2.0 * p - h[0]);  // df/dp'
    const double along = 3.0 * inverse_m2 * scale;
    out.hardening_rate[1] =
        value(q2) * scale > 1e-24 ? 2.0 * inverse_m2 * scale * square_root(q2) : T(0.0);  // sqrt(2/3 e:e)
    if constexpr (has_third_invariant) {
      if (has_lode(value(q2)))
        out.hardening_rate[1] = lode_gradient(s, q2, mean, out.yield_gradient);
      else
        space.strain_along(-1.0 * mean, T(along), s, out.yield_gradient);
    } else {
      space.strain_along(-1.0 * mean, T(along), s, out.yield_gradient);
    }
    out.hardening_gradient[0] = -scale * p;
    out.hardening_gradient[1] = T(0.0);
    out.hardening_rate[0] = h[0] * v * mean * (1.0 / (law.compression - law.swelling));
  }

  /// df/dsigma, strain-like; returns the equivalent shear strain sqrt(2/3 e:e) of its deviator, d(q^2 w/M^2)/dsigma
  /// times scale.
  template <class T>
  KOKKOS_INLINE_FUNCTION T lode_gradient(const T* s, const T& q2, const T& mean, T* g) const {
    // d(q^2 w) = (w - 3/2 w' S) d(q^2) + w' (27/2) dJ3/q
    const T q = square_root(q2), measure = 13.5 * sym6::determinant(s) / (q * q2);
    T slope, cubic[6];
    const T w = shape(measure, slope);
    sym6::determinant_gradient(s, q2, cubic);
    const T along = 3.0 * inverse_m2 * scale * (w - 1.5 * slope * measure),
            across = 13.5 * inverse_m2 * scale * slope / q;
    for (int i = 0; i < 3; ++i) g[i] = along * s[i] + across * cubic[i];
    for (int i = 3; i < 6; ++i) g[i] = 2.0 * along * s[i] + across * cubic[i];
    const T normal = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
    const T shear = square_root((2.0 / 3.0) * (normal + 0.5 * (g[3] * g[3] + g[4] * g[4] + g[5] * g[5])));
    for (int i = 0; i < 3; ++i) g[i] -= mean * (1.0 / 3.0);
    return shear;
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION T specific_volume(const T& volume_strain) const {
    return law.volume == ModifiedCamClay::Volume::current ? volume0 * exponential(volume_strain) : T(volume0);
  }

  /// The tangential elasticity at the deviator s and p', for elastic_rate().
  template <class T>
  KOKKOS_INLINE_FUNCTION void elastic_moduli(const T* s, const T& p, const T& v, T& bulk, T& shear, T& coupling) const {
    if (law.shear_ratio > 0.0) {
      bulk = T(0.0);  // the coupling contains K = v p'/kappa exp(-h)
      shear = law.shear_ratio * p;
      coupling = v / (law.swelling * p);
      if (law.volume == ModifiedCamClay::Volume::current)
        coupling *= exponential(-1.0 * law.dilation(space.norm_squared(s), p));
      return;
    }
    bulk = v * p * (1.0 / law.swelling);
    shear = law.shear_modulus > 0.0 ? T(law.shear_modulus) : law.shear_to_bulk() * bulk;
    coupling = T(0.0);
  }

  /// Stress after an elastic strain with the stored energy psi(w): sigma = exp(x) (sigma_0 + 2 g p'_0 de), where x =
  /// ln(p'/p'_0) is exact: v dw/kappa with a constant v. Else the swelling line holds for v exp(-h), which changes by
  /// exp(-dw); `v` is that in the middle of the strain.
  template <class S, class T>
  KOKKOS_INLINE_FUNCTION void store(const S* stress, const T* strain, const T& v, T* out) const {
    T from[N], s[N], change[N];
    for (int i = 0; i < N; ++i) from[i] = number_as<T>(stress[i]);
    const T p = space.deviator(from, s);
    space.isotropic(T(0.0), T(law.shear_ratio * p), strain, change);
    const T dilating = space.work(s, strain) / p + law.dilation(space.norm_squared(change), p);  // change of h
    const T dw = dilating - space.trace(strain);
    T per_strain = v / law.swelling;  // x / dw
    if (law.volume == ModifiedCamClay::Volume::current) {
      const T middle = law.dilation(space.norm_squared(s), p) + 0.5 * dilating;
      per_strain *= exponential(0.5 * dw - middle) * exponential_quotient(-1.0 * dw);
    }
    const T growth = exponential(per_strain * dw);
    for (int i = 0; i < N; ++i) out[i] = growth * (from[i] + change[i]);
  }

  /// p' = p'_0 exp((v_0 - v)/kappa), so the mean modulus is K = p'_0 (exp(x) - 1)/eps_v with x = (v_0 - v)/kappa; with
  /// constant nu the shear modulus follows K along the path, so its mean does too.
  template <class T>
  KOKKOS_INLINE_FUNCTION void elastic(const T* stress, const T* strain, T* out) const {
    if (law.shear_ratio > 0.0) return store(stress, strain, specific_volume(T(0.5 * space.trace(strain))), out);
    const T compression = -space.trace(strain), p = space.mean_pressure(stress);
    T per_strain(volume0 / law.swelling);  // x / eps_v
    if (law.volume == ModifiedCamClay::Volume::current) per_strain *= exponential_quotient(-compression);
    const T bulk = p * per_strain * exponential_quotient(per_strain * compression);
    const T shear = law.shear_modulus > 0.0 ? T(law.shear_modulus) : law.shear_to_bulk() * bulk;
    space.isotropic(bulk, shear, strain, out);
    for (int i = 0; i < N; ++i) out[i] += stress[i];
  }

  /// Elastic step with the specific volume that belongs to `volume_strain`.
  template <class S, class T>
  KOKKOS_INLINE_FUNCTION void elastic_step(const S* stress, const T* strain, const T& volume_strain, T* out) const {
    if (law.shear_ratio > 0.0) return store(stress, strain, specific_volume(volume_strain), out);
    const T per_strain = specific_volume(volume_strain) / law.swelling, compression = -space.trace(strain);
    const T bulk = space.mean_pressure(stress) * per_strain * exponential_quotient(per_strain * compression);
    const T shear = law.shear_modulus > 0.0 ? T(law.shear_modulus) : law.shear_to_bulk() * bulk;
    space.isotropic(bulk, shear, strain, out);
    for (int i = 0; i < N; ++i) out[i] += stress[i];
  }

  KOKKOS_INLINE_FUNCTION bool admissible(const double* stress, const double* h) const {
    return space.mean_pressure(stress) > 0.0 && h[0] > 0.0;
  }
  KOKKOS_INLINE_FUNCTION bool exhausted(const double* stress) const {
    return space.mean_pressure(stress) < law.minimum_mean_stress;
  }
  KOKKOS_INLINE_FUNCTION double hardening_scale(int i, double h) const { return i == 0 ? h : 1.0; }
  /// pc grows exponentially with the plastic volume strain, which is exact for constant v.
  template <class T>
  KOKKOS_INLINE_FUNCTION T hardening_measure(int i, const T& h) const {
    return i == 0 ? h : T(1.0);
  }
  template <class S, class T>
  KOKKOS_INLINE_FUNCTION T hardened(int i, const S& h, const T& x) const {
    if (i == 0) return h * exponential(x);
    return h + x;
  }
};

/// The same with the yield surface of CASM. x = (q/(M(S) p'))^2.
template <class Space>
struct CasmModel : ModifiedCamClayModel<Space> {
  using Ellipse = ModifiedCamClayModel<Space>;
  using Ellipse::N;
  static constexpr bool associated = false;

  double spread;  // [-] ln(r)

  KOKKOS_INLINE_FUNCTION CasmModel(const ModifiedCamClay& l, const Space& how, double specific_volume, double pc)
      : Ellipse(l, how, specific_volume, pc), spread(::log(l.spacing)) {}

  /// x^(n/2 - 1).
  template <class T>
  KOKKOS_INLINE_FUNCTION T slope(const T& x) const {
    const double exponent = 0.5 * this->law.exponent - 1.0;
    if (!(exponent > 0.0)) return T(1.0);
    return value(x) > 1e-24 ? power(x, exponent) : T(0.0);
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION T yield(const T* stress, const T* h) const {
    T q2;
    const T p = this->invariants(stress, q2), x = this->inverse_m2 * q2 / (p * p);
    return logarithm(p / h[0]) + spread * (x * slope(x));
  }

  template <class T>
  KOKKOS_INLINE_FUNCTION void flow(const T* stress, const T* h, const T& volume_strain,
                                   PlasticFlow<T, 2, N>& out) const {
    T q2;
    const T p = this->invariants(stress, q2), x = this->inverse_m2 * q2 / (p * p);
    const T potential[2] = {p + p * x, h[1]};  // the ellipse through the stress
    Ellipse::flow(stress, potential, volume_strain, out);
    for (int i = 0; i < N; ++i) out.flow_direction[i] = out.yield_gradient[i];
    out.hardening_rate[0] *= h[0] / potential[0];
    out.hardening_gradient[0] = -1.0 / h[0];
    // deviator as that of the ellipse, times df/d(q^2/M^2)/scale; volume from df/dp'
    const double exponent = this->law.exponent;
    const T factor = slope(x) * (0.5 * exponent * spread / this->scale) / (p * p);
    const T along_ellipse = this->scale * (p - p * x), along = (1.0 - exponent * spread * (x * slope(x))) / p;
    this->space.strain_along(factor * along_ellipse - along, T(0.0), stress, out.yield_gradient);
    for (int i = 0; i < N; ++i) out.yield_gradient[i] += factor * out.flow_direction[i];
  }
};

/// Where p' is below the minimum: sets it there and returns true. pc is at least r times the minimum (r = 2 for the
/// ellipse), so that the surface leaves room for shear, and q is reduced to the surface (inside it for every Lode
/// angle: a^2 <= M(S)^2/M^2).
KOKKOS_INLINE_FUNCTION bool ModifiedCamClay::raise_to_minimum(double* stress, double* h) const {
  double s[6];
  if (!(sym6::deviator(stress, s) < minimum_mean_stress)) return false;
  h[0] = ::fmax(h[0], critical_spacing() * minimum_mean_stress);
  const double weakest = lode == Lode::sheng ? ::sqrt(lode_ratio_4()) : 1.0;
  const double room =
      spacing > 0.0 ? minimum_mean_stress * ::pow(::log(h[0] / minimum_mean_stress) / ::log(spacing), 2.0 / exponent)
                    : h[0] - minimum_mean_stress;
  const double allowed = weakest * ratio * ratio * minimum_mean_stress * room;
  const double q2 = 1.5 * sym6::norm_squared(s);
  const double factor = q2 > allowed ? ::sqrt(allowed / q2) : 1.0;
  for (int i = 0; i < 6; ++i) stress[i] = factor * s[i] - (i < 3 ? minimum_mean_stress : 0.0);
  return true;
}

template <class Space, class T>
KOKKOS_INLINE_FUNCTION bool ModifiedCamClay::integrate(const Space& space, double specific_volume, const T* strain,
                                                       T* stress, T* h) const {
  const double pc = value(h[0]);
  if (spacing > 0.0)
    return integrate_plasticity(CasmModel<Space>(*this, space, specific_volume, pc), integration, strain, stress, h);
  return integrate_plasticity(ModifiedCamClayModel<Space>(*this, space, specific_volume, pc), integration, strain,
                              stress, h);
}

template <class T>
KOKKOS_INLINE_FUNCTION bool ModifiedCamClay::update_six_components(const double* start, const double* h,
                                                                   double specific_volume, const T* strain,
                                                                   double* state, SkeletonResponse& out) const {
  T stress[6], hardening[2] = {T(h[0]), T(h[1])};
  for (int i = 0; i < 6; ++i) stress[i] = T(start[i]);
  if (!integrate(SixComponents(), specific_volume, strain, stress, hardening)) return false;
  for (int i = 0; i < 6; ++i) out.stress[i] = value(stress[i]);
  for (int i = 0; i < 2; ++i) state[i] = value(hardening[i]);
  write_tangent(stress, out.tangent);
  return true;
}

template <class T>
KOKKOS_INLINE_FUNCTION bool ModifiedCamClay::update_two_deviators(const double* start, const double* h,
                                                                  double specific_volume, const double* strain,
                                                                  double* state, SkeletonResponse& out) const {
  const IncrementOfTwoDeviators<T> increment(start, strain);
  T stress[3], hardening[2] = {T(h[0]), T(h[1])};
  increment.start(stress);
  if (!integrate(increment.space, specific_volume, increment.strain, stress, hardening)) return false;
  increment.write(stress, out.stress);
  for (int i = 0; i < 2; ++i) state[i] = value(hardening[i]);
  if constexpr (!std::is_same_v<T, double>) increment.write_tangent(stress, out.tangent);
  return true;
}

KOKKOS_INLINE_FUNCTION bool ModifiedCamClay::operator()(const SkeletonPoint& in, const double* state_old, double* state,
                                                        SkeletonResponse& out) const {
  for (int i = 0; i < state_size; ++i) state[i] = state_old[i];
  double start[6], h[2] = {state_old[preconsolidation], state_old[plastic_shear_strain]};
  for (int i = 0; i < 6; ++i) start[i] = in.stress[i];
  raise_to_minimum(start, h);
  const double volume = specific_volume(in.void_ratio, state_old);
  bool ok;
  if (lode == Lode::none) {
    ok = in.want_tangent ? update_two_deviators<Dual<IncrementOfTwoDeviators<double>::directions>>(
                               start, h, volume, in.strain, state, out)
                         : update_two_deviators<double>(start, h, volume, in.strain, state, out);
  } else if (!in.want_tangent) {
    ok = update_six_components(start, h, volume, in.strain, state, out);
  } else if (in.plane) {
    Dual<4> strain[6];
    make_variable(in.strain, strain);
    ok = update_six_components(start, h, volume, strain, state, out);
  } else {
    Dual<6> strain[6];
    make_variable(in.strain, strain);
    ok = update_six_components(start, h, volume, strain, state, out);
  }
  if (!ok || !raise_to_minimum(out.stress, state) || !in.want_tangent) return ok;
  const ElasticModuli m = moduli(out.stress, in.void_ratio, state_old);
  sym6::isotropic_stiffness(m.bulk, m.shear, out.tangent);
  return true;
}

// Compiled once, in the source of the law.
extern template class PointwiseSkeleton<ModifiedCamClay>;

}  // namespace mudline
