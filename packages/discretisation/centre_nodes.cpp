#include "discretisation/centre_nodes.hpp"

#include <algorithm>

namespace mudline {

namespace {

using Tag = CentreNodes::Tag;

std::vector<std::vector<int>> faces_of(CellShape shape) {
  std::vector<std::vector<int>> faces;
  if (mudline::dimension(shape) == 3)
    for (int s = 0; s < num_sides(shape); ++s)
      if (side_shape(shape, s) == CellShape::quad9) faces.push_back(side_nodes(shape, s));
  return faces;
}

std::array<Tag, 4> corners_of(const std::vector<int>& face, const Tag* cell) {
  std::array<Tag, 4> key{};
  for (int c = 0; c < 4; ++c) key[c] = cell[face[c]];
  std::sort(key.begin(), key.end());
  return key;
}

}  // namespace

void CentreNodes::note(CellShape shape, const std::vector<Tag>& nodes) {
  const std::vector<std::vector<int>> faces = faces_of(shape);
  if (faces.empty()) return;
  for (std::size_t first = 0; first < nodes.size(); first += num_nodes(shape)) {
    const Tag* const cell = nodes.data() + first;
    for (const std::vector<int>& face : faces)
      if (cell[face.back()] != missing) faces_.emplace(corners_of(face, cell), cell[face.back()]);
  }
}

void CentreNodes::add(CellShape shape, std::vector<Tag>& nodes) {
  const int n = num_nodes(shape), corners = num_corners(shape), edges = num_edges(shape);
  if (order(shape) == 1 || is_simplex(shape)) return;
  const std::vector<std::vector<int>> faces = faces_of(shape);
  std::vector<int> all_corners, all_edges;
  for (int a = 0; a < corners; ++a) all_corners.push_back(a);
  for (int a = corners; a < corners + edges; ++a) all_edges.push_back(a);
  for (std::size_t first = 0; first < nodes.size(); first += n) {
    Tag* const cell = nodes.data() + first;
    if (cell[n - 1] != missing) continue;
    for (const std::vector<int>& face : faces) cell[face.back()] = centre_of_face(face, cell);
    if (cell[n - 1] == missing) cell[n - 1] = centre(all_corners, all_edges, cell);
  }
}

Tag CentreNodes::centre_of_face(const std::vector<int>& face, const Tag* cell) {
  const auto [known, added] = faces_.emplace(corners_of(face, cell), missing);
  if (added) known->second = centre({face.begin(), face.begin() + 4}, {face.begin() + 4, face.begin() + 8}, cell);
  return known->second;
}

/// Serendipity shape functions at the centre: in a quadrilateral -1/4 for corners and 1/2 for mid-side nodes, in a
/// hexahedron -1/4 and 1/4.
Tag CentreNodes::centre(const std::vector<int>& corners, const std::vector<int>& mid_side_nodes, const Tag* cell) {
  const double of_corner = -0.25,
               of_middle = (1 - of_corner * static_cast<double>(corners.size())) / mid_side_nodes.size();
  Point place{};
  for (const int a : corners)
    for (int i = 0; i < 3; ++i) place[i] += of_corner * places_.at(cell[a])[i];
  for (const int a : mid_side_nodes)
    for (int i = 0; i < 3; ++i) place[i] += of_middle * places_.at(cell[a])[i];
  places_.emplace(next_, place);
  return next_--;
}

}  // namespace mudline
