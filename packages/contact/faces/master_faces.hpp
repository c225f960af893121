#pragma once

#include <string>
#include <utility>
#include <vector>

#include "contact/faces/face_point.hpp"
#include "contact/master_surface.hpp"

namespace mudline {

/// Faces of a side set in space, which points of another surface touch. The normal at a node is the mean of
/// those of the faces around it, without faces on the other side of a corner.
class MasterFaces : public DeformableTarget {
 public:
  /// Corners: edges and nodes where faces' normals differ by more than `corner_angle` [rad] at x. Collective.
  MasterFaces(const Mesh& mesh, const std::string& side_set, double corner_angle);

  int pieces() const override { return static_cast<int>(sides().size()); }
  TargetNodes nodes(int piece) const override { return {sides()[piece].count, sides()[piece].node}; }
  const std::vector<MasterSurface::MasterSide>& sides() const override { return surface_.sides(); }
  std::vector<int> near(const Bounds& box, double distance) const override { return surface_.near(box, distance); }
  void update(const ConstCoordinateView& x) override;
  bool find(const std::vector<int>& candidates, const Point& at, const Point& outward, double capture,
            const ConstCoordinateView& x, TargetPlace& place) const override;
  ClosestPoint closest(const TargetPlace& place, const Point&, const ConstCoordinateView& x) const override {
    return closest_on_face(face(place.piece, x), place);
  }
  void weights(int piece, const double* at, double* weight) const override;

 private:
  struct Corner {
    int face, node;  // node: of the face, in the order of its shape
  };
  /// A face with its nodes at x and the normals of the last update().
  MasterFace face(int index, const ConstCoordinateView& x) const;
  Point normal_at(int face, int node, const ConstCoordinateView& x) const;

  MasterSurface surface_;
  std::vector<std::vector<std::vector<Corner>>> around_;  // (face, node) the faces that share the normal there
  std::vector<SideCoordinates> normals_;                  // (face, node)
};

}  // namespace mudline
