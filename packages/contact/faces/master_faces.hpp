#pragma once

#include <string>
#include <utility>
#include <vector>

#include "contact/faces/face_point.hpp"
#include "contact/master_surface.hpp"

namespace mudline {

/// Faces of a side set in space, for contact with the points of another surface. The normal at a node is the mean of
/// those of the faces around it, without faces on the other side of a corner.
class MasterFaces {
 public:
  /// Corners: edges and nodes where faces' normals differ by more than `corner_angle` [rad] at x. Collective.
  MasterFaces(const Mesh& mesh, const std::string& side_set, double corner_angle);

  const MasterSurface& surface() const { return surface_; }
  int size() const { return static_cast<int>(surface_.sides().size()); }
  /// Faces whose boxes come within `distance` [m] of the box, in ascending order.
  std::vector<int> near(const BoxSearch::Corners& box, double distance) const { return surface_.near(box, distance); }

  /// Updates boxes and the normals of nodes; called at the start of a step.
  void update(const ConstCoordinateView& x);
  /// A face with its nodes at x and the normals of the last update().
  MasterFace face(int index, const ConstCoordinateView& x) const;

  /// Finds the nearest closest point of a point on one of `candidates`; false where none of them faces it within
  /// `capture` [m]. `outward`: normal of the point's own surface.
  bool find(const std::vector<int>& candidates, const Point& at, const Point& outward, double capture,
            const ConstCoordinateView& x, int& index, FaceProjection& projection) const;

 private:
  struct Corner {
    int face, node;  // node: of the face, in the order of its shape
  };
  Point normal_at(int face, int node, const ConstCoordinateView& x) const;

  MasterSurface surface_;
  std::vector<std::vector<std::vector<Corner>>> around_;  // (face, node) the faces that share the normal there
  std::vector<SideCoordinates> normals_;                  // (face, node)
};

}  // namespace mudline
