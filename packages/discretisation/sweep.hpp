#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "discretisation/mesh.hpp"
#include "discretisation/source_position.hpp"

namespace mudline {

/// How a plane mesh is moved through space.
struct Sweep {
  int layers = 1;
  bool closed = false;  // the last layer ends where the first one starts
  bool turned = false;  // the plane's elements are clockwise as seen from the place that they move to
  /// Position of a point of the plane after a number of layers, which may end in a half [m].
  std::function<Point(const Point& plane, double layers)> place;
  std::vector<char> fixed;  // (node of the plane) 1 where it does not move
  bool wedges = false;      // triangles become wedges
};
/// Whether a triangle has one corner that does not move: it cannot become a wedge.
bool has_pointed_triangle(const GlobalMesh& plane, const std::vector<char>& fixed);

/// The mesh in space that a plane mesh sweeps out: quadrilaterals become hexahedra, or wedges where one of their sides
/// does not move; triangles become wedges, with face centres beside quadrilaterals, or prisms of three tetrahedra each,
/// which fit because every cut starts at the lower node number of the plane; where nodes do not move, the flat
/// tetrahedra are left out. Side sets become faces, point sets become the lines that their points trace,
/// regions stay. The faces at the ends are the side sets "start" and "end". A side set all of whose sides do not move
/// becomes a set of their points. Throws InputError for quadrilaterals, and triangles that should become wedges,
/// one corner of which does not move, and for sets named "start" or "end".
GlobalMesh swept(const GlobalMesh& plane, const Sweep& sweep);

/// The section "plane" of a mesh source: the plane mesh that it sweeps.
class PlaneMesh {
 public:
  void parameters(Parameters& p);
  /// `section`: the section of the source. Throws InputError unless it has a plane mesh.
  void read(const Section& section);
  /// The plane mesh, checked as a mesh of that geometry.
  GlobalMesh generate(Geometry geometry) const;
  /// Whether triangles of the mesh become wedges, where these nodes of it do not move.
  bool makes_wedges(const GlobalMesh& plane, const std::vector<char>& fixed) const;
  std::vector<std::string> files() const { return source_->files(); }
  /// Calls `make` and adds the position of the section "plane" to an InputError that it throws.
  GlobalMesh at_section(const std::function<GlobalMesh()>& make) const;

 private:
  enum class Triangles { automatic, wedges, tetrahedra };
  Triangles triangles_ = Triangles::automatic;
  std::shared_ptr<const MeshSource> source_;
  std::shared_ptr<const Section> section_;
};

/// Fails unless the section's geometry is three-dimensional. `what`: "an extruded mesh".
void require_space(const Section& section, Geometry geometry, const std::string& what);

/// Registers the sources of plane meshes: "box" and, when built with Gmsh, "gmsh".
void register_plane_sources(Registry<MeshSource>& registry);

}  // namespace mudline
