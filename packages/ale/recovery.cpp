#include "ale/recovery.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "ale/axial_section.hpp"
#include "framework/normal_equations.hpp"

namespace mudline {

namespace {

/// Number of terms of a quadratic polynomial.
template <int Dim>
constexpr int terms = (Dim + 1) * (Dim + 2) / 2;

/// Number of points for a fit that does not follow noise. In space the points of few elements nearly lie on a quadric.
std::size_t enough_points(int dimension) { return dimension == 2 ? 9 : 40; }

/// Quadratic polynomials about a vertex, one for each column, in scaled coordinates.
template <int Dim>
struct Polynomial {
  Point centre;
  double size;
  std::vector<double> coefficients;  // (column, term)

  std::array<double, terms<Dim>> basis(const Point& x) const {
    const double a = (x[0] - centre[0]) / size, b = (x[1] - centre[1]) / size;
    if constexpr (Dim == 2) {
      return {1, a, b, a * a, a * b, b * b};
    } else {
      const double c = (x[2] - centre[2]) / size;
      return {1, a, b, c, a * a, a * b, b * b, b * c, c * c, c * a};
    }
  }
  double at(const Point& x, int column) const {
    const auto powers = basis(x);
    double sum = 0;
    for (int k = 0; k < terms<Dim>; ++k) sum += powers[k] * coefficients[terms<Dim> * column + k];
    return sum;
  }
};

/// Share of the values' range by which the quadratic fit at a boundary vertex may differ from the linear one, see
/// Recovery. In space it is larger, because patches are wider and a linear polynomial fits them less well.
template <int Dim>
constexpr double smooth = Dim == 2 ? 0.025 : 0.1;

/// Linear fit from the leading terms of the quadratic fit's normal equations: (column, term).
template <int terms>
std::vector<double> linear_fit(const double (&a)[terms][terms], const std::vector<double>& right, int columns) {
  constexpr int n = terms == 6 ? 3 : 4;
  double leading[n][n];
  std::vector<double> result(static_cast<std::size_t>(n) * columns);
  for (int r = 0; r < n; ++r) {
    for (int s = 0; s < n; ++s) leading[r][s] = a[r][s];
    for (int c = 0; c < columns; ++c) result[n * c + r] = right[terms * c + r];
  }
  solve_normal(leading, result);
  return result;
}

/// Blends the quadratic fit into the linear one where they differ by more than a small share of the ranges; both are
/// about the vertex.
template <int Dim>
void make_linear_where_steep(Polynomial<Dim>& fitted, const std::vector<double>& linear,
                             const std::vector<double>& ranges) {
  for (std::size_t c = 0; c < ranges.size(); ++c) {
    double* quadratic = &fitted.coefficients[terms<Dim> * c];
    const double* line = &linear[(Dim + 1) * c];
    const double apart = std::abs(quadratic[0] - line[0]), small = smooth<Dim> * ranges[c];
    const double share = apart > small ? std::max(2 - apart / small, 0.0) : 1.0;
    for (int k = 0; k < terms<Dim>; ++k) {
      const double from = k <= Dim ? line[k] : 0.0;
      quadratic[k] = from + share * (quadratic[k] - from);
    }
  }
}

}  // namespace

Point Recovery::position(const GhostedMesh::Element& element, const SoilBlock& block, int point, const Positions& x) {
  Point result{};
  const int dim = dimension(block.shape);
  for (int a = 0; a < block.u.nodes; ++a)
    for (int d = 0; d < dim; ++d) result[d] += block.u.N(point, a) * x[element.nodes[a]][d];
  return result;
}

Point BlockPoints::place(int element, int point) const {
  const Point at = Recovery::position(mesh.elements()[element], block, point, x);
  return turned ? AxialSection::place(at) : at;
}

RecoveryPatches::RecoveryPatches(const GhostedMesh& mesh, const SoilBlock& block) : of_node_(mesh.num_nodes(), -1) {
  std::map<int, std::set<int>> around;  // elements at a vertex
  const int nodes = num_nodes(block.shape);
  std::vector<char> needed(mesh.num_nodes(), 0);
  const auto need = [&](const GhostedMesh::Element& element) {
    for (int a = 0; a < num_corners(block.shape); ++a) needed[element.nodes[a]] = 1;
  };
  for (int e : mesh.own_elements(block.block)) need(mesh.elements()[e]);
  for (int e : mesh.block_elements(block.block)) {
    const auto& element = mesh.elements()[e];
    if (std::any_of(element.nodes.begin(), element.nodes.begin() + nodes, [&](int node) { return mesh.owns(node); }))
      need(element);
  }
  for (int e : mesh.block_elements(block.block))
    for (int a = 0; a < num_corners(block.shape); ++a)
      if (needed[mesh.elements()[e].nodes[a]]) around[mesh.elements()[e].nodes[a]].insert(e);
  for (auto& [node, elements] : around) {
    cut_ = cut_ || !mesh.is_complete(node);
    while (elements.size() * block.points < enough_points(mesh.dimension())) {
      std::set<int> wider = elements;
      for (int e : elements)
        for (int s = 0; s < num_sides(block.shape); ++s) {
          const int other = mesh.elements()[e].neighbours[s];
          cut_ = cut_ || other == GhostedMesh::unknown;
          if (other >= 0 && mesh.elements()[other].block == block.block) wider.insert(other);
        }
      if (wider.size() == elements.size()) break;
      elements.swap(wider);
    }
    of_node_[node] = static_cast<int>(patches_.size());
    patches_.push_back({node, {elements.begin(), elements.end()}});
  }
}

Recovery::Recovery(const GhostedMesh& mesh, const SoilBlock& block, const RecoveryPatches& patches, const Positions& x,
                   const std::vector<double>& table, int columns)
    : mesh_(mesh),
      block_(block),
      table_(table),
      columns_(columns),
      nodal_(static_cast<std::size_t>(mesh.num_nodes()) * columns, 0.0) {
  mesh.dimension() == 2 ? fit<2>(patches, x) : fit<3>(patches, x);
  find_ranges();
}

template <int Dim>
void Recovery::fit(const RecoveryPatches& patches, const Positions& x) {
  constexpr int terms = mudline::terms<Dim>;
  const bool has_axis = mesh_.mesh().geometry() == Geometry::axisymmetric;
  std::vector<Polynomial<Dim>> polynomials;
  std::vector<Point> places;
  for (const auto& [node, elements] : patches.patches()) {
    Polynomial<Dim> fitted{x[node], 0, std::vector<double>(terms * columns_, 0.0)};
    places.clear();
    for (int e : elements)
      for (int q = 0; q < block_.points; ++q) {
        places.push_back(position(mesh_.elements()[e], block_, q, x));
        fitted.size = std::max(fitted.size, distance(places.back(), x[node]));
      }
    double a[terms][terms] = {};
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto powers = fitted.basis(places[i]);
      const double* values = row(elements[i / block_.points], static_cast<int>(i % block_.points));
      for (int r = 0; r < terms; ++r) {
        for (int s = 0; s < terms; ++s) a[r][s] += powers[r] * powers[s];
        for (int c = 0; c < columns_; ++c) fitted.coefficients[terms * c + r] += powers[r] * values[c];
      }
    }
    const bool one_sided = mesh_.on_boundary(node) && !(has_axis && x[node][0] == 0);
    const std::vector<double> linear = one_sided ? linear_fit(a, fitted.coefficients, columns_) : std::vector<double>();
    solve_normal(a, fitted.coefficients);
    if (one_sided) make_linear_where_steep(fitted, linear, ranges(elements));
    for (int c = 0; c < columns_; ++c) nodal_[static_cast<std::size_t>(node) * columns_ + c] = fitted.at(x[node], c);
    polynomials.push_back(std::move(fitted));
  }
  for (int a = num_corners(block_.shape); a < num_nodes(block_.shape); ++a) {
    const std::vector<int> around = corners_around(block_.shape, a);
    for (int e : mesh_.block_elements(block_.block)) {
      const auto& n = mesh_.elements()[e].nodes;
      for (int c = 0; c < columns_; ++c) {
        double sum = 0;
        int share = 0;
        for (int b : around) {
          if (patches.at(n[b]) < 0) continue;  // another rank's node
          sum += polynomials[patches.at(n[b])].at(x[n[a]], c);
          ++share;
        }
        if (share > 0) nodal_[static_cast<std::size_t>(n[a]) * columns_ + c] = sum / share;
      }
    }
  }
  mesh_.fill(nodal_, columns_);
}

