#include "discretisation/cells/cell.hpp"

#include <algorithm>

namespace mudline {

namespace {

/// Whether the last node of a side's shape is its centre.
bool has_centre(CellShape side) { return side == CellShape::quad9; }

}  // namespace

Cell CellFrame::linear(const char* name, CellShape own, const std::vector<CellShape>& side_shapes,
                       Cell::Evaluate evaluate) const {
  std::vector<std::vector<int>> around;
  for (int c = 0; c < static_cast<int>(corners.size()); ++c) around.push_back({c});
  return cell(name, own, side_shapes, std::move(around), evaluate);
}

Cell CellFrame::quadratic(const char* name, CellShape linear_shape, const std::vector<CellShape>& side_shapes,
                          bool centre, Cell::Evaluate evaluate) const {
  std::vector<std::vector<int>> around;
  std::vector<int> all;
  for (int c = 0; c < static_cast<int>(corners.size()); ++c) {
    around.push_back({c});
    all.push_back(c);
  }
  for (const auto& edge : edges) around.emplace_back(edge.begin(), edge.end());
  for (std::size_t s = 0; s < sides.size(); ++s)
    if (has_centre(side_shapes[std::min(s, side_shapes.size() - 1)])) around.push_back(sides[s]);
  if (centre) around.push_back(all);
  return cell(name, linear_shape, side_shapes, std::move(around), evaluate);
}

Cell CellFrame::cell(const char* name, CellShape linear_shape, const std::vector<CellShape>& side_shapes,
                     std::vector<std::vector<int>> around, Cell::Evaluate evaluate) const {
  const int count = static_cast<int>(corners.size());
  Cell result{};
  result.name = name;
  result.dimension = dimension;
  result.order = static_cast<int>(around.size()) > count ? 2 : 1;
  result.corners = count;
  result.simplex = simplex;
  result.linear = linear_shape;
  result.edges = edges;
  result.equilateral = equilateral;
  result.per_box = per_box;
  result.evaluate = evaluate;
  for (const std::vector<int>& of_node : around) {
    Vec<double, 3> place{};
    for (const int c : of_node)
      for (int i = 0; i < 3; ++i) place[i] += corners[c][i] / static_cast<double>(of_node.size());
    result.nodes.push_back(place);
    std::array<int, 3> lines{};
    for (int d = 0; d < 3; ++d) lines[d] = place[d] < 0 ? 0 : (place[d] > 0 ? 1 : 2);
    result.grid.push_back(lines);
  }
  const auto centre_of = [&](std::vector<int> wanted) {
    std::sort(wanted.begin(), wanted.end());
    const auto same = [&](std::vector<int> of_node) {
      std::sort(of_node.begin(), of_node.end());
      return of_node == wanted;
    };
    return static_cast<int>(std::find_if(around.begin(), around.end(), same) - around.begin());
  };
  for (std::size_t s = 0; s < sides.size(); ++s) {
    Cell::Side side{side_shapes[std::min(s, side_shapes.size() - 1)], sides[s]};
    const int n = static_cast<int>(sides[s].size());
    const int of_edges = result.order == 1 ? 0 : n == 2 ? 1 : n;  // nodes in the middle of the side or of its edges
    for (int c = 0; c < of_edges; ++c) side.nodes.push_back(centre_of({sides[s][c], sides[s][(c + 1) % n]}));
    if (has_centre(side.shape)) side.nodes.push_back(centre_of(sides[s]));
    result.sides.push_back(std::move(side));
  }
  result.around = std::move(around);
  return result;
}

}  // namespace mudline
