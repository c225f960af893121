#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ale/ghosted_mesh.hpp"
#include "checks/body_way.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// The prescribed path of a body in the plane, and the surfaces and region boundaries that it meets.
class BodyPath : public BodyWay {
 public:
  /// Not collective, but making `mesh` is.
  BodyPath(BodyWay way, const Model& model, const GhostedMesh& mesh, const Positions& positions);

  /// Largest radius of the contour, or half its width [m].
  double radius() const { return radius_; }
  /// False where no contact can press the body.
  bool touches_anything() const { return !surface_.empty(); }
  /// Distance to the surfaces of its contacts [m] where it starts.
  double first_gap() const { return gap({}); }
  /// Index of the place at which the body first touches the soil; empty: prescribed motion does not bring it there.
  std::optional<std::size_t> arrival() const;
  /// Whether the prescribed motion only takes the body away from the soil.
  bool leaves() const;
  /// Names of the two regions whose common boundary the body would have to cross; "": none. `below`: distance [m] below
  /// the released body within which such a boundary counts.
  std::string crossing() const;
  std::string crossing_below(double below) const;
  /// Initial velocity [m/s] and acceleration [m/s2] of a released body in y.
  std::pair<double, double> start_of_fall() const;
  /// Sides of the caller's mesh under the body on its contacts' surfaces, and the radius [m] of the surface's corner
  /// that fits the body best (0: there is none).
  const std::vector<const GhostedMesh::BoundarySide*>& sides_under() const { return under_; }
  double surface_corner() const { return corner_; }
  /// Heights [m]: the top of those surfaces, and the lowest point that the body may reach; for a released body that of
  /// the mesh.
  double surface_top() const { return top_; }
  double lowest() const;

 private:
  struct Boundary {
    Vec<double, 2> at, along;
    std::string name;
  };
  void find_surface(const Model& model, const GhostedMesh& mesh);
  void find_corner(const GhostedMesh& mesh, const std::string& surface);
  void find_boundaries(const Model& model, const GhostedMesh& mesh);
  double gap(const Point& displacement) const;
  ContourProjection projection_at(const Point& displacement, const Vec<double, 2>& point) const;
  double gap_at(const Point& displacement, const Vec<double, 2>& point) const {
    return projection_at(displacement, point).gap;
  }

  const Positions& positions_;
  double radius_ = 0, corner_ = 0, reach_ = 0, top_ = -1e300;
  std::vector<const GhostedMesh::BoundarySide*> under_;
  std::vector<int> surface_;  // nodes of the contacts' surfaces
  std::vector<Boundary> boundaries_;
};

}  // namespace mudline
