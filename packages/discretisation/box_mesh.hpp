#pragma once

#include <array>
#include <string>
#include <vector>

#include "discretisation/mesh.hpp"
#include "discretisation/source_position.hpp"

namespace mudline {

/// A rectangle or a box of cells. Sides: left, right (x), in space front, back (y), and bottom, top (the vertical).
/// Horizontal layers may be named regions. Nodes are numbered along x, then y, then z. Triangles cut each cell along
/// diagonals of alternating direction that pass through the corners of the box; tetrahedra cut it into six along a
/// diagonal of the cell, mirrored from cell to cell, that passes through the corners of the box: with two cells or more
/// in each direction no tetrahedron has all its nodes on sides of the box. Wedges are triangles drawn upwards.
class BoxMesh : public MeshSource {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  GlobalMesh generate() const override;

 private:
  using Index = std::array<int, 3>;  // index of a cell, or of a node in the grid of corners and mid-side nodes

  void check_numbers(const Section& section);
  void check_layers(const Section& section) const;

  /// Vertex positions along one direction.
  std::vector<double> lines(int direction) const;
  void place_nodes(const std::array<std::vector<double>, 3>& x, GlobalMesh& mesh) const;
  void move_vertices(const std::array<std::vector<double>, 3>& x, GlobalMesh& mesh) const;
  void place_mid_side_nodes(GlobalMesh& mesh) const;
  /// Numbers the nodes anew without those of the grid that no element has.
  static void drop_unused_nodes(GlobalMesh& mesh);
  /// Adds the blocks and returns the block of each layer of cells, from the bottom up.
  std::vector<int> blocks_of_rows(const std::vector<double>& heights, GlobalMesh& mesh) const;
  /// Adds a cell and its sides on the boundary.
  void add_cell(const Index& cell, int block, GlobalMesh& mesh) const;
  /// Corners of the elements that a cell is cut into.
  std::vector<std::vector<Index>> elements(const Index& cell) const;
  /// The triangles in the plane of the cell's lower corners.
  std::vector<std::vector<Index>> triangles(const Index& cell) const;
  std::vector<std::vector<Index>> tetrahedra(const Index& cell) const;
  void add_sides(const std::vector<Index>& corners, const GlobalMesh::Side& element, GlobalMesh& mesh) const;

  /// Node at a position of the grid of corners (and mid-side nodes, when quadratic).
  long long node(const Index& at) const {
    return (static_cast<long long>(at[2]) * (step_ * count_[1] + 1) + at[1]) * (step_ * count_[0] + 1) + at[0];
  }

  CellShape cell_ = CellShape::quad9;
  std::vector<double> cells_, lower_{0, 0}, upper_, grading_{1, 1};
  double distortion_ = 0;
  std::string region_ = "soil";
  std::vector<double> layer_tops_;
  std::vector<std::string> layer_regions_;
  SourcePosition position_;

  int dimension_ = 2;
  bool cell_given_ = false;
  Index count_{0, 0, 0};                  // cells in each direction
  int step_ = 2;                          // grid positions per cell: the order of the elements
  std::vector<std::vector<int>> around_;  // (node) see corners_around()
};

}  // namespace mudline
