#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "ale/mesh_paths.hpp"
#include "core/registry.hpp"

namespace mudline {

/// The triangles that the corners of the elements span: a triangle itself, or the four corners of a quadrilateral. The
/// mesh motion works on these; middle nodes follow. A curved side on a path spans two more, of the element's corner
/// opposite and the side's tangents at its ends, whose areas are the Jacobians there: a side that bulges into a flat
/// element counts as bad before it folds. The ends of these tangents are further positions behind those of the nodes.
class CornerTriangles {
 public:
  CornerTriangles(const GhostedMesh& mesh, const std::vector<MeshPath>& paths);
  /// Sets the tangents' ends behind the nodes' positions; `curve` holds the paths' nodes, middle ones among them.
  void add_tangents(const Positions& curve, Positions& x) const;

  std::vector<std::array<int, 3>> triangles;  // positions, counter-clockwise; those of the elements first
  int of_elements = 0;                        // how many
  std::vector<std::vector<int>> at_node;      // (node) triangles that touch it

 private:
  struct Tangent {
    int at, other, middle;
  };
  int nodes_;
  std::vector<Tangent> tangents_;
};

/// Twice the signed area of a triangle [m2].
double twice_area(const std::array<int, 3>& triangle, const Positions& x);

/// What an interior motion may look at. Positions are those of nodes, then of tangents' ends.
struct InteriorMesh {
  const GhostedMesh& mesh;
  const CornerTriangles& corners;
  const Positions& source;                       // of the source's mesh
  const Positions& before;                       // before any node of this relocation moved
  const std::vector<char>& movable;              // (node) vertices that are free to move
  const std::vector<std::vector<int>>& colours;  // those of this rank: see vertex_colours()
  double time = 0;                               // [s] of the state that the mesh carries
};

/// Places the vertices inside when those on paths have moved: type of the deck's "mesh motion".
class InteriorMotion {
 public:
  virtual ~InteriorMotion() = default;
  /// `x` holds the boundary's new positions and the interior's old ones, and no triangle of it is folded. Collective;
  /// the result does not depend on the number of ranks.
  virtual void move(const InteriorMesh& mesh, Positions& x) const = 0;
};

/// When passes over the vertices end.
struct SweepLimits {
  int sweeps = 40;
  double tolerance = 1e-3;
  void parameters(Parameters& p);
};

/// Passes over the vertices that may move, colour after colour, to and fro. `place` gives a vertex of `x` its new place
/// and returns how far that is, as a share of its elements' size. Collective.
void sweep_by_colours(const InteriorMesh& mesh, const SweepLimits& limits, Positions& x,
                      const std::function<double(int node)>& place);

/// Vertex by vertex, lowers the sum of squared inverse mean ratios of the triangles around it (Knupp 2001; Freitag &
/// Knupp 2002), mu = |T|^2 / (2 det T), T the map from the ideal triangle: 1 at best, infinite for a flat triangle, so
/// that no element ever folds. The ideal is the equilateral triangle or the triangle of the source's mesh; size is
/// free.
class OptimisationMotion : public InteriorMotion {
 public:
  void parameters(Parameters& p);
  void move(const InteriorMesh& mesh, Positions& x) const override;

 private:
  enum class Ideal { equilateral, source };
  Ideal ideal_ = Ideal::source;
  SweepLimits limits_;
};

/// The map from the source's mesh is harmonic in the inverse direction (Winslow 1967): vertex by vertex, lowers its
/// Dirichlet energy, the sum of mu weighted by the areas of the source's triangles. As smooth as Laplace's, and no
/// element folds.
class WinslowMotion : public InteriorMotion {
 public:
  void parameters(Parameters& p) { limits_.parameters(p); }
  void move(const InteriorMesh& mesh, Positions& x) const override;

 private:
  SweepLimits limits_;
};

/// Every vertex goes to the mean of its neighbours. Simple, and may fold elements at re-entrant corners.
class LaplaceMotion : public InteriorMotion {
 public:
  void parameters(Parameters& p) { limits_.parameters(p); }
  void move(const InteriorMesh& mesh, Positions& x) const override;

 private:
  SweepLimits limits_{200, 1e-4};
};

/// Elastic re-analysis (Nazem, Sheng & Carter 2006): the mesh as a plane elastic body whose boundary is displaced, from
/// the source's mesh or from the present one; the stiffness of a triangle is inverse to its area, so that small
/// elements survive.
class ElasticMotion : public InteriorMotion {
 public:
  void parameters(Parameters& p);
  void move(const InteriorMesh& mesh, Positions& x) const override;

 private:
  enum class From { source, present };
  From from_ = From::source;
  double poisson_ = 0.3;
};

/// The elastic motion, and on top a swing of every vertex about its place by a share of the smallest side around it: no
/// use but to show what the remap does to a solution.
class ArtificialMotion : public ElasticMotion {
 public:
  void parameters(Parameters& p);
  void move(const InteriorMesh& mesh, Positions& x) const override;

 private:
  double amplitude_ = 0.1, period_ = 1;
};

void register_interior_motions(Registry<InteriorMotion>& registry);

}  // namespace mudline
