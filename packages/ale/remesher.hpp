#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ale/boundary_motion.hpp"
#include "ale/remeshed_mesh.hpp"
#include "ale/wanted_sizes.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// Parameters of the deck's "remeshing".
struct RemeshingParameters {
  /// Source of the wanted sizes: the deck's mesh and the distance from its boundary, or an error estimate.
  enum class Size { source, adaptive };
  void parameters(Parameters& p);
  Size size = Size::source;
  double quality_below = 0.2, side_above = 2, wall_size = 0, growth = 0.3, time_limit = 60;
  double smallest_size = 0, largest_size = 0;
  int least_steps = 10;
};

/// A path divided into new sides.
struct DividedPath {
  std::vector<Vec<double, 2>> vertices;        // the ends among them
  std::vector<Vec<double, 2>> mid_side_nodes;  // (side) of quadratic elements
};

/// Regions and side sets on either side of a path.
struct PathNeighbours {
  int left = -1, right = -1;  // blocks; -1: outside
  std::set<std::string> left_sets, right_sets;
};

/// Remeshes the regions within their present boundary. In the plane the paths are divided into sides of the wanted
/// size, and the regions between them into triangles whose size grows away from the boundary. The wanted length of a
/// side is that of the side at the same share of the path in the deck's mesh, by the same measure around the focus, and
/// at a body at most the wall size; or, where sizes are adaptive, the length that an error estimate asks for. Ends of
/// paths and nodes of material sides stay where they are. In space the surfaces between the boundary's curves get new
/// faces of the size of those in the deck's mesh, with the same focus and wall size, see SurfaceRemesher, and the
/// inside is filled with tetrahedra of the size of the faces beside them, growing away from them; the better of two
/// meshes is taken. Blocks, side sets and node sets keep their names.
class Remesher {
 public:
  /// Checks that this mesh can be remeshed. `boundary` and `mesh` must outlive it. InputError in `section`.
  Remesher(const GhostedMesh& mesh, const BoundaryMotion& boundary, const RemeshingParameters& deck,
           const Section& section);

  const RemeshingParameters& deck() const { return deck_; }
  const GhostedMesh& mesh() const { return mesh_; }
  const BoundaryMotion& boundary() const { return boundary_; }
  const PathNeighbours& beside(std::size_t path) const { return beside_[path]; }
  /// Whether a node is fixed, see fixed_nodes().
  bool fixed(int node) const { return fixed_node_[node] != 0; }

  /// Side sets, in space, of a block's sides on a patch.
  const std::set<std::string>& names(int patch, int block) const { return names_.at({patch, block}); }

  bool in_space() const { return mesh_.dimension() == 3; }
  bool adaptive() const { return deck_.size == RemeshingParameters::Size::adaptive; }
  /// The largest ratio of a side of the boundary, in space of an edge, to its wanted length; error estimates do not
  /// count.
  double largest_side(const Positions& x, const State& state) const;
  /// A path at x divided into new sides. `sizes`: of an error estimate where sizes are adaptive, else null.
  DividedPath divided(std::size_t path, const Positions& x, const State& state, const WantedSizes* sizes) const;
  /// In space: the wanted length of edges of the boundary [m] at a place, by the relative size there, see
  /// BoundaryMotion::relative_sizes().
  std::function<double(double relative, const Point& at)> wanted_on_surface(const State& state) const;
  /// A mesh within the boundary at x, whose elements all have a scaled Jacobian of at least `least_quality`; `number`
  /// and `step` are not set. Throws NoTriangulation, and ChildLost where the Gmsh process fails. Serial, pure.
  RemeshedMesh make(const Positions& x, const State& state, double least_quality, const WantedSizes* sizes) const;

 private:
  void find_neighbours();
  void find_names(const Section& section);
  void check(const Section& section) const;
  void check_space(const Section& section) const;
  void check_sets(const Section& section) const;
  double largest_edge(const Positions& x, const State& state) const;
  /// The size, limited near a body by the wall size [m].
  double at_wall(double size, const Point& at, const State& state) const;
  /// Number of sides of each side set that a new mesh can name again.
  std::map<std::string, double> named_sides() const;
  /// Wanted length of a side at a place s of a path's curve.
  std::function<double(double s)> wanted(std::size_t path, const PathCurve& curve, const State& state,
                                         const WantedSizes* sizes) const;

  const GhostedMesh& mesh_;
  const BoundaryMotion& boundary_;
  RemeshingParameters deck_;
  std::vector<PathNeighbours> beside_;                          // (path)
  std::map<std::pair<int, int>, std::set<std::string>> names_;  // in space: by patch and block
  std::vector<char> fixed_node_;
};

}  // namespace mudline
