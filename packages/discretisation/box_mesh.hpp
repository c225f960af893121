#pragma once

#include <array>
#include <string>
#include <vector>

#include "discretisation/mesh.hpp"
#include "discretisation/source_position.hpp"

namespace mudline {

/// A rectangle of columns and rows of cells. Sides: left, right, bottom, top. Horizontal layers may be named regions.
/// Nodes are numbered row by row; triangles cut each cell along diagonals of alternating direction that pass through
/// the corners of the box, so that no element has all its nodes on two fixed sides.
class BoxMesh : public MeshSource {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  GlobalMesh generate() const override;

 private:
  /// Vertex positions along one direction.
  std::vector<double> lines(int direction) const;
  void place_nodes(const std::vector<double>& x, const std::vector<double>& y, GlobalMesh& mesh) const;
  void move_vertices(const std::vector<double>& x, const std::vector<double>& y, GlobalMesh& mesh) const;
  void place_middles(GlobalMesh& mesh) const;
  /// The block of each row of cells; adds the blocks.
  std::vector<int> blocks_of_rows(const std::vector<double>& y, GlobalMesh& mesh) const;
  /// Adds cell (i, j) and its sides on the boundary.
  void add_cell(int i, int j, int block, GlobalMesh& mesh) const;

  /// Node at a position of the grid of corners (and middles, when quadratic).
  long long node(int a, int b) const { return static_cast<long long>(b) * (step_ * count_[0] + 1) + a; }
  bool rising_diagonal(int i, int j) const;

  CellShape cell_ = CellShape::quad9;
  std::vector<double> cells_;
  std::array<double, 2> lower_{0, 0}, upper_{0, 0}, grading_{1, 1};
  double distortion_ = 0;
  std::string region_ = "soil";
  std::vector<double> layer_tops_;
  std::vector<std::string> layer_regions_;
  SourcePosition position_;

  int count_[2] = {0, 0};
  int step_ = 2;  // grid positions per cell: the order of the elements
};

}  // namespace mudline
