#pragma once

#include <array>
#include <map>
#include <unordered_map>
#include <vector>

#include "discretisation/tagged_mesh.hpp"

namespace mudline {

/// Adds the centre nodes of faces and cells that 8-node quadrilaterals, 20-node hexahedra and, beside complete
/// neighbours, 15-node prisms lack. They are placed by
/// the serendipity shape functions of the element, so that the map of the cell stays the same polynomial and the
/// geometry does not change. Neighbours share the node of their common face; a node that the neighbour already has is
/// used.
class CentreNodes {
 public:
  using Tag = TaggedMesh::Tag;
  static constexpr Tag missing = -1;

  /// `places`: the nodes of a file by their numbers, which are not negative; centres are added with negative numbers.
  explicit CentreNodes(std::unordered_map<Tag, Point>& places) : places_(places) {}

  /// Registers the face centres that cells already have. Call it for all cells before add(). nodes: (element, node) in
  /// the cell's order.
  void note(CellShape shape, const std::vector<Tag>& nodes);
  /// Replaces `missing` by centre nodes.
  void add(CellShape shape, std::vector<Tag>& nodes);

 private:
  Tag centre_of_face(const std::vector<int>& face, const Tag* cell);
  Tag centre(const std::vector<int>& corners, const std::vector<int>& mid_side_nodes, const Tag* cell);

  std::unordered_map<Tag, Point>& places_;
  std::map<std::array<Tag, 4>, Tag> faces_;  // by their corners, sorted
  Tag next_ = missing - 1;
};

}  // namespace mudline
