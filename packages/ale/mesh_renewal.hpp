#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ale/boundary_motion.hpp"
#include "ale/renewed_mesh.hpp"
#include "ale/wanted_sizes.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// What the deck says of "remeshing".
struct RenewalParameters {
  /// What the wanted sizes come from: the deck's mesh and the distance from its boundary, or an error estimate.
  enum class Size { source, adaptive };
  void parameters(Parameters& p);
  Size size = Size::source;
  double quality_below = 0.2, side_above = 2, wall_size = 0, growth = 0.3, time_limit = 60;
  double smallest_size = 0, largest_size = 0;
  int least_steps = 10;
};

/// A path divided into new sides.
struct DividedPath {
  std::vector<Vec<double, 2>> vertices;  // the ends among them
  std::vector<Vec<double, 2>> middles;   // (side) of quadratic elements
};

/// What lies on either side of a path.
struct PathNeighbours {
  int left = -1, right = -1;  // blocks; -1: outside
  std::set<std::string> left_sets, right_sets;
};

/// Makes a mesh anew within the boundary as it is. In the plane the paths are divided into sides of the wanted size,
/// and the regions between them into triangles whose size grows away from the boundary. A side is wanted as long as the
/// one that was at its share of the path in the deck's mesh, by the same measure about the focus, and at a body no
/// longer than the wall size; or, where sizes are adaptive, as long as an error estimate asks for. Ends of paths and
/// nodes of material sides stay where they are. In space the surfaces between the edges of the boundary get new faces
/// of the size of those that were there in the deck's mesh, with the same focus and wall size, see SurfaceRemesher, and
/// the inside is filled with tetrahedra that are as large as the faces beside them and grow away from them; the better
/// one of two meshes is taken. Everything has its name again.
class MeshRenewal {
 public:
  /// Checks that this mesh can be made anew. `boundary` and `mesh` outlive it. InputError in `section`.
  MeshRenewal(const GhostedMesh& mesh, const BoundaryMotion& boundary, const RenewalParameters& deck,
              const Section& section);

  const RenewalParameters& deck() const { return deck_; }
  const GhostedMesh& mesh() const { return mesh_; }
  const BoundaryMotion& boundary() const { return boundary_; }
  const PathNeighbours& beside(std::size_t path) const { return beside_[path]; }
  /// Whether the path keeps its nodes.
  bool kept(std::size_t path) const { return boundary_.material(boundary_.paths()[path]); }
  /// Whether a node stays where it is.
  bool keeps(int node) const { return kept_node_[node] != 0; }

  /// In space: the side sets of a block's sides on a patch.
  const std::set<std::string>& names(int patch, int block) const { return names_.at({patch, block}); }

  bool in_space() const { return mesh_.dimension() == 3; }
  bool adaptive() const { return deck_.size == RenewalParameters::Size::adaptive; }
  /// The largest ratio of a side of the boundary, in space of an edge, to its wanted length; what an error asks for is
  /// left out.
  double largest_side(const Positions& x, const State& state) const;
  /// `sizes`: of an error estimate where sizes are adaptive, else null.
  DividedPath divided(std::size_t path, const Positions& x, const State& state, const WantedSizes* sizes) const;
  /// In space: the wanted length of edges of the boundary [m] at a place, by the relative size there, see
  /// BoundaryMotion::relative_sizes().
  std::function<double(double relative, const Point& at)> wanted_on_surface(const State& state) const;
  /// A mesh in the boundary at x, none of whose elements has a smaller scaled Jacobian than `least_quality`; without
  /// its numbers of meshes and steps. Throws NoTriangulation, and ChildLost where Gmsh is lost. Serial, pure.
  RenewedMesh make(const Positions& x, const State& state, double least_quality, const WantedSizes* sizes) const;

 private:
  void find_neighbours();
  void find_kept();
  void find_names(const Section& section);
  void check(const Section& section) const;
  void check_space(const Section& section) const;
  void check_sets(const Section& section) const;
  double largest_edge(const Positions& x, const State& state) const;
  /// No longer than the wall size allows.
  double at_wall(double size, const Point& at, const State& state) const;
  /// Sides of each set that will have their names again.
  std::map<std::string, double> named_sides() const;
  /// Wanted length of a side at a place s of a path's curve.
  std::function<double(double s)> wanted(std::size_t path, const PathCurve& curve, const State& state,
                                         const WantedSizes* sizes) const;

  const GhostedMesh& mesh_;
  const BoundaryMotion& boundary_;
  RenewalParameters deck_;
  std::vector<PathNeighbours> beside_;                          // (path)
  std::map<std::pair<int, int>, std::set<std::string>> names_;  // in space: by patch and block
  std::vector<char> kept_node_;
};

}  // namespace mudline
