#pragma once

#include "framework/point_fields.hpp"

namespace mudline {

/// Declares the outputs of a law and what it depends on. A law inherits this and overrides constants by the same names;
/// outputs and derivatives that are switched off cost nothing.
struct PointLaw {
  static constexpr bool forces = false, stresses = false, storages = false, fluxes = false;
  static constexpr int any = -1, fields = any;  // number of scalar fields for which it is written
  static constexpr bool motion = true;  // depends on the displacement gradient, as every law does through the volume
  // Depends on more of that gradient than the volume, as all laws do that have stresses or fluxes, or read gradients
  // or a velocity gradient. Without it one derivative stands for all of the motion.
  static constexpr bool shape = true;
  static constexpr bool inertia = false;    // depends on velocity or acceleration themselves
  static constexpr bool scalars = true;     // depends on values (and rates) of the scalar fields
  static constexpr bool rates = true;       // uses velocities, accelerations or rates at all
  static constexpr bool gradients = false;  // depends on the gradients of the scalar fields
  static constexpr bool stands = false;     // its stress lasts from before the step; the law also gives the change
  static constexpr bool cancels = false;    // a storage is a difference of large numbers; the law also gives their size
};

/// Layout of the derivative indices of a law's dual numbers, in the coordinate system C with S scalar fields.
template <class C, int S, class Law>
struct LawDirections {
  static constexpr int D = C::dim;
  static_assert(Law::shape || !(Law::stresses || Law::fluxes || Law::gradients), "the law needs the whole motion");
  static constexpr int hoop = Law::shape ? D * D : 0;  // index of the hoop strain or, without `shape`, of the volume
  static constexpr int motion = 0,
                       motions = !Law::motion ? 0
                                 : Law::shape ? D * D + (C::hoop ? 1 : 0)
                                              : 1,
                       inertia = motion + motions, value = inertia + (Law::inertia ? D : 0),
                       gradient = value + (Law::scalars ? S : 0), count = gradient + (Law::gradients ? S * D : 0);
};

/// Rows of a point's matrix: forces, stresses, hoop stress, storages, fluxes; outputs that a law does not have are left
/// out.
template <class C, int S, class Law>
struct LawRows {
  static constexpr int D = C::dim;
  static constexpr int force = 0, stress = force + (Law::forces ? D : 0), hoop = stress + (Law::stresses ? D * D : 0),
                       storage = hoop + (Law::stresses && C::hoop ? 1 : 0), flux = storage + (Law::storages ? S : 0),
                       count = flux + (Law::fluxes ? S * D : 0);
};

}  // namespace mudline
