#pragma once

#include <string>
#include <vector>

#include "discretisation/gmsh_file.hpp"
#include "discretisation/source_position.hpp"
#include "discretisation/tagged_mesh.hpp"

namespace mudline {

/// A mesh file or geometry of Gmsh, in the x-y plane or in space. Physical groups become regions (surfaces; in space
/// volumes), side sets (curves; in space surfaces) and node sets (points; in space curves too); a group without a name
/// is called by its number. A curve between two elements stands for the side of the element on its left, a surface for
/// that of the element from which its normal points away. Mesh files of the formats 1 to 2.2 need no Gmsh.
class GmshMesh : public MeshSource {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  GlobalMesh generate() const override;
  std::vector<std::string> files() const override { return {file_.name}; }

 private:
  TaggedMesh read() const;
  TaggedMesh read_by_gmsh() const;
  /// Throws InputError where a geometry merges files of old formats whose groups Gmsh would mix up.
  void refuse_merged_groups() const;

  GmshFile file_;
  int order_ = 2, dimension_ = 2;
  SourcePosition position_;
};

}  // namespace mudline
