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
  bool turned = false;  // the plane's elements go round clockwise as seen from where they move to
  /// Where a place of the plane is after so many layers, or halves of one.
  std::function<Point(const Point& plane, double layers)> place;
  std::vector<char> fixed;  // (node of the plane) it does not move
};

/// The mesh in space that a plane one leaves behind: quadrilaterals become hexahedra, triangles prisms of three
/// tetrahedra each, which fit because every cut starts at the lower node number of the plane; where nodes do not move,
/// the flat tetrahedra are left out. Side sets become faces, point sets the lines that their points leave, regions
/// stay. The faces at the ends are the side sets "start" and "end". A side set all of whose sides do not move becomes a
/// set of their points. InputError for quadrilaterals with a fixed corner, and for sets that are called as an end is.
GlobalMesh swept(const GlobalMesh& plane, const Sweep& sweep);

/// The section "plane" of a mesh source: the plane mesh that it sweeps.
class PlaneMesh {
 public:
  static void document(Parameters& p);
  /// `section`: that of the source. InputError unless it has a plane mesh.
  void read(const Section& section);
  /// Checked as a mesh of that geometry is.
  GlobalMesh generate(Geometry geometry) const;
  std::vector<std::string> files() const { return source_->files(); }
  /// Calls what throws an InputError without a position, and adds that of the section "plane".
  GlobalMesh at_section(const std::function<GlobalMesh()>& make) const;

 private:
  std::shared_ptr<const MeshSource> source_;
  std::shared_ptr<const Section> section_;
};

/// Fails unless the section's geometry is three-dimensional. `what`: "an extruded mesh".
void require_space(const Section& section, Geometry geometry, const std::string& what);

/// Sources of meshes that can be of the plane: "box" and, when built with Gmsh, "gmsh".
void register_plane_sources(Registry<MeshSource>& registry);

}  // namespace mudline
