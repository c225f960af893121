#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "discretisation/mesh.hpp"
#include "discretisation/source_position.hpp"
#include "geometry/contour_shape.hpp"

namespace mudline {

/// A plane mesh of soil under a level mudline, x >= 0, around a rigid body with a half contour. The soil's boundary
/// follows the contour exactly where that is below the mudline, mid-side nodes too; a body that touches the mudline
/// from above leaves it whole. Triangles grow with the distance from the body. Side sets: axis, base, far side, seabed,
/// hole (along the body, where it is in the ground), and surface, which is seabed and hole.
class PenetrationMesh : public MeshSource {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  /// Takes the body's contour and the place of its reference point, from the deck's "bodies". InputError.
  void take_body(const Section& bodies, const Registry<ContourShape>& contours);
  GlobalMesh generate() const override;

 private:
  /// Part of the boundary, in the direction that has the soil on the left.
  struct Curve {
    std::string set;
    double length;                                 // [m]
    std::function<PlanePoint(double s)> point_at;  // s [m] from its start
  };
  std::vector<Curve> boundary() const;
  /// The parts of the contour below the mudline, from the mudline down to the tip.
  std::vector<Curve> hole() const;
  /// Wanted length of the sides at a point [m].
  double size(const PlanePoint& x) const;
  /// Divides a curve: arc lengths of the ends of its sides.
  std::vector<double> divided(const Curve& curve) const;

  std::string body_, region_ = "soil";
  double width_ = 0, depth_ = 0, mudline_ = 0;
  double near_size_ = 0, near_distance_ = 0, growth_ = 0.15, largest_ = 0;  // sizes
  double time_limit_ = 600;
  int order_ = 2;
  SourcePosition position_;
  std::shared_ptr<const Contour> contour_;
  PlanePoint place_{};  // of the contour's origin
};

}  // namespace mudline
