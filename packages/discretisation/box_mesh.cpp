#include "discretisation/box_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/pi.hpp"
#include "core/text.hpp"

namespace mudline {

namespace {

/// A number in [0, 1) that depends on `key` only (splitmix64), the same everywhere.
double scatter(std::uint64_t key) {
  key += 0x9e3779b97f4a7c15u;
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9u;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((key ^ (key >> 31)) >> 11) * 0x1p-53;
}

}  // namespace

void BoxMesh::parameters(Parameters& p) {
  position_.remember(p);
  declare_geometry(p);
  p.choice(
      "cell", cell_,
      {{"quad9", CellShape::quad9}, {"tri6", CellShape::tri6}, {"quad4", CellShape::quad4}, {"tri3", CellShape::tri3}},
      "Element shape; quad9 and tri6 are quadratic");
  p.required("cells", cells_, "-", closed(1, 1e6), "Number of cells along x and y; triangles halve each cell");
  p.add("lower", lower_, "m", "Lower left corner");
  p.required("upper", upper_, "m", "Upper right corner");
  p.add("grading", grading_, "-", "Size of the last cell over that of the first, along x and y");
  p.add("distortion", distortion_, "-", closed(0, 0.3),
        "Scatter of the interior vertices as a fraction of the cell size, the same in every run; for patch tests");
  p.add("region", region_, "Name of the material region");
  p.add("layer tops", layer_tops_, "m", any(),
        "Tops of the layers from the bottom up, without the highest; on cell lines");
  p.add("layer regions", layer_regions_, "Regions of the layers from the bottom up, in place of 'region'");
}

void BoxMesh::check(const Section& section) {
  if (cells_.size() != 2) section.fail("expected 2 numbers, given " + std::to_string(cells_.size()), "cells");
  for (int d = 0; d < 2; ++d) {
    if (cells_[d] != std::floor(cells_[d]))
      section.fail("expected whole numbers, given " + number_text(cells_[d]), "cells");
    count_[d] = static_cast<int>(cells_[d]);
    if (!(upper_[d] > lower_[d]))
      section.fail("must lie above and right of 'lower' (" + number_text(lower_[0]) + ", " + number_text(lower_[1]) +
                       "), given (" + number_text(upper_[0]) + ", " + number_text(upper_[1]) + ")",
                   "upper");
    if (!(grading_[d] > 0)) section.fail("must be positive, given " + number_text(grading_[d]), "grading");
  }
  constexpr double most_cells = 2e7;  // some 4 GB on the first rank
  if (cells_[0] * cells_[1] > most_cells)
    section.fail(
        "expected at most " + number_text(most_cells) + " cells in all, given " + number_text(cells_[0] * cells_[1]),
        "cells");
  step_ = order(cell_);
  if (layer_regions_.empty() && !layer_tops_.empty())
    section.fail("'layer tops' needs 'layer regions', one more name than tops", "layer tops");
  if (layer_regions_.empty()) return;
  if (section.has_parameter("region")) section.fail("give either 'region' or 'layer regions'", "region");
  if (layer_regions_.size() != layer_tops_.size() + 1)
    section.fail("expected " + std::to_string(layer_tops_.size() + 1) + " names, one more than 'layer tops', given " +
                     std::to_string(layer_regions_.size()),
                 "layer regions");
}

GlobalMesh BoxMesh::generate() const {
  GlobalMesh mesh;
  const std::vector<double> x = lines(0), y = lines(1);
  const std::vector<int> block_of_row = blocks_of_rows(y, mesh);
  place_nodes(x, y, mesh);
  move_vertices(x, y, mesh);
  for (int j = 0; j < count_[1]; ++j)
    for (int i = 0; i < count_[0]; ++i) add_cell(i, j, block_of_row[j], mesh);
  place_middles(mesh);
  return mesh;
}

std::vector<double> BoxMesh::lines(int direction) const {
  const int n = count_[direction];
  const double ratio = n > 1 ? std::pow(grading_[direction], 1.0 / (n - 1)) : 1.0;
  std::vector<double> sums{0};
  double size = 1;
  for (int i = 0; i < n; ++i, size *= ratio) sums.push_back(sums.back() + size);
  const double low = lower_[direction], high = upper_[direction];
  for (double& value : sums) value = low + (high - low) * (value / sums[n]);
  sums[n] = high;
  return sums;
}

void BoxMesh::place_nodes(const std::vector<double>& x, const std::vector<double>& y, GlobalMesh& mesh) const {
  const auto at = [this](const std::vector<double>& vertices, int a) {
    const int i = a / step_;
    return a % step_ == 0 ? vertices[i] : 0.5 * (vertices[i] + vertices[i + 1]);
  };
  for (int b = 0; b <= step_ * count_[1]; ++b)
    for (int a = 0; a <= step_ * count_[0]; ++a) mesh.coordinates.push_back({at(x, a), at(y, b)});
}

void BoxMesh::move_vertices(const std::vector<double>& x, const std::vector<double>& y, GlobalMesh& mesh) const {
  if (distortion_ == 0) return;
  for (int j = 1; j < count_[1]; ++j)
    for (int i = 1; i < count_[0]; ++i) {
      const double size = std::min({x[i] - x[i - 1], x[i + 1] - x[i], y[j] - y[j - 1], y[j + 1] - y[j]});
      // Within a disc: vertices that move by less than 0.35 of the cell size turn no cell over.
      const auto key = 2 * static_cast<std::uint64_t>(node(step_ * i, step_ * j));
      const double length = distortion_ * size * std::sqrt(scatter(key));
      const double angle = 2 * pi * scatter(key + 1);
      auto& point = mesh.coordinates[node(step_ * i, step_ * j)];
      point[0] += length * std::cos(angle);
      point[1] += length * std::sin(angle);
    }
}

void BoxMesh::place_middles(GlobalMesh& mesh) const {
  if (step_ == 1 || distortion_ == 0) return;
  const int n = num_nodes(cell_), corners = num_corners(cell_);
  for (const auto& block : mesh.blocks)
    for (std::size_t first = 0; first < block.nodes.size(); first += n) {
      const long long* nodes = block.nodes.data() + first;
      std::array<double, 2> sum{0, 0};
      for (int c = 0; c < corners; ++c) {
        const auto &start = mesh.coordinates[nodes[c]], &end = mesh.coordinates[nodes[(c + 1) % corners]];
        mesh.coordinates[nodes[corners + c]] = {0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])};
        for (int d = 0; d < 2; ++d) sum[d] += start[d];
      }
      if (cell_ == CellShape::quad9) mesh.coordinates[nodes[8]] = {0.25 * sum[0], 0.25 * sum[1]};
    }
}

