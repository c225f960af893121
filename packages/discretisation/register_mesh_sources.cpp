#include "discretisation/box_mesh.hpp"
#include "discretisation/extruded_mesh.hpp"
#include "discretisation/gmsh_library.hpp"
#include "discretisation/gmsh_mesh.hpp"
#include "discretisation/revolved_mesh.hpp"

namespace mudline {

void register_plane_sources(Registry<MeshSource>& registry) {
  registry.add<BoxMesh>("box",
                        "Rectangle of quadrilaterals or triangles, in space box of hexahedra or tetrahedra, optionally "
                        "graded and layered");
  registry.add<GmshMesh>(
      "gmsh", has_gmsh()
                  ? "Mesh file (.msh) or geometry (.geo) of Gmsh; physical groups are regions and sets"
                  : "Mesh file (.msh) of Gmsh's formats 1 to 2.2; others and geometries (.geo) are not in this build");
}

void register_mesh_sources(Registry<MeshSource>& registry) {
  register_plane_sources(registry);
  registry.add<ExtrudedMesh>("extruded", "Plane mesh drawn through space along z or y");
  registry.add<RevolvedMesh>("revolved",
                             "Plane mesh turned about its y axis, which becomes z: quarter, half, whole turn");
}

}  // namespace mudline
