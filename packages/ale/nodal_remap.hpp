#pragma once

#include <utility>
#include <vector>

#include "ale/mesh_paths.hpp"
#include "ale/surface_motion.hpp"

namespace mudline {

/// Place on a side, in [-1, 1], nearest to x, and its distance [m]. `nodes`: ends, middle or -1.
std::pair<double, double> nearest_on_side(const int (&nodes)[3], const Positions& positions, const Point& x);

/// How the values at the nodes of the old mesh make those at the moved nodes: rows of a sparse interpolation, by the
/// shape functions of the field in the old mesh. The values of nodes on paths and surfaces come from these alone, so
/// that what is prescribed along them stays as it is; nodes that did not move keep theirs to the last bit. Every rank
/// makes its own nodes' values.
class NodalRemap {
 public:
  /// `surfaces`: in space, of which the paths are the edges.
  NodalRemap(const GhostedMesh& mesh, const std::vector<MeshPath>& paths, const Positions& x_old,
             const Positions& x_new, const SurfaceMotion* surfaces = nullptr);
  /// A mesh and what its boundary is made of; in the plane there are no faces.
  struct Bounded {
    const GhostedMesh& mesh;
    std::vector<MeshPath> paths;
    std::vector<SurfaceFace> faces;
    const Positions& x;
  };
  /// Another mesh of the same regions, with the same paths and patches in the same order. `from`: has what lies where
  /// this rank's nodes of the other one are.
  NodalRemap(const Bounded& from, const Bounded& to);
  /// `support`: which nodes carry the field; (node, component) in and out. `limited`: no value beyond those it is made
  /// of, for fields that jump from one node to the next, where quadratic shape functions overshoot remap by remap;
  /// smooth fields lose their peaks by it. Collective.
  std::vector<double> apply(const std::vector<double>& old, int components, Support support,
                            bool limited = false) const;

 private:
  struct Place {
    int same = -1;  // node of the old mesh that is at its place
    int element = -1;
    double xi[3] = {0, 0, 0};
    CellShape side{};  // of the old boundary, for nodes on paths and surfaces
    std::array<int, 9> side_nodes{-1};
    FacePlace along{};
  };
  /// The nearest place on sides of an old path, from the vertex `first` to the vertex `last`.
  void put_on_path(const MeshPath& path, int first, int last, const Positions& x_old, const Point& x,
                   Place& place) const;
  void put_on_new_path(const MeshPath& old, const MeshPath& made, const Positions& x_old, const Positions& x_new);
  void put_on_new_faces(const Bounded& from, const Bounded& to);

  const GhostedMesh &mesh_, &to_;
  std::vector<Place> places_;
};

}  // namespace mudline
