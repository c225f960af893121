#include "ale/recovery.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace mudline {

namespace {

constexpr std::size_t enough_points = 6;  // for a fit of three coefficients that does not follow noise

struct Patch {
  std::array<double, 2> centre;
  double size;
  std::vector<double> coefficients;  // (column, 3): value, slopes times size
  double at(const std::array<double, 2>& x, int column) const {
    const double* c = &coefficients[3 * column];
    return c[0] + c[1] * (x[0] - centre[0]) / size + c[2] * (x[1] - centre[1]) / size;
  }
};

/// Solves the 3 x 3 normal equations for all columns; a singular direction (points in a line) is left flat.
void solve_normal(double a[3][3], std::vector<double>& b) {
  double largest = a[0][0];
  for (int k = 0; k < 3; ++k) {
    const bool flat = a[k][k] < 1e-10 * largest;
    for (std::size_t c = 0; c < b.size(); c += 3)
      if (flat) b[c + k] = 0;
    for (int i = k + 1; i < 3; ++i) {
      const double factor = flat ? 0.0 : a[i][k] / a[k][k];
      for (int j = k; j < 3; ++j) a[i][j] -= factor * a[k][j];
      for (std::size_t c = 0; c < b.size(); c += 3) b[c + i] -= factor * b[c + k];
    }
    if (flat) {
      a[k][k] = 1;
      for (int j = k + 1; j < 3; ++j) a[k][j] = 0;
    }
  }
  for (std::size_t c = 0; c < b.size(); c += 3)
    for (int k = 2; k >= 0; --k) {
      for (int j = k + 1; j < 3; ++j) b[c + k] -= a[k][j] * b[c + j];
      b[c + k] /= a[k][k];
    }
}

}  // namespace

std::array<double, 2> Recovery::position(const WholeMesh::Element& element, const SoilBlock& block, int point, const Positions& x) {
  std::array<double, 2> result{};
  for (int a = 0; a < block.u.nodes; ++a)
    for (int d = 0; d < 2; ++d) result[d] += block.u.N(point, a) * x[element.nodes[a]][d];
  return result;
}

Recovery::Recovery(const WholeMesh& mesh, const SoilBlock& block, const Positions& x, const std::vector<double>& table, int columns)
    : mesh_(mesh), block_(block), table_(table), columns_(columns), nodal_(static_cast<std::size_t>(mesh.num_nodes()) * columns, 0.0) {
  std::map<int, std::set<int>> around;  // elements at a vertex
  for (int e : mesh.block_elements(block.block))
    for (int a = 0; a < num_corners(block.shape); ++a) around[mesh.elements()[e].nodes[a]].insert(e);
  std::map<int, Patch> patches;
  for (const auto& [node, touching] : around) {
    std::set<int> elements = touching;
    while (elements.size() * block.points < enough_points) {
      std::set<int> wider = elements;
      for (int e : elements)
        for (int other : mesh.elements()[e].neighbours)
          if (other >= 0 && mesh.elements()[other].block == block.block) wider.insert(other);
      if (wider.size() == elements.size()) break;
      elements.swap(wider);
    }
    Patch patch{x[node], 0, std::vector<double>(3 * columns, 0.0)};
    std::vector<std::array<double, 2>> places;
    for (int e : elements)
      for (int q = 0; q < block.points; ++q) {
        places.push_back(position(mesh.elements()[e], block, q, x));
        patch.size = std::max(patch.size, std::hypot(places.back()[0] - x[node][0], places.back()[1] - x[node][1]));
      }
    double a[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    std::size_t i = 0;
    for (int e : elements)
      for (int q = 0; q < block.points; ++q, ++i) {
        const double basis[3] = {1, (places[i][0] - x[node][0]) / patch.size, (places[i][1] - x[node][1]) / patch.size};
        const double* values = &table[static_cast<std::size_t>(mesh.first_row(e, block.points) + q) * columns];
        for (int r = 0; r < 3; ++r) {
          for (int s = 0; s < 3; ++s) a[r][s] += basis[r] * basis[s];
          for (int c = 0; c < columns; ++c) patch.coefficients[3 * c + r] += basis[r] * values[c];
        }
      }
    solve_normal(a, patch.coefficients);
    patches[node] = std::move(patch);
  }
  for (const auto& [node, patch] : patches)
    for (int c = 0; c < columns; ++c) nodal_[static_cast<std::size_t>(node) * columns + c] = patch.at(x[node], c);
  const int corners = num_corners(block.shape), nodes = num_nodes(block.shape);
  for (int e : mesh.block_elements(block.block)) {
    const auto& n = mesh.elements()[e].nodes;
    for (int a = corners; a < nodes; ++a)
      for (int c = 0; c < columns; ++c) {
        double sum = 0;
        int share = 0;
        for (int b = 0; b < corners; ++b) {
          const bool end = a < 2 * corners ? b == a - corners || b == (a - corners + 1) % corners : true;  // the centre: all
          if (!end) continue;
          sum += patches.at(n[b]).at(x[n[a]], c);
          ++share;
        }
        nodal_[static_cast<std::size_t>(n[a]) * columns + c] = sum / share;
      }
  }
}

double Recovery::at(const MeshPlace& place, int column) const {
  const auto& element = mesh_.elements()[place.element];
  double N[9], dN[18], sum = 0;
  evaluate_shape(element.shape, place.xi, N, dN);
  for (int a = 0; a < num_nodes(element.shape); ++a) sum += N[a] * nodal_[static_cast<std::size_t>(element.nodes[a]) * columns_ + column];
  return sum;
}

double Recovery::at_point(int e, int point, int column) const {
  const auto& element = mesh_.elements()[e];
  double sum = 0;
  for (int a = 0; a < block_.u.nodes; ++a) sum += block_.u.N(point, a) * nodal_[static_cast<std::size_t>(element.nodes[a]) * columns_ + column];
  return sum;
}

void Recovery::widen_range(int e, int column, double& low, double& high) const {
  const auto& element = mesh_.elements()[e];
  const auto take = [&](double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (int q = 0; q < block_.points; ++q)
    take(table_[static_cast<std::size_t>(mesh_.first_row(e, block_.points) + q) * columns_ + column]);
  for (int a = 0; a < num_nodes(element.shape); ++a) take(nodal_[static_cast<std::size_t>(element.nodes[a]) * columns_ + column]);
}

}  // namespace mudline
