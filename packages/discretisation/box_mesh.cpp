#include "discretisation/box_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/pi.hpp"
#include "core/text.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// A pseudo-random number in [0, 1) from `key` (splitmix64), the same on every machine.
double scatter(std::uint64_t key) {
  key += 0x9e3779b97f4a7c15u;
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9u;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((key ^ (key >> 31)) >> 11) * 0x1p-53;
}

const std::vector<std::pair<std::string, CellShape>>& cell_words() {
  static const std::vector<std::pair<std::string, CellShape>> words{
      {"quad9", CellShape::quad9},     {"tri6", CellShape::tri6},    {"quad4", CellShape::quad4},
      {"tri3", CellShape::tri3},       {"hex27", CellShape::hex27},  {"tet10", CellShape::tet10},
      {"hex8", CellShape::hex8},       {"tet4", CellShape::tet4},    {"wedge15", CellShape::wedge15},
      {"wedge18", CellShape::wedge18}, {"wedge6", CellShape::wedge6}};
  return words;
}

}  // namespace

void BoxMesh::parameters(Parameters& p) {
  position_.remember(p);
  dimension_ = mudline::dimension(declare_geometry(p));
  p.choice(
      "cell", cell_, cell_words(),
      "Element shape: in the plane quad9 (default), tri6, quad4 or tri3, in space hex27 (default), tet10, wedge15, "
      "wedge18, hex8, tet4 or wedge6; quad4, tri3, hex8, tet4 and wedge6 are linear, the others quadratic");
  cell_given_ = p.given("cell");
  p.required("cells", cells_, "-", closed(1, 1e6),
             "Number of cells along x and y, in space also z; triangles and wedges halve each cell, tetrahedra cut it "
             "into six");
  p.add("lower", lower_, "m", any(), "Lower left corner, in space lower left front corner; the origin by default");
  p.required("upper", upper_, "m", any(), "The opposite corner");
  p.add("grading", grading_, "-", any(), "Size of the last cell over that of the first, along each direction");
  p.add("distortion", distortion_, "-", closed(0, 0.3),
        "Scatter of the interior vertices as a fraction of the cell size, the same in every run; for patch tests");
  p.add("region", region_, "Name of the material region");
  p.add("layer tops", layer_tops_, "m", any(),
        "Tops of the layers from the bottom up, without the highest; on cell lines");
  p.add("layer regions", layer_regions_, "Regions of the layers from the bottom up, in place of 'region'");
  if (dimension_ == 2 || p.documenting()) return;
  if (!p.given("lower")) lower_ = {0, 0, 0};
  if (!p.given("grading")) grading_ = {1, 1, 1};
  if (!cell_given_) cell_ = CellShape::hex27;
}

void BoxMesh::check(const Section& section) {
  if (mudline::dimension(cell_) != dimension_) {
    std::vector<std::string> allowed;
    for (const auto& [word, shape] : cell_words())
      if (mudline::dimension(shape) == dimension_) allowed.push_back(word);
    section.fail("'" + std::string(name(cell_)) + "' is a cell of " + (dimension_ == 2 ? "space" : "the plane") +
                     ", and the geometry is " + (dimension_ == 2 ? "one of the plane" : "'three-dimensional'") +
                     "; allowed: " + join(allowed),
                 "cell");
  }
  check_numbers(section);
  step_ = order(cell_);
  around_.clear();
  for (int a = 0; a < num_nodes(cell_); ++a) around_.push_back(corners_around(cell_, a));
  check_layers(section);
}

