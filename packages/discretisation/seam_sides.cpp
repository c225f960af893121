#include "discretisation/seam_sides.hpp"

#include <cmath>
#include <limits>

#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// Number of pieces per edge of a side, enough to follow its curve.
int divisions(CellShape side) {
  if (dimension(side) == 1) return order(side) == 1 ? 1 : 8;
  if (order(side) == 2) return 4;
  return is_simplex(side) ? 1 : 2;
}

/// Computes the points and pieces of a side.
void divide(const ElementMap& map, SeamSide& side) {
  const int face = side.at.place.side, n = divisions(side_shape(map.shape(), face));
  const auto add = [&](double s, double t) {
    side.points.push_back(map.at(on_side(map.shape(), face, Vec<double, 2>{s, t}).data()));
  };
  if (side.corners == 2) {
    for (int k = 0; k <= n; ++k) add(-1 + 2.0 * k / n, 0);
    for (int k = 0; k < n; ++k) side.pieces.push_back({k, k + 1, -1});
    return;
  }
  const bool triangle = side.corners == 3;
  std::vector<std::vector<int>> number(n + 1);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= (triangle ? n - j : n); ++i) {
      number[j].push_back(static_cast<int>(side.points.size()));
      if (triangle)
        add(double(i) / n, double(j) / n);
      else
        add(-1 + 2.0 * i / n, -1 + 2.0 * j / n);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < (triangle ? n - j : n); ++i) {
      side.pieces.push_back({number[j][i], number[j][i + 1], number[j + 1][i]});
      if (!triangle || i + j + 1 < n) side.pieces.push_back({number[j][i + 1], number[j + 1][i + 1], number[j + 1][i]});
    }
}

void measure(const GlobalMesh& mesh, const ElementMap& map, SeamSide& side) {
  const auto corner = [&](int c) { return mesh.coordinates[side.at.nodes[c % side.corners]]; };
  side.edge = std::numeric_limits<double>::max();
  for (int c = 0; c < (side.corners == 2 ? 1 : side.corners); ++c) {
    const Point span = corner(c + 1) - corner(c);
    side.edge = std::min(side.edge, std::sqrt(dot(span, span)));
  }
  if (side.corners == 2) {
    const Point span = corner(1) - corner(0);
    side.normal = {span[1], -span[0], 0};
  } else {
    const int last = side.corners == 3 ? 0 : 1;  // a quadrilateral's area: half the product of its diagonals
    side.normal = cross(corner(side.corners == 3 ? 1 : 2) - corner(0), corner(side.corners - 1) - corner(last));
    for (double& n : side.normal) n *= 0.5;
  }
  side.measure = std::sqrt(dot(side.normal, side.normal));
  // The determinant is the size of the cell over that of the reference cell. The size of a simplex is 1/2 (in space
  // 1/3) of side times depth, that of a wedge 1/2 for its quadrilaterals.
  const CellShape shape = map.shape();
  const double share = reference_size(shape) * per_box(shape) / per_box(side_shape(shape, side.at.place.side));
  const double depth = map.determinant(cell_centre(shape).data()) * share / side.measure;
  side.size = std::min(side.edge, depth);
}

/// Distance of a point from a triangle (Ericson 2005, 5.1.5).
double distance_to_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point ab = b - a, ac = c - a, n = cross(ab, ac), ap = p - a;
  const double square = dot(n, n);
  if (square > 0) {
    const double v = dot(cross(ap, ac), n) / square, w = dot(cross(ab, ap), n) / square;
    if (v >= 0 && w >= 0 && v + w <= 1) return std::abs(dot(ap, n)) / std::sqrt(square);
  }
  return std::min({distance_to_piece(p, a, b), distance_to_piece(p, b, c), distance_to_piece(p, c, a)});
}

}  // namespace

std::vector<SeamSide> seam_sides(const GlobalMesh& mesh) {
  std::map<std::array<long long, 3>, std::set<std::string>> sets;
  for (const auto& [name, sides] : mesh.side_sets)
    for (const auto& side : sides) sets[{side.block, side.element, side.side}].insert(name);
  std::vector<SeamSide> result;
  for (ElementSide& at : boundary_sides(mesh)) {
    SeamSide side;
    side.at = std::move(at);
    const GlobalMesh::Side& place = side.at.place;
    const ElementMap map = element_map(mesh, place.block, place.element);
    side.corners = num_corners(side_shape(map.shape(), place.side));
    divide(map, side);
    measure(mesh, map, side);
    const auto found = sets.find({place.block, place.element, place.side});
    if (found != sets.end()) side.sets = found->second;
    result.push_back(std::move(side));
  }
  return result;
}

std::vector<Vec<double, 2>> side_samples(CellShape side, bool few) {
  std::vector<Vec<double, 2>> samples;
  if (dimension(side) == 1) {
    for (double t : {-0.8, -0.4, 0.0, 0.4, 0.8})
      if (!few || std::abs(t) != 0.4) samples.push_back({t, 0});
    return samples;
  }
  if (!is_simplex(side)) {
    for (double s : {-0.8, 0.0, 0.8})
      for (double t : {-0.8, 0.0, 0.8})
        if (!few || (s == 0) == (t == 0)) samples.push_back({s, t});
    return samples;
  }
  samples = {{1.0 / 3, 1.0 / 3}, {0.1, 0.1}, {0.8, 0.1}, {0.1, 0.8}};
  if (!few) samples.insert(samples.end(), {{0.45, 0.1}, {0.45, 0.45}, {0.1, 0.45}});
  return samples;
}

double distance_to_piece(const Point& point, const Point& a, const Point& b) {
  const Point span = b - a, off = point - a;
  const double square = dot(span, span);
  const double t = square > 0 ? std::min(std::max(dot(off, span) / square, 0.0), 1.0) : 0.0;
  const Point rest{off[0] - t * span[0], off[1] - t * span[1], off[2] - t * span[2]};
  return std::sqrt(dot(rest, rest));
}

double distance_to(const SeamSide& side, const Point& point) {
  double nearest = std::numeric_limits<double>::max();
  for (const auto& [a, b, c] : side.pieces)
    nearest = std::min(nearest, c < 0 ? distance_to_piece(point, side.points[a], side.points[b])
                                      : distance_to_triangle(point, side.points[a], side.points[b], side.points[c]));
  return nearest;
}

}  // namespace mudline
