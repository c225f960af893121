#pragma once

#include "core/registry.hpp"

namespace mudline {

/// Coefficients of one step; everything a step needs to know of a time integrator.
/// Second-order fields (displacement): Chung and Hulbert 1993, alphas weigh the old level. First-order fields (pore
/// pressure): Jansen, Whiting and Hulbert 2000, alphas weigh the new level; or `incremental`: the balance is written
/// over the whole step with differences, Delta u/dt, Delta p/dt and p_n + theta Delta p (Booker and Small; Kontoe et
/// al.).
struct TimeScheme {
  bool inertia = true;  // false: no accelerations; the velocity is the mean velocity of the step
  bool flow = true;     // false: pore pressures are given (geostatic)
  double alpha_m = 0, alpha_f = 0, beta = 0.25, gamma = 0.5;
  bool incremental = false;
  double flow_alpha_m = 1, flow_alpha_f = 1, theta = 1;
  /// Coefficients of the conjugate position u + lead dt v - bend dt^2 a. With the momentum m (v + lead dt a), the free
  /// motion of a mass m and its response to a force f at the momentum level are exact: dt f = change of momentum, mean
  /// momentum dt / m = change of position.
  double lead() const { return inertia ? 1 - alpha_m - gamma : 0.0; }
  /// Damping of contact springs [-], see ImpactShare: 0 where the integrator conserves energy, else just enough to
  /// prevent oscillations.
  double damping() const { return inertia ? 0.25 * (gamma - 0.5) : 0.0; }
  double bend() const { return inertia ? beta - 0.5 * gamma + lead() * (gamma - 0.5) : 0.0; }
};

/// A time integration method. Stateless.
class TimeIntegrator {
 public:
  virtual ~TimeIntegrator() = default;
  /// `step`: number of the step within its stage, from 0.
  virtual TimeScheme scheme(int step) const = 0;
  /// True if it integrates accelerations (required in a dynamic stage, not allowed in a quasi-static one).
  virtual bool dynamic() const = 0;
};

/// Registers "generalised alpha", "newmark", "hht alpha" and "theta".
void register_time_integrators(Registry<TimeIntegrator>& registry);

/// Chung-Hulbert and Jansen-Whiting-Hulbert coefficients for a spectral radius at infinity in [0, 1].
TimeScheme generalised_alpha(double spectral_radius);

}  // namespace mudline
