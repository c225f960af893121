#pragma once

#include <vector>

#include "ale/face_place.hpp"
#include "ale/kept_gaps.hpp"
#include "ale/mean_ratio.hpp"
#include "ale/mesh_surfaces.hpp"
#include "ale/patch_plane.hpp"

namespace mudline {

/// Slides the nodes inside the surface patches of a mesh in space along the deformed surface, which is that of the
/// faces, curved as they are. Vertex by vertex, in its tangent plane, lowers the sum of squared inverse mean ratios of
/// the triangles that the corners of the faces span, also with the tangents of curved edges between patches, mu = |T|^2
/// / (2 |t_1 x t_2|), T = (t_1, t_2) the map from the triangle of the source's mesh (see OptimisationMotion), and puts
/// it back on the surface. Tetrahedra that have all their corners on surfaces count as well, with the tetrahedra of the
/// tangents of their curved edges, as for OptimisationMotion: nothing inside could repair them. Sizes are free, and a
/// surface that was only moved or turned stays to the last bit. Mid-side nodes of edges go to the middle of their ends,
/// along the normal to the surface, but bulge by no more than a tenth of the edge.
///
/// A plane patch stays plane, to the last bit where the plane is normal to an axis. On other patches a node that is
/// nearer to a body than a quarter of an edge keeps the gap that was at its new place, so that contact pressures are
/// not disturbed.
class SurfaceMotion {
 public:
  SurfaceMotion() = default;
  /// `largest_slide`: share of the way to the opposite edges of the faces around that a vertex moves at most at once.
  /// `slides`: (patch) whether its nodes may.
  /// `simplices`: those of the elements that have no vertex inside.
  SurfaceMotion(MeshSurfaces surfaces, const Positions& source, std::vector<char> slides, double largest_slide,
                const std::vector<BoundarySimplex>& simplices = {});

  /// `x_old`: all nodes before they move. `x`: the same, but for the nodes of curves, which are where they are wanted;
  /// becomes the new places of the nodes on surfaces. Where a curve's motion would fold faces or such tetrahedra,
  /// its nodes go only as far as the others can follow.
  void move(const Positions& x_old, const BodySearch& body, Positions& x) const;
  /// Nearest place of the old surface to a node inside a patch that is at `x` now.
  SurfacePlace place(int node, const Positions& x_old, const Point& x) const;

  const MeshSurfaces& surfaces() const { return surfaces_; }
  /// Nodes inside the sliding patches of the mesh's outer boundary, and the length of the edge that a middle is on, or
  /// of the shortest edge at a vertex [m].
  std::vector<std::pair<int, double>> outer_nodes(const Positions& x) const;
  /// Nodes inside sliding patches.
  std::vector<int> nodes() const;

 private:
  /// An end of a curved edge between patches: its tangent there ends at a further position behind those of the nodes.
  struct Tangent {
    int at, other, middle;
  };
  /// What a corner of a face strives for: T = sum over its three nodes v of x_v w_v^T.
  struct Corner {
    std::array<int, 3> nodes;
    double w[3][2];
  };
  /// A tetrahedron at a corner of an element that has no vertex inside.
  struct Tetrahedron {
    BoundarySimplex on;
    IdealSimplex<3> ideal;
  };
  /// A middle of an edge or of a face inside a patch.
  struct MidSideNode {
    int node;
    std::vector<int> ends;                        // corners
    std::vector<int> sides;                       // mid-side nodes of the face's edges; empty for an edge
    double drift = 0;                             // see drift_of(), in the source's mesh
    std::vector<std::pair<int, FacePlace>> on{};  // its places on faces
  };
  struct Patch {
    std::vector<int> vertices, faces;
    std::vector<MidSideNode> mid_side_nodes;
  };
  class Step;  // one relocation

  void collect(Positions source);
  /// Of the source's mesh, to which ends of tangents are added.
  void add_corners(const SurfaceFace& face, Positions& source);
  void add_tetrahedron(const BoundarySimplex& simplex, const Positions& source);
  static std::array<Point, 4> corners_of(const BoundarySimplex& simplex, const Positions& x);
  static Point tangent_end(const Tangent& tangent, const Positions& x);
  void add_tangents(Positions& x) const;
  void add_corner(const std::array<int, 3>& nodes, const Positions& source);
  void add_curve_mid_side_nodes(const std::vector<std::vector<int>>& touching);
  /// Puts a middle on the faces that touch it.
  void put_on(MidSideNode& middle, const std::vector<int>& faces) const;
  /// Node a of a face is inside the patch.
  void add_node(const SurfaceFace& face, int a, Patch& patch);
  std::vector<int> faces_near(int node, const std::vector<std::vector<int>>& touching) const;
  static double edge_of(const MidSideNode& middle, const Positions& x);
  /// Between its ends, along straight edges.
  static Point middle_of(const MidSideNode& middle, const Positions& x);
  /// Mean of its faces, of length 1.
  Point normal_at(const MidSideNode& middle, const Positions& x) const;
  /// How far it is along the surface from there, as a share of the edge.
  double drift_of(const MidSideNode& middle, const Positions& x) const;
  double shortest_edge(int node, const Positions& x) const;
  Point at(const SurfacePlace& place, const Positions& x) const;
  /// `guess`: face to look at first; -1: none.
  SurfacePlace nearest(int node, int guess, const Positions& x_old, const Point& point) const;

  MeshSurfaces surfaces_;
  std::vector<char> slides_;  // (patch)
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