void BoxMesh::check_numbers(const Section& section) {
  const auto expect = [&](const std::vector<double>& numbers, const char* entry) {
    if (static_cast<int>(numbers.size()) != dimension_)
      section.fail("expected " + std::to_string(dimension_) + " numbers, given " + std::to_string(numbers.size()),
                   entry);
  };
  expect(cells_, "cells");
  expect(lower_, "lower");
  expect(upper_, "upper");
  expect(grading_, "grading");
  double all = 1;
  for (int d = 0; d < dimension_; ++d) {
    if (cells_[d] != std::floor(cells_[d]))
      section.fail("expected whole numbers, given " + number_text(cells_[d]), "cells");
    count_[d] = static_cast<int>(cells_[d]);
    all *= cells_[d];
    if (!(upper_[d] > lower_[d]))
      section.fail("must lie above and right of 'lower' " + tuple_text(lower_.data(), lower_.size()) + ", given " +
                       tuple_text(upper_.data(), upper_.size()),
                   "upper");
    if (!(grading_[d] > 0)) section.fail("must be positive, given " + number_text(grading_[d]), "grading");
  }
  const double most_cells = dimension_ == 2 ? 2e7 : 5e6;  // some 4 GB on the first rank
  if (all > most_cells)
    section.fail("expected at most " + number_text(most_cells) + " cells in all, given " + number_text(all), "cells");
}

void BoxMesh::check_layers(const Section& section) const {
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
  const std::array<std::vector<double>, 3> x{lines(0), lines(1), lines(2)};
  const int vertical = dimension_ - 1;
  const std::vector<int> block_of_row = blocks_of_rows(x[vertical], mesh);
  place_nodes(x, mesh);
  move_vertices(x, mesh);
  Index cell{};
  for (cell[2] = 0; cell[2] < std::max(count_[2], 1); ++cell[2])
    for (cell[1] = 0; cell[1] < count_[1]; ++cell[1])
      for (cell[0] = 0; cell[0] < count_[0]; ++cell[0]) add_cell(cell, block_of_row[cell[vertical]], mesh);
  place_mid_side_nodes(mesh);
  if (cell_ == CellShape::wedge15) drop_unused_nodes(mesh);
  return mesh;
}

