#include "discretisation/box_mesh.hpp"
#ifdef MUDLINE_HAVE_GMSH
#include "discretisation/gmsh_mesh.hpp"
#else
#include "discretisation/without_gmsh.hpp"
#endif

namespace mudline {

void register_mesh_sources(Registry<MeshSource>& registry) {
  registry.add<BoxMesh>("box", "Rectangle of quadrilaterals or triangles, optionally graded and layered");
#ifdef MUDLINE_HAVE_GMSH
  registry.add<GmshMesh>("gmsh", "Mesh file (.msh) or geometry (.geo) of Gmsh; physical groups are regions and sets");
#else
  registry.add<MeshWithoutGmsh>("gmsh", "Mesh file (.msh) or geometry (.geo) of Gmsh; not in this build");
#endif
}

}  // namespace mudline
