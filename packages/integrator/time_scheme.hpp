#pragma once

#include "core/registry.hpp"

namespace mudline {

/// Coefficients of one step; everything the stepper needs to know of a time integrator.
/// Second-order fields (displacement): Chung and Hulbert 1993, alphas weigh the old level. First-order fields (pore
/// pressure): Jansen, Whiting and Hulbert 2000, alphas weigh the new level; or `incremental`: the balance is written
/// over the whole step with differences, Delta u/dt, Delta p/dt and p_n + theta Delta p (Booker and Small; Kontoe et
/// al.).
struct TimeScheme {
  bool inertia = true;  // false: no accelerations; the velocity is the mean one of the step
  bool flow = true;     // false: pore pressures are given (geostatic)
  double alpha_m = 0, alpha_f = 0, beta = 0.25, gamma = 0.5;
  bool incremental = false;
  double flow_alpha_m = 1, flow_alpha_f = 1, theta = 1;
  /// The conjugate position u + lead dt v - bend dt^2 a: with the momentum m (v + lead dt a) it makes the free flight
  /// of a mass m, and its kicks by a force f at the momentum level, exact: dt f = change of momentum, mean momentum dt
  /// / m = change of position.
  double lead() const { return inertia ? 1 - alpha_m - gamma : 0.0; }
  /// Of contact springs, see ImpactShare: 0 where the integrator keeps energy, else just enough that they do not ring.
  double damping() const { return inertia ? 0.25 * (gamma - 0.5) : 0.0; }
  double bend() const { return inertia ? beta - 0.5 * gamma + lead() * (gamma - 0.5) : 0.0; }
};

/// A way to step through time. Stateless.
class TimeIntegrator {
 public:
  virtual ~TimeIntegrator() = default;
  /// `step`: number of the step within its stage, from 0.
  virtual TimeScheme scheme(int step) const = 0;
  /// True when it integrates accelerations (a dynamic stage needs one, a quasi-static stage must not have one).
  virtual bool dynamic() const = 0;
};

/// "generalised alpha", "newmark", "hht alpha", "theta"; a plain list.
void register_time_integrators(Registry<TimeIntegrator>& registry);

/// Chung-Hulbert and Jansen-Whiting-Hulbert coefficients of one spectral radius at infinity in [0, 1].
TimeScheme generalised_alpha(double spectral_radius);

}  // namespace mudline
