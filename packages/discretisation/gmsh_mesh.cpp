#include "discretisation/gmsh_mesh.hpp"

#include <gmsh.h>

#include <filesystem>

#include "core/errors.hpp"
#include "discretisation/gmsh_model.hpp"

namespace mudline {

void GmshMesh::parameters(Parameters& p) {
  position_.remember(p);
  declare_geometry(p);
  p.required_file("file", file_, "Mesh (.msh of any version) or geometry (.geo, meshed at the start)");
  p.add("order", order_, "-", closed(1, 2), "Order of the elements; a .msh file must have it");
  p.passes_on("parameters", "Values for the geometry's named constants (DefineConstant with a Name), by these names");
}

void GmshMesh::check(const Section& section) {
  if (!is_gmsh_geometry(file_) && std::filesystem::path(file_).extension() != ".msh")
    section.fail("expected a .msh or .geo file, given '" + short_name(file_) + "'", "file");
  overrides_ = gmsh_overrides(section, file_);
}

GlobalMesh GmshMesh::generate() const {
  GlobalMesh result;
  with_gmsh(file_, position_, [&] {
    open_in_gmsh(file_, overrides_, position_);
    if (is_gmsh_geometry(file_)) {
      gmsh::model::mesh::generate(2);
      if (gmsh_error().empty()) gmsh::model::mesh::setOrder(order_);
      const std::string error = gmsh_error();
      if (!error.empty()) position_.fail("Gmsh, reading '" + short_name(file_) + "': " + error, "file");
    }
    result = read_model();
  });
  return result;
}

GlobalMesh GmshMesh::read_model() const {
  try {
    return read_gmsh_model(order_);
  } catch (const InputError& error) {
    position_.fail("'" + short_name(file_) + "': " + error.what(), "file");
  }
}

}  // namespace mudline
