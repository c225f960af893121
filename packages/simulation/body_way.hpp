#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ale/ghosted_mesh.hpp"
#include "simulation/model.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// Where a body stands, where the deck sends it, and what it meets there, as far as that is known before the run: the
/// prescribed motions of its stages, up to the first in which it is released.
class BodyWay {
 public:
  struct Place {
    double time;                  // [s]
    Vec<double, 2> displacement;  // [m]
  };
  /// Collective for the caller's `mesh` only.
  BodyWay(const Model& model, const RigidBody& body, const GhostedMesh& mesh, const Positions& positions);

  const RigidBody& body() const { return body_; }
  /// Largest radius of the contour, or half its width [m].
  double radius() const { return radius_; }
  /// False where no contact can press the body.
  bool touches_anything() const { return !surface_.empty(); }
  /// Distance to the surfaces of its contacts [m] where it starts.
  double first_gap() const { return gap({0, 0}); }
  /// Prescribed places, the start first.
  const std::vector<Place>& places() const { return places_; }
  /// The law of motion of the first stage that releases it, null: none does, and how long it then is free [s].
  const ReleasedMotion* release() const { return release_ ? release_->released() : nullptr; }
  double free_time() const { return free_time_; }
  /// Place where it first touches; empty: it does not by prescribed motion.
  std::optional<std::size_t> arrival() const;
  /// Whether its motion takes it away from the soil only.
  bool leaves() const;
  /// The greatest speed between neighbouring places [m/s].
  double largest_speed() const;
  /// A point of a region's boundary within the soil that the body would have to pass, with the regions on both sides;
  /// "": none. `below`: that far below the released body [m].
  std::string crossing() const;
  std::string crossing_below(double below) const;
  /// How a released body starts: velocity and acceleration in y [m/s, m/s2].
  std::pair<double, double> start_of_fall() const;
  /// Sides of the surfaces under the body, of the caller's mesh, and the radius of the surface's corner that fits it
  /// best (0: it has none).
  const std::vector<const GhostedMesh::BoundarySide*>& sides_under() const { return under_; }
  double surface_corner() const { return corner_; }
  /// Heights [m]: the top of those surfaces, and the lowest that the body may come to, for a released one the mesh's.
  double surface_top() const { return top_; }
  double lowest() const;

 private:
  struct Boundary {
    Vec<double, 2> at, along;
    std::string name;
  };
  void follow(const Model& model);
  void find_surface(const Model& model, const GhostedMesh& mesh);
  void find_corner(const GhostedMesh& mesh, const std::string& surface);
  void find_boundaries(const Model& model, const GhostedMesh& mesh);
  double gap(const Vec<double, 2>& displacement) const;
  ContourFoot foot_at(const Vec<double, 2>& displacement, const Vec<double, 2>& point) const;
  double gap_at(const Vec<double, 2>& displacement, const Vec<double, 2>& point) const {
    return foot_at(displacement, point).gap;
  }

  const RigidBody& body_;
  const Positions& positions_;
  std::vector<Place> places_;
  std::shared_ptr<const BodyMotion> release_;
  double radius_ = 0, free_time_ = 0, corner_ = 0, reach_ = 0, top_ = -1e300;
  std::vector<const GhostedMesh::BoundarySide*> under_;
  std::vector<int> surface_;  // nodes of the contacts' surfaces
  std::vector<Boundary> boundaries_;
};

}  // namespace mudline
