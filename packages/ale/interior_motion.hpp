#pragma once

#include <memory>
#include <vector>

#include "ale/ghosted_mesh.hpp"
#include "ale/mesh_surfaces.hpp"
#include "core/registry.hpp"

namespace mudline {

/// A triangle or, in space, a tetrahedron of positions.
struct Simplex {
  std::array<int, 4> corner;
  int corners;

  int operator[](int i) const { return corner[i]; }
  const int* begin() const { return corner.data(); }
  const int* end() const { return corner.data() + corners; }
};

/// The simplices that the corners of the elements span with the edges there: a triangle or tetrahedron itself, or the
/// four corners of a quadrilateral, the eight of a hexahedron. The mesh motion works on these; middle nodes follow. A
/// curved edge on the boundary of a region spans more, with its tangents at its ends instead of its ends: their sizes
/// are the Jacobians there, so that an edge that bulges into a flat element counts as bad before the element folds. The
/// ends of these tangents are further positions behind those of the nodes.
class CornerSimplices {
 public:
  explicit CornerSimplices(const GhostedMesh& mesh);
  /// Sets the tangents' ends behind the nodes' positions; `curve` holds the nodes of the boundary, middle ones among
  /// them.
  void add_tangents(const Positions& curve, Positions& x) const;
  /// 2 or 3.
  int dimension() const { return simplices.front().corners - 1; }
  /// In space: of the whole mesh, on every rank in the same order, those whose nodes are all on boundaries of regions.
  /// Collective.
  std::vector<BoundarySimplex> on_boundary(const GhostedMesh& mesh) const;

  std::vector<Simplex> simplices;         // not folded where their determinants are positive; the elements' first
  int of_elements = 0;                    // how many
  std::vector<std::vector<int>> at_node;  // (node) simplices that touch it

 private:
  struct Tangent {
    int at, other, middle;
  };
  void add_curved_sides(const GhostedMesh& mesh, const GhostedMesh::Element& element);
  void add_curved_corners(const GhostedMesh& mesh, const GhostedMesh::Element& element);
  /// Adds the tangent at a node of the edge to another; the position of its end.
  int tangent(int at, int other, int middle);

  int nodes_;
  std::vector<Tangent> tangents_;
};

/// Determinant of the edges from the first corner: twice the signed area of a triangle [m2], six times the signed
/// volume of a tetrahedron [m3].
double determinant(const Simplex& simplex, const Positions& x);
/// Its root of the dimension, without the sign: a length [m].
double size(const Simplex& simplex, const Positions& x);

/// What an interior motion may look at. Positions are those of nodes, then of tangents' ends.
struct InteriorMesh {
  const GhostedMesh& mesh;
  const CornerSimplices& corners;
  const Positions& source;                       // of the source's mesh
  const Positions& before;                       // before any node of this relocation moved
  const std::vector<char>& movable;              // (node) vertices that are free to move
  const std::vector<std::vector<int>>& colours;  // see vertex_colours()
  double time = 0;                               // [s] of the state that the mesh carries
};

/// Places the vertices inside when those on paths have moved: type of the deck's "mesh motion".
class InteriorMotion {
 public:
  virtual ~InteriorMotion() = default;
  /// `x` holds the boundary's new positions and the interior's old ones, and no simplex of it is folded. Collective;
  /// the result does not depend on the number of ranks.
  virtual void move(const InteriorMesh& mesh, Positions& x) const = 0;
};

/// Vertex by vertex, lowers the sum of squared inverse mean ratios of the simplices around it (Knupp 2001; Freitag &
/// Knupp 2002), mu = |T|^2 / (d det T^(2/d)) in d dimensions, T the map from the ideal simplex: 1 at best, infinite for
/// a flat simplex, so that no element ever folds. The ideal is the regular simplex or that of the source's mesh; size
/// is free.
class OptimisationMotion : public InteriorMotion {
 public:
  enum class Ideal { equilateral, source };
  OptimisationMotion() = default;
  explicit OptimisationMotion(Ideal ideal) : ideal_(ideal) {}
  void parameters(Parameters& p);
  void move(const InteriorMesh& mesh, Positions& x) const override;

 private:
  template <int Dim>
  void sweep(const InteriorMesh& mesh, Positions& x) const;

  Ideal ideal_ = Ideal::source;
  int sweeps_ = 40;
  double tolerance_ = 1e-3;
};

/// Elastic re-analysis (Nazem, Sheng & Carter 2006): the mesh as an elastic body, in plane strain or in space, whose
/// boundary is displaced, from the source's mesh or from the present one; the stiffness of a simplex is inverse to its
/// size, so that small elements survive.
class ElasticMotion : public InteriorMotion {
 public:
  void parameters(Parameters& p);
  void move(const InteriorMesh& mesh, Positions& x) const override;

 private:
  enum class From { source, present };
  From from_ = From::source;
  double poisson_ = 0.3;
};

void register_interior_motions(Registry<InteriorMotion>& registry);

}  // namespace mudline
