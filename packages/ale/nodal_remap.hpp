#pragma once

#include <optional>
#include <vector>

#include "ale/mesh_paths.hpp"
#include "ale/point_locator.hpp"
#include "ale/surface_motion.hpp"

namespace mudline {

/// Interpolation of nodal values from the old mesh at the moved nodes, by the shape functions of the field in the old
/// mesh. Nodes on paths and surfaces get values from the nodes of these alone, so that values prescribed along them do
/// not change; nodes that did not move keep their values to the last bit. Every rank computes the values of its own
/// nodes.
class NodalRemap {
 public:
  /// `surfaces`: in space, the surfaces whose edges are the paths.
  NodalRemap(const GhostedMesh& mesh, const std::vector<MeshPath>& paths, const Positions& x_old,
             const Positions& x_new, const SurfaceMotion* surfaces = nullptr);
  /// A mesh and its boundary; in the plane there are no faces.
  struct Bounded {
    const GhostedMesh& mesh;
    std::vector<MeshPath> paths;
    std::vector<SurfaceFace> faces;
    const Positions& x;
  };
  /// Interpolation to another mesh of the same regions, with the same paths and patches in the same order. `from` must
  /// have the elements where this rank's nodes of `to` are.
  NodalRemap(const Bounded& from, const Bounded& to);
  /// Interpolation to nodes of another mesh, with the places of this rank's own nodes in the old one.
  NodalRemap(const GhostedMesh& from, const GhostedMesh& to, const std::vector<std::pair<int, MeshPlace>>& places);
  /// `support`: which nodes carry the field; (node, component) in and out. `limited`: each value stays within the range
  /// of those it is interpolated from, for fields that jump from node to node, where quadratic shape functions
  /// overshoot more with every remap; it clips the peaks of smooth fields. Collective.
  std::vector<double> apply(const std::vector<double>& old, int components, Support support,
                            bool limited = false) const;
  /// Rows of an array at nodes by the rules of its variables. `old`: (node, column), `has`: (node) 1 where there is a
  /// row. A value that would be interpolated from a node without a row is that of the nearest node with one. Where the
  /// mesh moved, a total stays with its node.
  std::vector<double> of_rows(const std::vector<double>& old, const std::vector<double>& has,
                              const std::vector<StateVariable>& variables) const;

 private:
  struct Place {
    int same = -1;  // node of the old mesh at the same place
    MeshPlace inside;
    std::optional<CurvedSide> side;  // of the old boundary, for nodes on paths and surfaces
    FacePlace along{};               // on the side
  };
  /// Sets the place to the closest point on the sides of an old path between the vertices `first` and `last`.
  void put_on_path(const MeshPath& path, int first, int last, const Positions& x_old, const Point& x,
                   Place& place) const;
  /// The nodes from which a place takes its values, with their weights.
  struct Sources {
    CellShape shape;
    const double* xi;  // the place in reference coordinates
    int count;
    const int* nodes;
    double weight[27];
    /// Square of the distance of a node in reference coordinates.
    double away(int a) const;
  };
  Sources sources(const Place& place, Support support) const;
  void put_on_new_path(const MeshPath& old, const MeshPath& made, const Positions& x_old, const Positions& x_new);
  void put_on_new_faces(const Bounded& from, const Bounded& to);

  const GhostedMesh &mesh_, &to_;
  std::vector<Place> places_;
};

}  // namespace mudline
