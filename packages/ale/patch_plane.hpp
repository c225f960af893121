#pragma once

#include <vector>

#include "ale/mesh_surfaces.hpp"

namespace mudline {

/// Coordinates that all of some places share, so that new places among them get the same to the last bit.
struct SharedCoordinates {
  SharedCoordinates() = default;
  /// Coordinates are shared where they differ by less than 1e-9 of the extent of the places.
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
  Point normal{};  // mean outward unit normal
  SharedCoordinates of_all;
};

}  // namespace mudline
