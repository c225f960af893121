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

/// Places for a path's nodes: on a smooth curve through their present places, with the gap that the curve has there to
/// the nearest body. A path on the axis of symmetry stays on it exactly: rounding of a body's normal at its tip would
/// move nodes beyond the axis. In space a path in a plane normal to a coordinate axis stays in that plane exactly.
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
  std::vector<double> gaps_;    // (point) [m] to the nearest body; empty: there is none
  SharedCoordinates of_all_{};  // coordinates that all nodes of the path share: in space, and on the axis of symmetry
};

/// Slides the nodes of every path along the deformed boundary, which is a smooth curve through them. Each side keeps
/// its share of the path, measured in sides of a wanted size that is uniform, or finer near a focus that moves with a
/// body: size = near + growth (distance - near distance). The shares are those of the source's mesh, so that a boundary
/// at rest stays as it is. Where the boundary touches a body, nodes keep the gap that was at their new place, so that
/// contact pressures are not disturbed. In space the paths are the edges of the boundary's surfaces, on which the other
/// nodes follow, see SurfaceMotion.
class BoundaryMotion {
 public:
  void parameters(Parameters& p);
  /// Finds paths and shares, in space surfaces too. InputError for unknown bodies and sets. Errors are thrown on all
  /// ranks. `remeshed`: the source mesh is the result of a remeshing, whose paths are known; null: it is the deck's.
  void bind(const GhostedMesh& mesh, const Positions& source,
            const std::map<std::string, std::shared_ptr<RigidBody>>& bodies, const Section& section,
            const RemeshedMesh* remeshed);

  /// New positions of the nodes on paths, in space also on surfaces, mid-side nodes included; the others as in `x`.
  Positions move(const Positions& x, const State& state) const;
  /// The boundaries of the regions, on which this has marked what stays material.
  const MeshSurfaces& parts() const { return surfaces_.surfaces(); }
  const std::vector<MeshPath>& paths() const { return parts().curves; }
  const SurfaceMotion& surfaces() const { return surfaces_; }
  /// (path) the sides that it had in the deck's mesh.
  const std::vector<PathOrigin>& origins() const { return origins_; }
  /// (node) in space, set at vertices of the boundary: edge length in the deck's mesh over the size field there [-].
  /// The edge length is that of a regular triangle with the area of a face, in the mean of the faces around.
  const std::vector<double>& relative_sizes() const { return relative_sizes_; }
  bool axisymmetric() const { return axisymmetric_; }
  bool in_space() const { return in_space_; }
  /// Position of the focus [m]; the origin where there is none.
  Point focus(const State& state) const;
  /// Wanted sizes around the focus; only their ratios count.
  SizeField size_field(const Point& focus) const;
  /// Gap and normal of the nearest body; nothing where there are no bodies.
  std::optional<NearBody> projection(const State& state, const Point& x) const;
  /// (node) how freely a node of the mesh's outer boundary may move to conserve volume, 0 to 1: 1 where it slides and
  /// is farther from every body than twice the length of the two sides beside it, 0 where it is nearer than that
  /// length.
  std::vector<double> freedom(const Positions& x, const State& state) const;

 private:
  bool starts_on_body(const Point& x) const;
  MeshSurfaces deck_parts(const GhostedMesh& mesh, const Positions& source) const;
  MeshSurfaces remeshed_parts(const GhostedMesh& mesh, const RemeshedMesh& remeshed) const;
  std::set<int> corner_nodes(const GhostedMesh& mesh) const;
  /// Whether the nodes of sides that belong to these sets stay material points.
  bool material(const std::set<std::string>& sets) const;
  /// See relative_sizes().
  std::vector<double> remeshed_sizes(const GhostedMesh& mesh, const RemeshedMesh& remeshed) const;
  std::vector<double> deck_sizes(const Positions& source, const SizeField& size) const;
  void move_path(std::size_t path, const State& state, const SizeField& size, Positions& x) const;

  std::string focus_;
  bool axisymmetric_ = false, in_space_ = false;
  double near_size_ = 0, near_distance_ = 0, growth_ = 0.3, largest_slide_ = 0.4, corner_angle_ = 30;
  std::vector<std::string> corners_, material_sides_;
  std::vector<PathOrigin> origins_;
  std::vector<std::vector<double>> shares_;  // (path, vertex) measure in the source's mesh, as a share of the total
  SurfaceMotion surfaces_;                   // it keeps the paths too
  std::vector<double> relative_sizes_;       // in space
  std::map<std::string, std::shared_ptr<RigidBody>> bodies_;
};

}  // namespace mudline
