#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ale/mesh_paths.hpp"
#include "ale/path_curve.hpp"
#include "ale/remeshed_mesh.hpp"
#include "ale/surface_motion.hpp"
#include "bodies/rigid_body.hpp"

namespace mudline {

class BoundaryMotion;

/// The places of a path's nodes: on a smooth curve through those of now, and at the gap to the nearest body that is
/// there now. What lies on the axis of symmetry stays there exactly: a body's normal at its tip is not parallel to the
/// axis to the last digit, and a mesh whose nodes are beyond the axis is none. In space so does what lies in a plane
/// normal to one of its axes.
class PathPlaces {
 public:
  PathPlaces(const BoundaryMotion& boundary, const MeshPath& path, const Positions& x, const State& state);
  const PathCurve& curve() const { return curve_; }
  /// Place at s [m] of a node between neighbours that are `span` [m] apart.
  Point at(double s, double span) const;

 private:
  const BoundaryMotion& boundary_;
  const State& state_;
  PathCurve curve_;
  std::vector<double> gaps_;    // (point) to the nearest body; empty: there is none
  SharedCoordinates of_all_{};  // what no node of the path leaves: in space, and on the axis of symmetry
};

/// Slides the nodes of every path along the deformed boundary, which is a smooth curve through them. Each side keeps
/// its share of the path, measured in sides of a wanted size that is uniform, or finer near a point that travels with a
/// body: size = near + growth (distance - near distance). The shares are those of the source's mesh, so that a boundary
/// at rest stays as it is. Where the boundary touches a body, nodes keep the gap that was at their new place, so that
/// contact pressures are not disturbed. In space the paths are the edges of the boundary's surfaces, on which the other
/// nodes follow, see SurfaceMotion.
class BoundaryMotion {
 public:
  void parameters(Parameters& p);
  /// Finds paths and shares, in space surfaces too. InputError for unknown bodies and sets.
  /// Collective only in its errors: the same everywhere.
  /// `remeshed`: the source is a mesh that was made on the way, whose paths are known; null: it is the deck's.
  void bind(const GhostedMesh& mesh, const Positions& source,
            const std::map<std::string, std::shared_ptr<RigidBody>>& bodies, const Section& section,
            const RemeshedMesh* remeshed);

  /// New positions of the nodes on paths, in space on surfaces, middle nodes among them; the others as in `x`.
  Positions move(const Positions& x, const State& state) const;
  const std::vector<MeshPath>& paths() const { return paths_; }
  const SurfaceMotion& surfaces() const { return surfaces_; }
  /// (path) what its sides were in the deck's mesh.
  const std::vector<PathOrigin>& origins() const { return origins_; }
  /// In space, (node) read at vertices of the boundary: wanted length of the edges there by the deck's mesh, in the
  /// mean of the faces around that of a regular triangle of their area, over the size by the focus.
  const std::vector<double>& relative_sizes() const { return relative_sizes_; }
  /// Whether a path's nodes stay material points.
  bool material(const MeshPath& path) const { return material(path.sets); }
  /// Whether sides that belong to these sets have such nodes.
  bool material(const std::set<std::string>& sets) const;
  bool axisymmetric() const { return axisymmetric_; }
  bool in_space() const { return in_space_; }
  /// Where the focus is; the origin without one.
  Point focus(const State& state) const;
  /// Wanted sizes about the focus; only their ratios count.
  SizeField size_field(const Point& focus) const;
  /// The nearest place on a body; nothing without bodies.
  std::optional<NearBody> projection(const State& state, const Point& x) const;
  /// (node) how freely a node of the mesh's outer boundary may give way, 0 to 1: all where it slides and is at least
  /// twice as far from every body as the sides beside it are long, not at all where it is as near as one of them.
  std::vector<double> freedom(const Positions& x, const State& state) const;

 private:
  bool starts_on_body(const Point& x) const;
  void bind_surfaces(const GhostedMesh& mesh, const Positions& source, const RemeshedMesh* remeshed);
  void take_sizes(const Positions& source, const SizeField& size);
  void move_path(std::size_t path, const State& state, const SizeField& size, Positions& x) const;

  std::string focus_;
  bool axisymmetric_ = false, in_space_ = false;
  double near_size_ = 0, near_distance_ = 0, growth_ = 0.3, largest_slide_ = 0.4, corner_angle_ = 30;
  std::vector<std::string> corners_, material_sides_;
  std::vector<MeshPath> paths_;
  std::vector<PathOrigin> origins_;
  std::vector<std::vector<double>> shares_;  // (path, vertex) measure in the source's mesh, as a share of the total
  std::vector<char> slides_;                 // (path)
  SurfaceMotion surfaces_;                   // in space
  std::vector<double> relative_sizes_;       // in space
  std::map<std::string, std::shared_ptr<RigidBody>> bodies_;
};

}  // namespace mudline