std::vector<int> BoxMesh::blocks_of_rows(const std::vector<double>& y, GlobalMesh& mesh) const {
  const std::vector<std::string> regions = layer_regions_.empty() ? std::vector<std::string>{region_} : layer_regions_;
  std::vector<int> first_row{0};
  for (double top : layer_tops_) {
    const auto nearest =
        std::min_element(y.begin(), y.end(), [&](double a, double b) { return std::abs(a - top) < std::abs(b - top); });
    if (std::abs(*nearest - top) > 1e-6 * (upper_[1] - lower_[1]))
      position_.fail(
          "the layer top y = " + number_text(top) + " is on no cell line; the nearest is y = " + number_text(*nearest),
          "layer tops");
    first_row.push_back(static_cast<int>(nearest - y.begin()));
    if (first_row.back() <= first_row[first_row.size() - 2] || first_row.back() >= count_[1])
      position_.fail("tops must ascend and lie inside the box; y = " + number_text(top) + " does not", "layer tops");
  }
  std::vector<int> result(count_[1]);
  for (std::size_t layer = 0; layer < regions.size(); ++layer) {
    const auto same = std::find_if(mesh.blocks.begin(), mesh.blocks.end(),
                                   [&](const auto& block) { return block.region == regions[layer]; });
    const int block = static_cast<int>(same - mesh.blocks.begin());  // a region may have several layers
    if (same == mesh.blocks.end()) mesh.blocks.push_back({regions[layer], cell_, {}});
    std::fill(result.begin() + first_row[layer], result.end(), block);
  }
  return result;
}

bool BoxMesh::rising_diagonal(int i, int j) const {
  const bool corner = (i == 0 || i == count_[0] - 1) && (j == 0 || j == count_[1] - 1);
  if (corner) return (i == 0) == (j == 0);
  return (i + j) % 2 == 0;
}

void BoxMesh::add_cell(int i, int j, int block, GlobalMesh& mesh) const {
  using Place = std::array<int, 2>;  // in the grid of nodes
  const int a = step_ * i, b = step_ * j, a1 = a + step_, b1 = b + step_;
  const Place corner[4] = {{a, b}, {a1, b}, {a1, b1}, {a, b1}};
  std::vector<std::vector<Place>> elements;
  if (num_corners(cell_) == 4) {
    elements = {{corner[0], corner[1], corner[2], corner[3]}};
  } else if (rising_diagonal(i, j)) {
    elements = {{corner[0], corner[1], corner[2]}, {corner[0], corner[2], corner[3]}};
  } else {
    elements = {{corner[0], corner[1], corner[3]}, {corner[1], corner[2], corner[3]}};
  }
  GlobalMesh::Block& target = mesh.blocks[block];
  for (const auto& corners : elements) {
    const long long element = static_cast<long long>(target.nodes.size()) / num_nodes(cell_);
    for (const Place& p : corners) target.nodes.push_back(node(p[0], p[1]));
    const int n = static_cast<int>(corners.size());
    for (int side = 0; side < n; ++side) {
      const Place &p = corners[side], &q = corners[(side + 1) % n];
      if (step_ == 2) target.nodes.push_back(node((p[0] + q[0]) / 2, (p[1] + q[1]) / 2));
      const auto on = [&](int direction, int place) { return p[direction] == place && q[direction] == place; };
      const GlobalMesh::Side here{block, element, side};
      if (on(0, 0)) mesh.side_sets["left"].push_back(here);
      if (on(0, step_ * count_[0])) mesh.side_sets["right"].push_back(here);
      if (on(1, 0)) mesh.side_sets["bottom"].push_back(here);
      if (on(1, step_ * count_[1])) mesh.side_sets["top"].push_back(here);
    }
    if (cell_ == CellShape::quad9) target.nodes.push_back(node(a + 1, b + 1));
  }
}

}  // namespace mudline