std::vector<double> Recovery::ranges(const std::vector<int>& elements) const {
  std::vector<double> low(columns_, 1e300), high(columns_, -1e300);
  for (int e : elements)
    for (int q = 0; q < block_.points; ++q)
      for (int c = 0; c < columns_; ++c) {
        low[c] = std::min(low[c], row(e, q)[c]);
        high[c] = std::max(high[c], row(e, q)[c]);
      }
  for (int c = 0; c < columns_; ++c) high[c] -= low[c];
  return high;
}

std::vector<double> Recovery::bounded_nodes() const {
  const auto& elements = mesh_.elements();
  std::vector<double> bounded = nodal_, low(nodal_.size(), 1e300), high(nodal_.size(), -1e300);
  for (int e : mesh_.block_elements(block_.block)) {
    const auto& element = elements[e];
    for (int q = 0; q < block_.points; ++q)
      for (int a = 0; a < num_nodes(element.shape); ++a)
        for (int c = 0; c < columns_; ++c) {
          const std::size_t i = static_cast<std::size_t>(element.nodes[a]) * columns_ + c;
          low[i] = std::min(low[i], row(e, q)[c]);
          high[i] = std::max(high[i], row(e, q)[c]);
        }
  }
  for (int node = 0; node < mesh_.num_nodes(); ++node)
    if (!mesh_.on_boundary(node))
      for (int c = 0; c < columns_; ++c) {
        const std::size_t i = static_cast<std::size_t>(node) * columns_ + c;
        if (low[i] <= high[i]) bounded[i] = std::clamp(nodal_[i], low[i], high[i]);
      }
  mesh_.fill(bounded, columns_);
  return bounded;
}

