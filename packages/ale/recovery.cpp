#include "ale/recovery.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace mudline {

namespace {

constexpr int terms = 6;                  // of a quadratic polynomial
constexpr std::size_t enough_points = 9;  // for a fit that does not follow noise

struct Patch {
  std::array<double, 2> centre;
  double size;
  std::vector<double> coefficients;  // (column, term)

  std::array<double, terms> basis(const std::array<double, 2>& x) const {
    const double a = (x[0] - centre[0]) / size, b = (x[1] - centre[1]) / size;
    return {1, a, b, a * a, a * b, b * b};
  }
  double at(const std::array<double, 2>& x, int column) const {
    const auto powers = basis(x);
    double sum = 0;
    for (int k = 0; k < terms; ++k) sum += powers[k] * coefficients[terms * column + k];
    return sum;
  }
};

/// Solves the normal equations for all columns. A direction that the points do not resolve (they lie on a conic) is
/// left out: its coefficient is zero.
void solve_normal(double (&a)[terms][terms], std::vector<double>& b) {
  double diagonal[terms];
  for (int k = 0; k < terms; ++k) diagonal[k] = a[k][k];
  bool out[terms];
  for (int k = 0; k < terms; ++k) {
    out[k] = a[k][k] <= 1e-8 * diagonal[k];
    for (std::size_t c = 0; out[k] && c < b.size(); c += terms) b[c + k] = 0;
    for (int i = k + 1; !out[k] && i < terms; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (int j = k; j < terms; ++j) a[i][j] -= factor * a[k][j];
      for (std::size_t c = 0; c < b.size(); c += terms) b[c + i] -= factor * b[c + k];
    }
  }
  for (std::size_t c = 0; c < b.size(); c += terms)
    for (int k = terms - 1; k >= 0; --k) {
      if (out[k]) continue;
      for (int j = k + 1; j < terms; ++j) b[c + k] -= out[j] ? 0.0 : a[k][j] * b[c + j];
      b[c + k] /= a[k][k];
    }
}

}  // namespace

std::array<double, 2> Recovery::position(const WholeMesh::Element& element, const SoilBlock& block, int point,
                                         const Positions& x) {
  std::array<double, 2> result{};
  for (int a = 0; a < block.u.nodes; ++a)
    for (int d = 0; d < 2; ++d) result[d] += block.u.N(point, a) * x[element.nodes[a]][d];
  return result;
}

Recovery::Recovery(const WholeMesh& mesh, const SoilBlock& block, const Positions& x, const std::vector<double>& table,
                   int columns)
    : mesh_(mesh),
      block_(block),
      table_(table),
      columns_(columns),
      nodal_(static_cast<std::size_t>(mesh.num_nodes()) * columns, 0.0) {
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
    Patch patch{x[node], 0, std::vector<double>(terms * columns, 0.0)};
    std::vector<std::array<double, 2>> places;
    for (int e : elements)
      for (int q = 0; q < block.points; ++q) {
        places.push_back(position(mesh.elements()[e], block, q, x));
        patch.size = std::max(patch.size, std::hypot(places.back()[0] - x[node][0], places.back()[1] - x[node][1]));
      }
    double a[terms][terms] = {};
    std::size_t i = 0;
    for (int e : elements)
      for (int q = 0; q < block.points; ++q, ++i) {
        const auto powers = patch.basis(places[i]);
        const double* values = &table[static_cast<std::size_t>(mesh.first_row(e, block.points) + q) * columns];
        for (int r = 0; r < terms; ++r) {
          for (int s = 0; s < terms; ++s) a[r][s] += powers[r] * powers[s];
          for (int c = 0; c < columns; ++c) patch.coefficients[terms * c + r] += powers[r] * values[c];
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
          const bool end =
              a < 2 * corners ? b == a - corners || b == (a - corners + 1) % corners : true;  // the centre: all
          if (!end) continue;
          sum += patches.at(n[b]).at(x[n[a]], c);
          ++share;
        }
        nodal_[static_cast<std::size_t>(n[a]) * columns + c] = sum / share;
      }
  }
  bound_inner_nodes();
}

void Recovery::bound_inner_nodes() {
  bounded_ = nodal_;
  const auto& elements = mesh_.elements();
  std::vector<bool> outer(mesh_.num_nodes(), false);
  std::vector<double> low(nodal_.size(), 1e300), high(nodal_.size(), -1e300);
  for (int e : mesh_.block_elements(block_.block)) {
    const auto& element = elements[e];
    const int corners = num_corners(element.shape);
    for (int side = 0; side < corners; ++side) {
      const int other = element.neighbours[side];
      if (other >= 0 && elements[other].block == block_.block) continue;
      outer[element.nodes[side]] = outer[element.nodes[(side + 1) % corners]] = true;
      if (num_nodes(element.shape) > corners) outer[element.nodes[corners + side]] = true;
    }
    for (int q = 0; q < block_.points; ++q) {
      const double* row = &table_[static_cast<std::size_t>(mesh_.first_row(e, block_.points) + q) * columns_];
      for (int a = 0; a < num_nodes(element.shape); ++a)
        for (int c = 0; c < columns_; ++c) {
          const std::size_t i = static_cast<std::size_t>(element.nodes[a]) * columns_ + c;
          low[i] = std::min(low[i], row[c]);
          high[i] = std::max(high[i], row[c]);
        }
    }
  }
  for (int node = 0; node < mesh_.num_nodes(); ++node)
    for (int c = 0; c < columns_ && !outer[node]; ++c) {
      const std::size_t i = static_cast<std::size_t>(node) * columns_ + c;
      if (low[i] <= high[i]) bounded_[i] = std::clamp(nodal_[i], low[i], high[i]);
    }
}

double Recovery::at(const MeshPlace& place, int column) const {
  const auto& element = mesh_.elements()[place.element];
  double N[9], dN[18], sum = 0;
  evaluate_shape(element.shape, place.xi, N, dN);
  for (int a = 0; a < num_nodes(element.shape); ++a)
    sum += N[a] * nodal_[static_cast<std::size_t>(element.nodes[a]) * columns_ + column];
  return sum;
}

double Recovery::at_point(int e, int point, int column) const {
  const auto& element = mesh_.elements()[e];
  double sum = 0;
  for (int a = 0; a < block_.u.nodes; ++a)
    sum += block_.u.N(point, a) * nodal_[static_cast<std::size_t>(element.nodes[a]) * columns_ + column];
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
  for (int a = 0; a < num_nodes(element.shape); ++a)
    take(bounded_[static_cast<std::size_t>(element.nodes[a]) * columns_ + column]);
}

}  // namespace mudline