std::vector<double> BoxMesh::lines(int direction) const {
  if (direction >= dimension_) return {0.0};
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

void BoxMesh::place_nodes(const std::array<std::vector<double>, 3>& x, GlobalMesh& mesh) const {
  const auto at = [this](const std::vector<double>& vertices, int a) {
    const int i = a / step_;
    return a % step_ == 0 ? vertices[i] : 0.5 * (vertices[i] + vertices[i + 1]);
  };
  for (int c = 0; c <= step_ * count_[2]; ++c)
    for (int b = 0; b <= step_ * count_[1]; ++b)
      for (int a = 0; a <= step_ * count_[0]; ++a) mesh.coordinates.push_back({at(x[0], a), at(x[1], b), at(x[2], c)});
}

void BoxMesh::move_vertices(const std::array<std::vector<double>, 3>& x, GlobalMesh& mesh) const {
  if (distortion_ == 0) return;
  Index at{};
  const bool plane = dimension_ == 2;
  for (at[2] = plane ? 0 : 1; at[2] < (plane ? 1 : count_[2]); ++at[2])
    for (at[1] = 1; at[1] < count_[1]; ++at[1])
      for (at[0] = 1; at[0] < count_[0]; ++at[0]) {
        double size = x[0].back() - x[0].front();
        Index place{};
        for (int d = 0; d < dimension_; ++d) {
          size = std::min({size, x[d][at[d]] - x[d][at[d] - 1], x[d][at[d] + 1] - x[d][at[d]]});
          place[d] = step_ * at[d];
        }
        // Vertices move within a disc or a ball. A move of less than 0.35 of the cell size folds no triangle,
        // quadrilateral or tetrahedron; it can fold a hexahedron in the worst case, which check_mesh() refuses.
        auto& point = mesh.coordinates[node(place)];
        const auto key = static_cast<std::uint64_t>(node(place)) * dimension_;
        const double angle = 2 * pi * scatter(key + 1), cosine = plane ? 0 : 2 * scatter(key + 2) - 1;
        const double length = distortion_ * size * (plane ? std::sqrt(scatter(key)) : std::cbrt(scatter(key)));
        const double across = plane ? length : length * std::sqrt(1 - cosine * cosine);
        point[0] += across * std::cos(angle);
        point[1] += across * std::sin(angle);
        if (!plane) point[2] += length * cosine;
      }
}

void BoxMesh::place_mid_side_nodes(GlobalMesh& mesh) const {
  if (step_ == 1 || distortion_ == 0) return;
  const int n = num_nodes(cell_);
  for (const auto& block : mesh.blocks)
    for (std::size_t first = 0; first < block.nodes.size(); first += n) {
      const long long* nodes = block.nodes.data() + first;
      for (int a = num_corners(cell_); a < n; ++a) {
        Point sum{};
        for (const int c : around_[a])
          for (int d = 0; d < dimension_; ++d) sum[d] += mesh.coordinates[nodes[c]][d];
        for (double& value : sum) value /= static_cast<double>(around_[a].size());
        mesh.coordinates[nodes[a]] = sum;
      }
    }
}

void BoxMesh::drop_unused_nodes(GlobalMesh& mesh) {
  std::vector<long long> number(mesh.coordinates.size(), -1);
  for (const auto& block : mesh.blocks)
    for (const long long node : block.nodes) number[node] = 0;
  std::vector<Point> used;
  for (std::size_t node = 0; node < number.size(); ++node) {
    if (number[node] < 0) continue;
    number[node] = static_cast<long long>(used.size());
    used.push_back(mesh.coordinates[node]);
  }
  mesh.coordinates = std::move(used);
  for (auto& block : mesh.blocks)
    for (long long& node : block.nodes) node = number[node];
}

std::vector<int> BoxMesh::blocks_of_rows(const std::vector<double>& heights, GlobalMesh& mesh) const {
  const std::vector<std::string> regions = layer_regions_.empty() ? std::vector<std::string>{region_} : layer_regions_;
  const int vertical = dimension_ - 1;
  const std::string axis = dimension_ == 2 ? "y" : "z";
  std::vector<int> first_row{0};
  for (double top : layer_tops_) {
    const auto nearest = std::min_element(heights.begin(), heights.end(),
                                          [&](double a, double b) { return std::abs(a - top) < std::abs(b - top); });
    if (std::abs(*nearest - top) > 1e-6 * (upper_[vertical] - lower_[vertical]))
      position_.fail("the layer top " + axis + " = " + number_text(top) + " is on no cell line; the nearest is " +
                         axis + " = " + number_text(*nearest),
                     "layer tops");
    first_row.push_back(static_cast<int>(nearest - heights.begin()));
    if (first_row.back() <= first_row[first_row.size() - 2] || first_row.back() >= count_[vertical])
      position_.fail("tops must ascend and lie inside the box; " + axis + " = " + number_text(top) + " does not",
                     "layer tops");
  }
  std::vector<int> result(count_[vertical]);
  for (std::size_t layer = 0; layer < regions.size(); ++layer) {
    const auto same = std::find_if(mesh.blocks.begin(), mesh.blocks.end(),
                                   [&](const auto& block) { return block.region == regions[layer]; });
    const int block = static_cast<int>(same - mesh.blocks.begin());  // a region may have several layers
    if (same == mesh.blocks.end()) mesh.blocks.push_back({regions[layer], cell_, {}});
    std::fill(result.begin() + first_row[layer], result.end(), block);
  }
  return result;
}

std::vector<std::vector<BoxMesh::Index>> BoxMesh::triangles(const Index& cell) const {
  const auto [i, j, k] = cell;
  const bool corner = (i == 0 || i == count_[0] - 1) && (j == 0 || j == count_[1] - 1);
  const bool rising = corner ? (i == 0) == (j == 0) : (i + j) % 2 == 0;
  const Index a{i, j, k}, b{i + 1, j, k}, c{i + 1, j + 1, k}, d{i, j + 1, k};
  if (rising) return {{a, b, c}, {a, c, d}};
  return {{a, b, d}, {b, c, d}};
}

/// Six tetrahedra around a diagonal of the cell (Kuhn): along the path of each, the coordinates grow one after the
/// other. Whether a direction is mirrored depends only on the cell's number in that direction, so that neighbours fit.
/// The mirroring alternates, and the diagonals start at the corners of the box.
std::vector<std::vector<BoxMesh::Index>> BoxMesh::tetrahedra(const Index& cell) const {
  static constexpr int permutations[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  bool mirrored[3], turned = false;
  for (int d = 0; d < 3; ++d) {
    mirrored[d] = cell[d] > 0 && (cell[d] % 2 == 1 || cell[d] == count_[d] - 1);
    turned = turned != mirrored[d];
  }
  std::vector<std::vector<Index>> result;
  for (int t = 0; t < 6; ++t) {
    Index at = cell;
    for (int d = 0; d < 3; ++d) at[d] += mirrored[d];
    std::vector<Index> corners{at};
    for (const int d : permutations[t]) {
      at[d] += mirrored[d] ? -1 : 1;
      corners.push_back(at);
    }
    if (turned != (t >= 3)) std::swap(corners[2], corners[3]);  // the last three permutations are odd
    result.push_back(std::move(corners));
  }
  return result;
}

std::vector<std::vector<BoxMesh::Index>> BoxMesh::elements(const Index& cell) const {
  if (is_simplex(cell_)) return dimension_ == 2 ? triangles(cell) : tetrahedra(cell);
  if (simplex_coordinates(cell_) == 2) {  // wedges
    std::vector<std::vector<Index>> result = triangles(cell);
    for (std::vector<Index>& corners : result)
      for (int c = 0; c < 3; ++c) corners.push_back({corners[c][0], corners[c][1], cell[2] + 1});
    return result;
  }
  std::vector<Index> corners;
  for (int c = 0; c < num_corners(cell_); ++c) {
    const Vec<double, 3> place = reference_node(cell_, c);
    Index at = cell;
    for (int d = 0; d < dimension_; ++d) at[d] += place[d] > 0;
    corners.push_back(at);
  }
  return {corners};
}

void BoxMesh::add_cell(const Index& cell, int block, GlobalMesh& mesh) const {
  GlobalMesh::Block& target = mesh.blocks[block];
  for (const std::vector<Index>& corners : elements(cell)) {
    const long long element = static_cast<long long>(target.nodes.size()) / num_nodes(cell_);
    for (int a = 0; a < num_nodes(cell_); ++a) {
      const std::vector<int>& around = around_[a];
      Index at{};
      for (int d = 0; d < 3; ++d) {
        for (const int c : around) at[d] += step_ * corners[c][d];
        at[d] /= static_cast<int>(around.size());
      }
      target.nodes.push_back(node(at));
    }
    add_sides(corners, {block, element, 0}, mesh);
  }
}

void BoxMesh::add_sides(const std::vector<Index>& corners, const GlobalMesh::Side& element, GlobalMesh& mesh) const {
  static constexpr const char* names[2][3][2] = {{{"left", "right"}, {"bottom", "top"}, {}},
                                                 {{"left", "right"}, {"front", "back"}, {"bottom", "top"}}};
  const CellShape straight = linear_partner(cell_);
  for (int side = 0; side < num_sides(cell_); ++side) {
    const std::vector<int> local = side_nodes(straight, side);
    for (int d = 0; d < dimension_; ++d)
      for (int end = 0; end < 2; ++end)
        if (std::all_of(local.begin(), local.end(), [&](int c) { return corners[c][d] == end * count_[d]; }))
          mesh.side_sets[names[dimension_ - 2][d][end]].push_back({element.block, element.element, side});
  }
}

}  // namespace mudline
