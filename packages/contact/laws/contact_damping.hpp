#pragma once

namespace mudline {

/// Viscous resistance of a contact that presses: the mean normal traction of a step times coefficient * closing speed
/// (K. H. Hunt, F. R. E. Crossley, J. Appl. Mech. 42, 1975, 440-445, for a linear spring). It sets in and ends without
/// a jump, takes energy only, and at most cancels the traction of surfaces that part: it never pulls.
struct ContactDamping {
  double factor = 0, slope = 0;  // [-] of the mean normal traction; by the gap at the end [1/m]
};

/// Of the deck's "damping".
inline constexpr const char* damping_documentation =
    "Viscous resistance of what presses: per speed of closing, this fraction of the contact pressure more; of opening, "
    "less (Hunt and Crossley). A "
    "mass that hits a linear spring at v comes back with about 1 - 2/3 of 'damping' times v of its speed";

/// coefficient [s/m], gaps at both ends of the step [m], its length dt [s].
inline ContactDamping contact_damping(double coefficient, double gap_old, double gap, double dt) {
  const double factor = coefficient * (gap_old - gap) / dt;
  if (factor <= -1) return {-1, 0};
  return {factor, -coefficient / dt};
}

}  // namespace mudline
