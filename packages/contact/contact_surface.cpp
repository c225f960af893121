#include "contact/contact_surface.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <map>

#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// Length, area or volume [m, m2, m3] of the linear cell on the corners of `shape`; node(a): local.
template <class Node>
double size_of(const Mesh& mesh, CellShape shape, Node&& node) {
  const CellShape linear = linear_partner(shape);
  const int corners = num_corners(shape), parameters = dimension(shape);
  const QuadratureRule rule = cell_quadrature(linear, 2);
  double size = 0;
  for (std::size_t q = 0; q < rule.weights.size(); ++q) {
    double N[8], dN[3 * 8];
    evaluate_shape(linear, rule.points[q].data(), N, dN);
    Point along[3] = {{}, {0, 1, 0}, {0, 0, 1}};
    for (int k = 0; k < parameters; ++k) {
      along[k] = {};
      for (int a = 0; a < corners; ++a) along[k] += dN[parameters * a + k] * mesh.place(node(a));
    }
    // a line's or a face's size is that of its column of height 1
    const Point normal = cross(along[0], parameters == 1 ? Point{0, 0, 1} : along[1]);
    size += rule.weights[q] * (parameters == 3 ? dot(normal, along[2]) : length(normal));
  }
  return size;
}

/// Height of an element above a side, from the corners only: its size over that of the side, times its dimension for a
/// triangle or a tetrahedron, times 2 for a quadrilateral of a wedge.
double height_above(const Mesh& mesh, const ElementBlock& block, const SurfaceSide& side) {
  const double content = size_of(mesh, block.shape, [&](int a) { return block.nodes(side.element, a); });
  const double base = size_of(mesh, side.shape, [&](int a) { return side.node[a]; });
  return per_box(block.shape) / per_box(side.shape) * content / base;
}

}  // namespace

std::pair<double, double> edges(const SurfaceSide& side, const ConstCoordinateView& x) {
  std::pair<double, double> result{1e300, 0};
  const int corners = num_corners(side.shape);
  for (int a = 0; a < corners; ++a) {
    const Point edge = place_of(x, side.node[(a + 1) % corners]) - place_of(x, side.node[a]);
    result = {std::min(result.first, length(edge)), std::max(result.second, length(edge))};
  }
  return result;
}

ContactSurface::ContactSurface(const Mesh& mesh, const std::string& side_set) : mesh_(mesh), exchange_(mesh_) {
  std::map<CellShape, int> rows;
  for (const Side& side : mesh_.side_sets().at(side_set)) {
    const ElementBlock& block = mesh_.blocks()[side.block];
    SurfaceSide here{side.block, side.element, side.side, side_shape(block.shape, side.side), 0, {}, 0, 0};
    for (int local : side_nodes(block.shape, side.side)) here.node[here.count++] = block.nodes(side.element, local);
    here.row = rows[here.shape]++;
    here.height = height_above(mesh_, block, here);
    sides_.push_back(here);
  }
  for (const auto& [shape, count] : rows) shapes_.push_back(shape);
  const long long local = static_cast<long long>(sides_.size());
  Teuchos::reduceAll(*mesh_.comm(), Teuchos::REDUCE_SUM, local, Teuchos::outArg(num_global_sides_));
}

double ContactSurface::shortest(const ConstCoordinateView& x) const {
  double local = 1e300, global = 0;
  for (const SurfaceSide& side : sides_) local = std::min(local, edges(side, x).first);
  Teuchos::reduceAll(*mesh_.comm(), Teuchos::REDUCE_MIN, local, Teuchos::outArg(global));
  return global;
}

double ContactSurface::longest(const ConstCoordinateView& x) const {
  double local = 0, global = 0;
  for (const SurfaceSide& side : sides_) local = std::max(local, edges(side, x).second);
  Teuchos::reduceAll(*mesh_.comm(), Teuchos::REDUCE_MAX, local, Teuchos::outArg(global));
  return global;
}

std::vector<double> ContactSurface::mean(std::vector<double> weighted, std::vector<double> weights) const {
  exchange_.sum_shared(weighted);
  exchange_.sum_shared(weights);
  for (std::size_t node = 0; node < weighted.size(); ++node)
    weighted[node] = weights[node] > 0 ? weighted[node] / weights[node] : 0.0;
  return weighted;
}

}  // namespace mudline
