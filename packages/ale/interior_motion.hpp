#pragma once

#include <memory>
#include <vector>

#include "ale/whole_mesh.hpp"
#include "core/registry.hpp"

namespace mudline {

/// The triangles that the corners of the elements span: a triangle itself, or the four corners of a quadrilateral. The
/// mesh motion works on these; middle nodes follow.
struct CornerTriangles {
  explicit CornerTriangles(const WholeMesh& mesh);
  std::vector<std::array<int, 3>> triangles;  // global nodes, counter-clockwise
  std::vector<std::vector<int>> at_node;      // (node) triangles that touch it
};

/// Twice the signed area of a triangle [m2].
double twice_area(const std::array<int, 3>& triangle, const Positions& x);

/// What an interior motion may look at.
struct InteriorMesh {
  const CornerTriangles& corners;
  const Positions& source;           // of the source's mesh
  const Positions& before;           // before any node of this relocation moved
  const std::vector<char>& movable;  // (node) vertices that are free to move
};

/// Places the vertices inside when those on paths have moved: type of the deck's "mesh motion".
class InteriorMotion {
 public:
  virtual ~InteriorMotion() = default;
  /// `x` holds the boundary's new positions and the interior's old ones, and no triangle of it is folded. Serial, pure.
  virtual void move(const InteriorMesh& mesh, Positions& x) const = 0;
};

/// Vertex by vertex, lowers the sum of squared inverse mean ratios of the triangles around it (Knupp 2001; Freitag &
/// Knupp 2002), mu = |T|^2 / (2 det T), T the map from the ideal triangle: 1 at best, infinite for a flat triangle, so that
/// no element ever folds. The ideal is the equilateral triangle or the triangle of the source's mesh; size is free.
class OptimisationMotion : public InteriorMotion {
 public:
  void parameters(Parameters& p);
  void move(const InteriorMesh& mesh, Positions& x) const override;

 private:
  enum class Ideal { equilateral, source };
  Ideal ideal_ = Ideal::source;
  int sweeps_ = 40;
  double tolerance_ = 1e-3;
};

/// Every vertex goes to the mean of its neighbours. Simple, and may fold elements at re-entrant corners.
class LaplaceMotion : public InteriorMotion {
 public:
  void parameters(Parameters& p);
  void move(const InteriorMesh& mesh, Positions& x) const override;

 private:
  int sweeps_ = 200;
  double tolerance_ = 1e-4;
};

/// Elastic re-analysis (Nazem, Sheng & Carter 2006): the mesh as a plane elastic body whose boundary is displaced, from
/// the source's mesh or from the present one; the stiffness of a triangle is inverse to its area, so that small elements
/// survive.
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
