#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bodies/rigid_body.hpp"
#include "discretisation/mesh.hpp"
#include "discretisation/source_position.hpp"

namespace mudline {

/// A plane mesh of soil under a level mudline, x >= 0, around a rigid body with a half contour. The soil's boundary
/// follows the contour exactly where that is below the mudline, mid-side nodes too; a body may be buried. One that
/// touches the mudline from above leaves it whole, with a vertex at 1.04 of the body's half width: the lip of the hole
/// that it will make, whose wall the sides under the body become. Triangles grow with the distance from the body. Side
/// sets: axis, base, far side, seabed, hole (along the body, where it is in the ground), and surface, which is seabed
/// and hole.
class PenetrationMesh : public MeshSource {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  /// Reads the body from the deck's "bodies", before generate(). InputError.
  void read_body(const Section& bodies, const BodyRegistries& registries);
  GlobalMesh generate() const override;

 private:
  /// Part of the boundary, in the direction that has the soil on the left.
  struct Curve {
    std::string set;
    double length;                                 // [m]
    std::function<PlanePoint(double s)> point_at;  // s [m] from its start
  };
  std::vector<Curve> boundary() const;
  /// The parts of the contour below the mudline, from the mudline, or the body's top, down to the tip.
  std::vector<Curve> hole() const;
  /// Largest distance of the curves from the axis [m].
  static double widest(const std::vector<Curve>& curves);
  /// Wanted length of the sides at a point [m].
  double size(const PlanePoint& x) const;

  std::string body_name_, region_ = "soil";
  Geometry geometry_ = Geometry::plane_strain;
  double width_ = 0, depth_ = 0, mudline_ = 0;
  double near_size_ = 0, near_distance_ = 0, growth_ = 0.15, largest_ = 0;  // sizes
  double time_limit_ = 600;
  int order_ = 2;
  SourcePosition position_;
  std::shared_ptr<const RigidBody> body_;
  // Radius of the vertex under the edge of a body that begins at the surface [m]; at its half width itself the body's
  // edge would catch it. 0: the body is in the ground at the start.
  double lip_ = 0;
};

}  // namespace mudline
