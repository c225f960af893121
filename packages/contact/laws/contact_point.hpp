#pragma once

#include <cmath>
#include <type_traits>

#include "contact/laws/friction.hpp"
#include "contact/laws/impact_share.hpp"
#include "contact/laws/normal_law.hpp"
#include "contact/vector.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// Documentation of the deck's "damping".
inline constexpr const char* damping_documentation =
    "Viscous resistance of what presses: per speed of closing, this fraction of the contact pressure more; of opening, "
    "less (Hunt and Crossley). A "
    "mass that hits a linear spring at v comes back with about 1 - 2/3 of 'damping' times v of its speed";

/// Laws and weights in a step at all points of a contact that share a penalty.
struct ContactPointLaw {
  const NormalLaw* normal_law = &linear_normal_law;
  const Friction* friction = nullptr;  // null: smooth
  double tangential_factor = 1;        // [-] tangential over normal penalty
  double penalty = 0;                  // [Pa/m]
  double touch = 0;           // [m] below this gap a point counts as pressing: it has stiffness, even without force
  bool first_guess = false;   // friction is linear: what stuck sticks, what slid slides on
  double time = 0, dt = 1;    // [s] end of the step; its length
  double start_weight = 0;    // [-] weight of the start of the step in the integrator's force
  bool conserves = false;     // points exert the shares of start_share() and end_share() instead
  double impact_damping = 0;  // [-] damping in those shares
  double viscous = 0;         // [s/m] coefficient of damping; 0: none
  /// The point slides against the direction in which it slid at the linearisation before: between both it may stick.
  /// Its tangent is then that of a spring that bears the present shear stress (a secant).
  bool turned = false;
  bool film = false;  // the normal law gives the effective pressure, and water between the surfaces acts beside it
};

/// Tangential quantity: a number in the plane, in space a vector in the tangent plane.
template <class T, int D>
using Tangential = std::conditional_t<D == 2, T, Vec<T, D>>;
template <class T, int D>
Tangential<T, D> no_tangential() {
  if constexpr (D == 2)
    return T(0.0);
  else
    return Vec<T, D>::zero();
}

/// Motion of a contact point in a step, from the geometry of its contact type. T is double or a dual number; the
/// response then has derivatives by the same unknowns. D: dimension of the model.
template <class T, int D = 2>
struct ContactMotion {
  T gap{0.0};                                       // [m] at the end of the step; negative: penetration
  T shift{0.0};                                     // [m] gap at which the pressure starts: multiplier over penalty
  T gap_old{0.0};                                   // [m] at the start of the step, for shares and damping
  T force_old{0.0};                                 // [N] normal force there, for damping
  T area{1.0};                                      // [m2]
  Tangential<T, D> travel = no_tangential<T, D>();  // [m] relative displacement along the surface in the step
  T opened{0.0};  // [m] gap at the start, if open: travel counts from where the point touched
  Tangential<T, D> shear_old = no_tangential<T, D>();  // [Pa] from which the stick spring starts
  double slip_old = 0;                                 // [m] path slid before
  bool slid = false;                                   // in the step before
  T pore_pressure{0.0};                                // [Pa] of the soil that touches
  TouchingSoil soil;                                   // the rest of it
  Point position{};                                    // [m] at the start of the step
};

template <class T, int D = 2>
struct ContactResponse {
  bool presses = false, slides = false;
  T pressure{0.0};                                 // [Pa] on the soil, total, compression positive
  Tangential<T, D> shear = no_tangential<T, D>();  // [Pa] on the soil, along the surface; resists positive travel
  T damping{0.0};                                  // [N] along the normal, added to the mean force over the step
  T start_share{0.0}, end_share{0.0};              // [-] of the forces at both ends in that mean
  double slip = 0;                                 // [m] of this step
  double heat = 0, damping_heat = 0;               // [J] of friction, of damping
};