void Recovery::find_ranges() {
  const std::vector<double> bounded = bounded_nodes();
  range_.assign(mesh_.block_elements(block_.block).size() * columns_, {1e300, -1e300});
  for (int e : mesh_.block_elements(block_.block)) {
    std::pair<double, double>* ranges = &range_[static_cast<std::size_t>(mesh_.first_row(e, 1)) * columns_];
    const auto take = [&](const double* values) {
      for (int c = 0; c < columns_; ++c)
        ranges[c] = {std::min(ranges[c].first, values[c]), std::max(ranges[c].second, values[c])};
    };
    for (int q = 0; q < block_.points; ++q) take(row(e, q));
    const auto& element = mesh_.elements()[e];
    for (int a = 0; a < num_nodes(element.shape); ++a)
      take(&bounded[static_cast<std::size_t>(element.nodes[a]) * columns_]);
  }
}

void Recovery::changes(int e, double* values) const {
  const auto& nodes = mesh_.elements()[e].nodes;
  for (int c = 0; c < columns_; ++c) {
    double low = 1e300, high = -1e300;
    for (int a = 0; a < num_nodes(block_.shape); ++a) {
      const double value = nodal_[static_cast<std::size_t>(nodes[a]) * columns_ + c];
      low = std::min(low, value);
      high = std::max(high, value);
    }
    values[c] = high - low;
  }
}

void Recovery::interpolate(const GhostedMesh::Element& element, const double* N, int nodes, double* values) const {
  std::fill_n(values, columns_, 0.0);
  for (int a = 0; a < nodes; ++a)
    for (int c = 0; c < columns_; ++c)
      values[c] += N[a] * nodal_[static_cast<std::size_t>(element.nodes[a]) * columns_ + c];
}

void Recovery::at(const MeshPlace& place, double* values) const {
  const auto& element = mesh_.elements()[place.element];
  double N[27], dN[81];
  evaluate_shape(element.shape, place.xi, N, dN);
  interpolate(element, N, num_nodes(element.shape), values);
}

void Recovery::at_point(int e, int point, double* values) const {
  interpolate(mesh_.elements()[e], &block_.u.N(point, 0), block_.u.nodes, values);
}

}  // namespace mudline
