#include "discretisation/gmsh_mesh.hpp"

#include <filesystem>

#include "core/errors.hpp"
#include "core/log.hpp"
#include "core/text.hpp"
#include "discretisation/geometry_commands.hpp"
#include "discretisation/gmsh_library.hpp"
#include "discretisation/old_msh_file.hpp"

namespace mudline {

namespace {

/// How a file with another extension becomes a mesh.
std::string way_from(const std::string& extension) {
  if (extension == ".inp" || extension == ".unv") return "; `mudline import` makes a .msh of it";
  for (const char* drawing : {".step", ".stp", ".iges", ".igs", ".brep"})
    if (lower_case(extension) == drawing) return "; a .geo merges it and names its groups (user guide, section 3)";
  return "";
}

}  // namespace

void GmshMesh::parameters(Parameters& p) {
  position_.remember(p);
  dimension_ = dimension(declare_geometry(p));
  file_.parameters(p, "Mesh (.msh of any version) or geometry (.geo, meshed at the start)");
  p.add("order", order_, "-", closed(1, 2), "Order of the elements; a .msh file must have it");
}

void GmshMesh::check(const Section& section) {
  if (!is_gmsh_geometry(file_.name) && std::filesystem::path(file_.name).extension() != ".msh")
    section.fail("expected a .msh or .geo file, given '" + short_name(file_.name) + "'" +
                     way_from(std::filesystem::path(file_.name).extension()),
                 "file");
  file_.overrides = gmsh_overrides(section, file_.name);
  if (!has_gmsh() && (is_gmsh_geometry(file_.name) || !is_old_msh(file_.name)))
    section.fail(needs_gmsh(short_name(file_.name)) + "; allowed: mesh files (.msh) of the formats 1 to 2.2", "file");
}

GlobalMesh GmshMesh::generate() const {
  const TaggedMesh tagged = read();
  try {
    GlobalMesh mesh = global_mesh(tagged, order_, dimension_);
    if (const std::string told = elements_without_centres(tagged); !told.empty())
      log::info("mesh: " + told + " in '" + short_name(file_.name) + "' made complete by nodes in the centre" +
                (dimension_ == 3 ? " and the faces" : "") + "; the geometry stays as it is");
    return mesh;
  } catch (const InputError& error) {
    position_.fail("'" + short_name(file_.name) + "': " + error.what(), "file");
  }
}

TaggedMesh GmshMesh::read() const {
  if (is_gmsh_geometry(file_.name) || !is_old_msh(file_.name)) return read_by_gmsh();
  try {
    return read_old_msh(file_.name, dimension_);
  } catch (const InputError& error) {
    position_.fail(error.what(), "file");
  }
}

TaggedMesh GmshMesh::read_by_gmsh() const {
  if (is_gmsh_geometry(file_.name)) refuse_merged_groups();
  return gmsh_library(position_).read_mesh(file_, dimension_, order_, position_);
}

void GmshMesh::refuse_merged_groups() const {
  GroupsOfEntities groups;
  std::string merged;
  for (const std::string& reached : files_reached(file_.name))
    if (reached != file_.name && is_old_msh(reached)) {
      try {
        add_groups_of_entities(reached, groups);
      } catch (const InputError&) {
        continue;  // Gmsh reports the error itself
      }
      merged += (merged.empty() ? "'" : ", '") + short_name(reached) + "'";
    }
  const char* const kinds[] = {"points", "lines", "faces", "cells"};
  for (const auto& [entity, sets] : groups)
    if (sets.size() > 1)
      position_.fail("'" + short_name(file_.name) + "' merges " + merged + ", where " + kinds[entity.first] +
                         " of different physical groups have the same elementary tag, " +
                         std::to_string(entity.second) +
                         "; Gmsh would put all of them in all of these groups. Give the mesh itself as 'file', or " +
                         "give each group an elementary tag of its own",
                     "file");
}

}  // namespace mudline
