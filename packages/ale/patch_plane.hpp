#pragma once

#include <vector>

#include "ale/mesh_surfaces.hpp"

namespace mudline {

/// Coordinates that all of some places share. What comes among them has these to the last bit.
struct SharedCoordinates {
  SharedCoordinates() = default;
  /// Within a share of 1e-9 of what the places reach.
  explicit SharedCoordinates(const Positions& places);
  Point kept(Point at) const;

  std::array<bool, 3> shared{};
  Point value{};  // [m]
};

/// The plane that a patch of a surface lies in, if it does.
struct PatchPlane {
  PatchPlane() = default;
  PatchPlane(const MeshSurfaces& surfaces, int patch, const Positions& x);

  bool flat = false;
  Point normal{};  // outwards, in the mean
  SharedCoordinates of_all;
};

}  // namespace mudline
