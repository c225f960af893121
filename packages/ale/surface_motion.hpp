#pragma once

#include <vector>

#include "ale/fixed_gaps.hpp"
#include "ale/mean_ratio.hpp"
#include "ale/mesh_surfaces.hpp"
#include "ale/patch_plane.hpp"

namespace mudline {

/// Slides the nodes inside the surface patches of a mesh in space along the deformed surface, which consists of the
/// curved faces. Vertex by vertex, in its tangent plane, it lowers the sum of squared inverse mean ratios of the
/// triangles that the corners of the faces span, also with the tangents of curved edges between patches, mu = |T|^2 /
/// (2 |t_1 x t_2|), T = (t_1, t_2) the map from the triangle of the source's mesh (see OptimisationMotion), and puts
/// the vertex back on the surface. Tetrahedra that have all their corners on surfaces count as well, with the tangents
/// of their curved edges, as for OptimisationMotion: no inner vertex could repair them. Sizes do not count, and the
/// nodes of a surface that only moved or rotated stay to the last bit. Mid-side nodes of edges go to the middle of
/// their ends, along the normal to the surface, but bulge by no more than a tenth of the edge.
///
/// A plane patch stays plane, to the last bit where the plane is normal to an axis. On other patches a node that is
/// nearer to a body than a quarter of an edge keeps the gap that was at its new place, so that contact pressures are
/// not disturbed.
class SurfaceMotion {
 public:
  SurfaceMotion() = default;
  /// `largest_slide`: largest motion of a vertex at once, as a share of the distance to the opposite edges of the faces
  /// around. Nodes of material patches do not slide. `simplices`: those of the elements that have no vertex inside.
  SurfaceMotion(MeshSurfaces surfaces, const Positions& source, double largest_slide,
                const std::vector<BoundarySimplex>& simplices = {});

  /// `x_old`: all nodes before they move. `x`: on entry the same, but with the nodes of curves at their wanted places;
  /// on exit with the new places of the nodes on surfaces. Where a curve's motion would fold faces or such tetrahedra,
  /// its nodes go only as far as the others can follow.
  void move(const Positions& x_old, const BodySearch& body, Positions& x) const;
  /// Closest point on the old surface to a node inside a patch that is at `x` now.
  SurfacePlace place(int node, const Positions& x_old, const Point& x) const;

  const MeshSurfaces& surfaces() const { return surfaces_; }
  /// Nodes inside the sliding patches of the mesh's outer boundary, and the length [m] of a mid-side node's edge or of
  /// the shortest edge at a vertex.
  std::vector<std::pair<int, double>> outer_nodes(const Positions& x) const;
  /// Nodes inside sliding patches.
  std::vector<int> nodes() const;

 private:
  /// An end of a curved edge between patches: its tangent there ends at a further position behind those of the nodes.
  struct Tangent {
    int at, other, middle;
  };
  /// A corner of a face with the weights w of the map from its ideal triangle: T = sum over its three nodes v of x_v
  /// w_v^T.
  struct Corner {
    std::array<int, 3> nodes;
    double w[3][2];
  };
  /// A tetrahedron at a corner of an element that has no vertex inside.
  struct Tetrahedron {
    BoundarySimplex on;
    IdealSimplex<3> ideal;
  };
  /// A mid-side node of an edge, or the centre of a face, inside a patch.
  struct MidSideNode {
    int node;
    std::vector<int> ends;                        // corners
    std::vector<int> sides;                       // mid-side nodes of the face's edges; empty for an edge
    double drift = 0;                             // see drift_of(), in the source's mesh
    std::vector<std::pair<int, FacePlace>> on{};  // faces that it is a node of, and its place on each
  };
  struct Patch {
    std::vector<int> vertices, faces;
    std::vector<MidSideNode> mid_side_nodes;
  };
  class Step;  // one relocation

  void collect(Positions source);
  /// Adds the corners of a face; appends the ends of its tangents to `source`.
  void add_corners(const SurfaceFace& face, Positions& source);
  void add_tetrahedron(const BoundarySimplex& simplex, const Positions& source);
  static std::array<Point, 4> corners_of(const BoundarySimplex& simplex, const Positions& x);
  static Point tangent_end(const Tangent& tangent, const Positions& x);
  void add_tangents(Positions& x) const;
  void add_corner(const std::array<int, 3>& nodes, const Positions& source);
  void add_curve_mid_side_nodes(const std::vector<std::vector<int>>& touching);
  /// Sets the faces that a mid-side node belongs to.
  void put_on(MidSideNode& middle, const std::vector<int>& faces) const;
  /// Adds node a of a face, which is inside the patch.
  void add_node(const SurfaceFace& face, int a, Patch& patch);
  std::vector<int> faces_near(int node, const std::vector<std::vector<int>>& touching) const;
  static double edge_of(const MidSideNode& middle, const Positions& x);
  /// Its place between its ends if edges were straight [m].
  static Point middle_of(const MidSideNode& middle, const Positions& x);
  /// Unit mean of its faces' normals.
  Point normal_at(const MidSideNode& middle, const Positions& x) const;
  /// Its distance along the surface from middle_of(), as a share of the edge.
  double drift_of(const MidSideNode& middle, const Positions& x) const;
  double shortest_edge(int node, const Positions& x) const;
  Point at(const SurfacePlace& place, const Positions& x) const;
  /// `guess`: face to look at first; -1: none.
  SurfacePlace nearest(int node, int guess, const Positions& x_old, const Point& point) const;

  MeshSurfaces surfaces_;
  double largest_slide_ = 0.4;
  std::vector<Patch> patches_;  // those that slide
  std::vector<MidSideNode> curve_mid_side_nodes_;
  int nodes_ = 0;
  std::vector<Tangent> tangents_;
  std::vector<Corner> corners_;       // of their faces
  std::vector<std::vector<int>> at_;  // (node) corners that touch it
  std::vector<Tetrahedron> tetrahedra_;
  std::vector<std::vector<int>> tetrahedra_at_;  // (node)
  std::vector<std::vector<int>> near_;           // (node) faces that share a node with the faces around it
};

}  // namespace mudline
