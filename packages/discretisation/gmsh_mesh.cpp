#include "discretisation/gmsh_mesh.hpp"

#include <gmsh.h>

#include <filesystem>

#include "core/errors.hpp"
#include "discretisation/gmsh_model.hpp"
#include "discretisation/mesh_stream.hpp"

namespace mudline {

namespace {

/// A mesh on its way from Gmsh's process.
struct Delivery {
  GlobalMesh mesh;
  void transfer(ByteStream& s) { transfer_mesh(s, mesh); }
};

}  // namespace

void GmshMesh::parameters(Parameters& p) {
  position_.remember(p);
  dimension_ = dimension(declare_geometry(p));
  file_.parameters(p, "Mesh (.msh of any version) or geometry (.geo, meshed at the start)");
  p.add("order", order_, "-", closed(1, 2), "Order of the elements; a .msh file must have it");
}

void GmshMesh::check(const Section& section) {
  if (!is_gmsh_geometry(file_.name) && std::filesystem::path(file_.name).extension() != ".msh")
    section.fail("expected a .msh or .geo file, given '" + short_name(file_.name) + "'", "file");
  file_.overrides = gmsh_overrides(section, file_.name);
}

GlobalMesh GmshMesh::generate() const {
  Delivery delivery = with_gmsh<Delivery>(file_, position_, [&] {
    open_in_gmsh(file_, position_);
    if (is_gmsh_geometry(file_.name)) {
      gmsh::model::mesh::generate(dimension_);
      if (gmsh_error().empty()) gmsh::model::mesh::setOrder(order_);
      const std::string error = gmsh_error();
      if (!error.empty()) position_.fail("Gmsh, reading '" + short_name(file_.name) + "': " + error, "file");
    }
    return Delivery{read_model()};
  });
  return std::move(delivery.mesh);
}

GlobalMesh GmshMesh::read_model() const {
  try {
    return read_gmsh_model(order_, dimension_);
  } catch (const InputError& error) {
    position_.fail("'" + short_name(file_.name) + "': " + error.what(), "file");
  }
}

}  // namespace mudline
