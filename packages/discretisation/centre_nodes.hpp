#pragma once

#include <array>
#include <map>
#include <unordered_map>
#include <vector>

#include "discretisation/tagged_mesh.hpp"

namespace mudline {

/// The centres of faces and cells that quadrilaterals of 8 nodes and hexahedra of 20 lack. They are put where the
/// serendipity shapes of the element have them: the map of the cell with centres is the same polynomial as before, so
/// that the geometry does not change. Neighbours get the same node on their common face; where the neighbour has that
/// node already, theirs is taken.
class CentreNodes {
 public:
  using Tag = TaggedMesh::Tag;
  static constexpr Tag missing = -1;

  /// The nodes of a file by their numbers, which are not negative; centres get negative numbers.
  explicit CentreNodes(std::unordered_map<Tag, Point>& places) : places_(places) {}

  /// Tells what cells have already: to be called for all of them before add(). (element, node) in the cell's order.
  void note(CellShape shape, const std::vector<Tag>& nodes);
  /// Puts the centres in place of `missing`.
  void add(CellShape shape, std::vector<Tag>& nodes);

 private:
  Tag centre_of_face(const std::vector<int>& face, const Tag* cell);
  Tag centre(const std::vector<int>& corners, const std::vector<int>& mid_side_nodes, const Tag* cell);

  std::unordered_map<Tag, Point>& places_;
  std::map<std::array<Tag, 4>, Tag> faces_;  // by their corners, sorted
  Tag next_ = missing - 1;
};

}  // namespace mudline