namespace detail {

template <class T>
T magnitude(const T& a) {
  return value(a) < 0 ? -1.0 * a : a;
}
template <class T, int D>
T magnitude(const Vec<T, D>& a) {
  const T square = dot(a, a);
  return value(square) > 0 ? square_root(square) : T(0.0);
}
/// Vector of the length `size` in the direction of `a`, which is not 0.
template <class T>
T along(const T& a, const T& size) {
  return value(a) > 0 ? size : -1.0 * size;
}
template <class T, int D>
Vec<T, D> along(const Vec<T, D>& a, const T& size) {
  return a * (size / magnitude(a));
}

/// Dual number with the derivatives of slope * a and the value 0.
template <class T>
T change(const T& a, double slope) {
  return chain(a, 0.0, slope);
}

/// Travel that stretches the stick spring: all of the step's travel, or for a point that was open the part after the
/// gap closed at constant speed. Its shear stress starts from 0.
template <class T, int D>
Tangential<T, D> touching_travel(const ContactMotion<T, D>& point) {
  const T pressed = point.gap - point.shift;
  if (!(value(point.opened) > 0)) return point.travel;
  if (!(value(pressed) < 0)) return no_tangential<T, D>();  // it counts as pressing, but has not touched yet
  return point.travel * (pressed / (pressed - point.opened));
}

template <class T, int D>
TouchingSoil soil_at(const ContactMotion<T, D>& point) {
  TouchingSoil soil = point.soil;
  soil.pore_pressure = value(point.pore_pressure);
  return soil;
}

template <class T, int D>
T pressure(const ContactPointLaw& law, const ContactMotion<T, D>& point) {
  const T penetration = point.shift - point.gap;
  const double depth = value(penetration) > 0 ? value(penetration) : 0.0;
  const NormalPressure normal = law.normal_law->at(depth, law.penalty, soil_at(point));
  return chain(penetration, normal.value, normal.slope) + change(point.pore_pressure, normal.pore_slope);
}

/// Viscous resistance: the mean normal force of the step times coefficient * closing speed (K. H. Hunt, F. R. E.
/// Crossley, J. Appl. Mech. 42, 1975, 440-445, for a linear spring). It sets in and ends without a jump, takes energy
/// only, and at most cancels the traction of surfaces that part: it never pulls.
template <class T, int D>
void add_damping(const ContactPointLaw& law, const ContactMotion<T, D>& point, ContactResponse<T, D>& out) {
  const T closing = point.gap_old - point.gap,
          mean = out.start_share * point.force_old + out.end_share * out.pressure * point.area;
  const T factor = law.viscous / law.dt * closing;
  out.damping = value(factor) <= -1 ? -1.0 * mean : factor * mean;
  out.damping_heat = value(out.damping) * value(closing);
}

/// Return map: the travel stretches a spring along the surface; where its stress exceeds the law's strength the point
/// slides.
template <class T, int D>
void add_friction(const ContactPointLaw& law, const ContactMotion<T, D>& point, ContactResponse<T, D>& out) {
  const double stiffness = law.tangential_factor * law.penalty;
  const Tangential<T, D> travel = touching_travel(point);
  out.shear = point.shear_old - travel * stiffness;
  if (law.first_guess) {
    out.slides = point.slid;
    if (point.slid) out.shear = point.shear_old;
    return;
  }
  T normal = out.pressure;
  // Without a film surfaces separate at zero traction, whatever the suction is. Suction counts at most as much as the
  // traction, so that friction ends where contact does.
  const TouchingSoil soil = soil_at(point);
  const bool effective = law.friction->effective_on(soil);
  if (effective && !law.film)
    normal = value(point.pore_pressure) > -value(normal) ? normal - point.pore_pressure : 2.0 * normal;
  if (!effective && law.film) normal = normal + point.pore_pressure;
  const T rate = magnitude(travel) / law.dt;
  const ShearStrength strength =
      law.friction->strength({value(normal), point.position, point.slip_old, law.time, value(rate), soil});
  const double excess = value(magnitude(out.shear)) - strength.value;
  out.slides = !(excess <= 0);  // a strength of NaN is not hidden
  if (!out.slides) return;
  const T limit = strength.value + change(normal, strength.slope) + change(rate, strength.rate_slope) +
                  change(point.pore_pressure, strength.pore_slope);
  out.shear = law.turned ? out.shear * (limit / value(magnitude(out.shear))) : along(out.shear, limit);
  out.slip = excess / stiffness;
  out.heat = std::abs(value(limit)) * out.slip * value(point.area);
}

}  // namespace detail

/// Whether a point presses; the response of one that does not is that of damping alone.
template <class T, int D>
bool presses(const ContactPointLaw& law, const ContactMotion<T, D>& point) {
  return value(point.gap) - value(point.shift) < law.touch;
}

/// The point law of all contacts: pressure and shear stress from gap, travel and old state. It runs on the host, where
/// the laws are.
template <class T, int D>
ContactResponse<T, D> respond(const ContactPointLaw& law, const ContactMotion<T, D>& point) {
  ContactResponse<T, D> out;
  out.start_share = law.conserves ? start_share(point.gap_old, point.gap, law.impact_damping) : T(law.start_weight);
  out.end_share = law.conserves ? end_share(point.gap_old, point.gap, law.impact_damping) : T(1 - law.start_weight);
  out.presses = presses(law, point);
  if (out.presses) out.pressure = detail::pressure(law, point);
  if (law.viscous > 0) detail::add_damping(law, point, out);
  if (out.presses && law.friction) detail::add_friction(law, point, out);
  if (law.film) out.pressure = out.pressure + point.pore_pressure;
  return out;
}

}  // namespace mudline
