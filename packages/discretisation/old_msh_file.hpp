#pragma once

#include <string>

#include "discretisation/msh_elements.hpp"

namespace mudline {

/// Whether a file is a mesh of Gmsh's formats 1 to 2.2 (text or binary): it begins with $NOD, or with $MeshFormat and a
/// version below 3. Comments ($Comments) may stand before. Files that are too damaged to tell count as such.
bool is_old_msh(const std::string& file);

/// The mesh of such a file, of the given dimension. Groups belong to elements there, not to entities of a geometry:
/// files whose elements all have the same elementary tag are read as they are meant, and an element that is listed once
/// for each of its groups is in all of them. The physical tag 0 is no group; a negative one stands for the group with
/// reversed orientation and is read as the group itself. Partitions of elements are ignored, and the interface elements
/// that Gmsh puts between partitions are left out. Throws InputError "<file>:<line>: <what was found>; <what is
/// allowed>".
TaggedMesh read_old_msh(const std::string& file, int dimension);

/// Adds the groups of such a file's elements. Gmsh gives all elements of an entity one set of groups: where an entity
/// has several sets, a model that Gmsh merges from such files is wrong. Throws InputError.
void add_groups_of_entities(const std::string& file, GroupsOfEntities& groups);

}  // namespace mudline
