#include "discretisation/element_map.hpp"
#include "tensor/mat.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mudline {

namespace {

/// Data of a reference cell, tabulated for inner loops.
struct Reference {
  struct Side {
    int direction = -1;  // coordinate that is constant on the side; -1: the slanted side of a simplex or a wedge
    double at = 0;       // value of that coordinate
    Vec<double, 3> corner{}, along[2]{};
  };
  std::vector<Side> sides;
  std::vector<std::array<int, 3>> edges;  // (corner) the edges that meet at it
  std::vector<Vec<double, 3>> nodes;      // corners, in a quadratic cell all nodes, and the centre

  explicit Reference(CellShape shape);
  static const Reference& of(CellShape shape);
};

Reference::Reference(CellShape shape) {
  const int dim = dimension(shape);
  for (int s = 0; s < num_sides(shape); ++s) {
    const std::vector<int>& on = side_nodes(linear_partner(shape), s);
    Side side;
    side.corner = reference_node(shape, on[0]);
    for (int d = 0; d < dim; ++d) {
      const bool flat =
          std::all_of(on.begin(), on.end(), [&](int c) { return reference_node(shape, c)[d] == side.corner[d]; });
      if (!flat) continue;
      side.direction = d;
      side.at = side.corner[d];
    }
    const int ends[2] = {on[1], on.back()};
    for (int k = 0; k < 2; ++k)
      for (int d = 0; d < dim; ++d) side.along[k][d] = reference_node(shape, ends[k])[d] - side.corner[d];
    sides.push_back(side);
  }
  for (int c = 0; c < num_corners(shape); ++c) {
    std::array<int, 3> here{};
    int found = 0;
    for (int e = 0; e < num_edges(shape); ++e)
      if (edge_corners(shape, e)[0] == c || edge_corners(shape, e)[1] == c) here[found++] = e;
    edges.push_back(here);
  }
  for (int a = 0; a < num_nodes(shape); ++a) nodes.push_back(reference_node(shape, a));
  if (order(shape) == 2 && simplex_coordinates(shape) > 0) nodes.push_back(cell_centre(shape));
}

const Reference& Reference::of(CellShape shape) {
  static const std::vector<Reference> all = [] {
    std::vector<Reference> list;
    for (int s = 0; s < num_shapes; ++s) list.emplace_back(static_cast<CellShape>(s));
    return list;
  }();
  return all[static_cast<int>(shape)];
}

double beyond(CellShape shape, const Reference::Side& side, const double* xi) {
  if (side.direction >= 0) return side.at > 0 ? xi[side.direction] - side.at : side.at - xi[side.direction];
  double sum = xi[0];
  for (int d = 1; d < simplex_coordinates(shape); ++d) sum += xi[d];
  return sum - 1;
}

/// Length [m], of a vector in the plane or in space.
double length_of(int dimension, const double* v) {
  return dimension == 2 ? std::hypot(v[0], v[1]) : std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/// Factor that makes the determinant 1 for the ideal cell with edges of length 1.
double ideal(CellShape shape) { return equilateral(shape) * reference_size(shape); }

}  // namespace

double beyond_side(CellShape shape, int side, const double* xi) {
  return beyond(shape, Reference::of(shape).sides[side], xi);
}

double outside_cell(CellShape shape, const double* xi) {
  double worst = -1e300;
  for (const Reference::Side& side : Reference::of(shape).sides) worst = std::max(worst, beyond(shape, side, xi));
  return worst;
}

Vec<double, 3> cell_centre(CellShape shape) {
  Vec<double, 3> centre{};
  for (int d = 0; d < simplex_coordinates(shape); ++d) centre[d] = 1.0 / (simplex_coordinates(shape) + 1);
  return centre;
}

Vec<double, 3> on_side(CellShape shape, int side, const Vec<double, 2>& place) {
  const Reference::Side& s = Reference::of(shape).sides[side];
  Vec<double, 3> result = s.corner;
  const CellShape own = side_shape(shape, side);
  for (int k = 0; k < dimension(own); ++k)
    for (int d = 0; d < 3; ++d) result[d] += (is_simplex(own) ? place[k] : 0.5 * (1 + place[k])) * s.along[k][d];
  return result;
}

template <int Dim>
CellMap<Dim> ElementMap::map(const double* xi, Vec<double, 3>& x) const {
  Mat<double, Dim> slope = {};
  double N[27], dN[27 * Dim];
  evaluate_shape(shape_, xi, N, dN);
  x = {};
  for (int a = 0; a < nodes_; ++a)
    for (int i = 0; i < Dim; ++i) {
      x[i] += N[a] * x_[a][i];
      for (int k = 0; k < Dim; ++k) slope[i][k] += x_[a][i] * dN[Dim * a + k];
    }
  CellMap<Dim> result;
  result.compute(slope);
  return result;
}

ElementSize ElementMap::size() const {
  const auto difference = [&](int a, int b) {
    Vec<double, 3> d{};
    for (int i = 0; i < dimension_; ++i) d[i] = x_[b][i] - x_[a][i];
    return d;
  };
  const auto length = [](const Vec<double, 3>& d) { return std::hypot(d[0], d[1], d[2]); };
  ElementSize result{1e300, 0, 0};
  for (int edge = 0; edge < num_edges(shape_); ++edge) {
    const std::array<int, 2> ends = edge_corners(shape_, edge);
    const double l = length(difference(ends[0], ends[1]));
    result.shortest_edge = std::min(result.shortest_edge, l);
    result.longest_edge = std::max(result.longest_edge, l);
  }
  // divergence theorem: each side adds its outward area vector times the vector from a corner of the cell to its centre
  double content = 0, largest = 0;
  for (int s = 0; s < num_sides(shape_); ++s) {
    const std::vector<int>& nodes = side_nodes(shape_, s);
    const int corners = num_corners(side_shape(shape_, s));
    Vec<double, 3> area, middle{};
    for (int c = 0; c < corners; ++c) {
      const Vec<double, 3> from_first = difference(0, nodes[c]);
      for (int i = 0; i < 3; ++i) middle[i] += from_first[i] / corners;
    }
    if (dimension_ == 2) {
      const auto along = difference(nodes[0], nodes[1]);
      area = {along[1], -along[0], 0};
    } else {  // half the product of the diagonals; a triangle is a quadrangle whose last corner is the first
      const auto a = difference(nodes[0], nodes[2]), b = difference(nodes[1], nodes[corners == 3 ? 0 : 3]);
      area = {0.5 * (a[1] * b[2] - a[2] * b[1]), 0.5 * (a[2] * b[0] - a[0] * b[2]), 0.5 * (a[0] * b[1] - a[1] * b[0])};
    }
    for (int i = 0; i < 3; ++i) content += area[i] * middle[i] / dimension_;
    largest = std::max(largest, length(area));
  }
  result.height = content / largest;
  return result;
}

Vec<double, 3> ElementMap::mean_of_corners() const {
  Vec<double, 3> mean{};
  const int corners = num_corners(shape_);
  for (int c = 0; c < corners; ++c)
    for (int i = 0; i < dimension_; ++i) mean[i] += x_[c][i] / corners;
  return mean;
}

Vec<double, 3> ElementMap::at(const double* xi) const {
  Vec<double, 3> x;
  dimension_ == 2 ? void(map<2>(xi, x)) : void(map<3>(xi, x));
  return x;
}

double ElementMap::determinant(const double* xi) const {
  Vec<double, 3> x;
  return dimension_ == 2 ? map<2>(xi, x).det : map<3>(xi, x).det;
}

bool ElementMap::invert(const double* point, double* xi) const {
  return dimension_ == 2 ? invert_in<2>(point, xi) : invert_in<3>(point, xi);
}

template <int Dim>
bool ElementMap::invert_in(const double* point, double* xi) const {
  const Vec<double, 3> middle = cell_centre(shape_);
  std::copy(middle.begin(), middle.begin() + Dim, xi);
  for (int iteration = 0; iteration < 30; ++iteration) {
    Vec<double, 3> x;
    const CellMap<Dim> here = map<Dim>(xi, x);
    if (!(std::abs(here.det) > 0)) return false;
    double r[Dim], step[Dim];
    for (int i = 0; i < Dim; ++i) r[i] = point[i] - x[i];
    for (int k = 0; k < Dim; ++k) {
      step[k] = here.inverse[k][0] * r[0];
      for (int i = 1; i < Dim; ++i) step[k] += here.inverse[k][i] * r[i];
    }
    const double size = length_of(Dim, step);
    if (!(size < 1e6)) return false;
    const double factor = size > 1 ? 1 / size : 1.0;  // damping, as the map misleads far from the solution
    for (int k = 0; k < Dim; ++k) xi[k] += factor * step[k];
    if (size < 1e-13) return true;
  }
  return outside_cell(shape_, xi) < 0.5;
}

double ElementMap::scaled_jacobian() const {
  const Reference& reference = Reference::of(shape_);
  const int corners = num_corners(shape_);
  double length[12], product[8];
  for (int e = 0; e < num_edges(shape_); ++e) {
    const auto [from, to] = edge_corners(shape_, e);
    double edge_vector[3] = {};
    for (int i = 0; i < dimension_; ++i) edge_vector[i] = x_[to][i] - x_[from][i];
    length[e] = length_of(dimension_, edge_vector);
  }
  double widest = 0;  // largest product of a corner's edges, for the element's centre
  for (int c = 0; c < corners; ++c) {
    product[c] = length[reference.edges[c][0]];
    for (int i = 1; i < dimension_; ++i) product[c] *= length[reference.edges[c][i]];
    widest = std::max(widest, product[c]);
  }
  const double factor = ideal(shape_);
  double lowest = 1e300;
  for (std::size_t place = 0; place < reference.nodes.size(); ++place) {
    const double divisor = static_cast<int>(place) < corners ? product[place] : widest;
    const double here = factor * determinant(reference.nodes[place].data()) / divisor;
    if (std::isnan(here)) return -std::numeric_limits<double>::infinity();
    lowest = std::min(lowest, here);
  }
  return lowest;
}

}  // namespace mudline
