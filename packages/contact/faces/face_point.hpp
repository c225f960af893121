#pragma once

#include "contact/contact_rule.hpp"
#include "contact/deformable_target.hpp"

namespace mudline {

/// A face of the master surface: its nodes [m] and their outward unit normals. The normal between them is interpolated,
/// so that it is continuous over the edges of faces that share it.
struct MasterFace {
  CellShape shape;
  int count;  // nodes
  SideCoordinates x, normal;
};

/// Finds the closest point of a point: its coordinates on the face and the gap. False where the face has none: the
/// point is beside the face, or the face is too curved.
bool find_projection(const MasterFace& face, const Point& at, TargetPlace& place);

/// Unit normal of the face at a place on it.
Point face_normal(const MasterFace& face, const TargetPlace& place);

/// The closest point at a place that find_projection() has found. Normals of nodes are held constant.
ClosestPoint closest_on_face(const MasterFace& face, const TargetPlace& place);

}  // namespace mudline
