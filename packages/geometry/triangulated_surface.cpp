#include "geometry/triangulated_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "core/text.hpp"
#include "geometry/point_normals.hpp"
#include "tensor/mat.hpp"

namespace mudline {

namespace {

Bounds bounds_of(const std::vector<Point>& points) {
  Bounds result = Bounds::nothing();
  for (const Point& x : points) result.enclose(x);
  return result;
}

double angle_between(const Point& a, const Point& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

double enclosed_volume(const SurfaceTriangles& surface) {
  // relative to the first point, for less rounding far from the origin
  double sum = 0;
  for (std::size_t f = 0; f < surface.facets.size(); ++f)
    sum += dot(surface.points[surface.facets[f][0]] - surface.points[0], surface.area_vector(f)) / 6;
  return sum;
}

/// InputError where a facet is at more than 87 degrees to the normal at one of its points: it can have no patch.
void check_folds(const SurfaceTriangles& surface, const std::vector<Point>& normals) {
  for (std::size_t f = 0; f < surface.facets.size(); ++f)
    for (const int point : surface.facets[f])
      if (dot(normals[point], surface.area_vector(f)) < 0.05 * length(surface.area_vector(f)))
        throw InputError("the surface is folded at " + tuple_text(surface.points[point].data(), 3) +
                         ": a facet is at more than 87 degrees to the mean of those around that point");
}

/// First and second derivatives of the gap where the closest point is at a patch's point: normal and turning.
void differentiate(const PatchPoint& at, SurfaceProjection& projection) {
  projection.normal = unit(cross(at.da, at.db));
  const Mat<double, 2> metric = {{{dot(at.da, at.da), dot(at.da, at.db)}, {dot(at.da, at.db), dot(at.db, at.db)}}};
  const double aa = -dot(at.daa, projection.normal), ab = -dot(at.dab, projection.normal),
               bb = -dot(at.dbb, projection.normal);
  const Mat<double, 2> bend = {{{aa, ab}, {ab, bb}}};  // dn = bend, lowered: n_a . x_b
  // dn/dx = sum of x_c (metric^-1 bend (metric + gap bend)^-1)_cd x_d
  Mat<double, 2> offset;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) offset[i][j] = metric[i][j] + projection.gap * bend[i][j];
  const double det = metric[0][0] * metric[1][1] - metric[0][1] * metric[1][0];
  const double offset_det = offset[0][0] * offset[1][1] - offset[0][1] * offset[1][0];
  if (std::abs(offset_det) <= 1e-9 * det) return;  // a centre of curvature
  const Mat<double, 2> inverse = {
      {{metric[1][1] / det, -metric[0][1] / det}, {-metric[1][0] / det, metric[0][0] / det}}};
  const Mat<double, 2> offset_inverse = {{{offset[1][1] / offset_det, -offset[0][1] / offset_det},
                                          {-offset[1][0] / offset_det, offset[0][0] / offset_det}}};
  const Point side[2] = {at.da, at.db};
  for (int c = 0; c < 2; ++c)
    for (int d = 0; d < 2; ++d) {
      double factor = 0;
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l) factor += inverse[c][k] * bend[k][l] * offset_inverse[l][d];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          projection.turning[i][j] += factor * 0.5 * (side[c][i] * side[d][j] + side[d][i] * side[c][j]);
    }
}

}  // namespace

TriangulatedSurface::TriangulatedSurface(const SurfaceTriangles& triangles) {
  if (triangles.facets.empty()) throw InputError("the surface has no facets");
  SurfaceTriangles surface = welded(triangles, 1e-7 * bounds_of(triangles.points).extent());
  const std::vector<FacetEdge> edges = closed_edges(surface);
  if (enclosed_volume(surface) < 0)
    for (auto& facet : surface.facets) std::swap(facet[1], facet[2]);
  for (const FacetEdge& edge : edges)
    largest_angle_ =
        std::max(largest_angle_, angle_between(surface.area_vector(edge.facet), surface.area_vector(edge.neighbour)));
  const std::vector<Point> normals = point_normals(surface);
  check_folds(surface, normals);
  std::vector<Bounds> boxes;
  bounds_ = Bounds::nothing();
  for (const auto& facet : surface.facets) {
    patches_.emplace_back(
        std::array<Point, 3>{surface.points[facet[0]], surface.points[facet[1]], surface.points[facet[2]]},
        std::array<Point, 3>{normals[facet[0]], normals[facet[1]], normals[facet[2]]});
    largest_bulge_ = std::max(largest_bulge_, patches_.back().bulge());
    boxes.push_back(patches_.back().bounds());
    bounds_.enclose(boxes.back().low);
    bounds_.enclose(boxes.back().high);
  }
  tree_ = std::make_unique<const BoxTree>(std::move(boxes));
}

SurfaceProjection TriangulatedSurface::closest(const Point& x) const {
  // a patch is solved for only where its facet is near enough; that of the nearest facet comes first
  double square = std::numeric_limits<double>::infinity();
  int first = 0;
  tree_->search(x, square, [&](int number) {
    const double distance = patches_[number].flat_distance(x);
    if (distance * distance >= square) return;
    square = distance * distance;
    first = number;
  });
  PatchPoint nearest = patches_[first].closest(x);
  const auto square_distance = [&](const PatchPoint& at) {
    const Point d = x - at.x;
    return dot(d, d);
  };
  square = square_distance(nearest);
  tree_->search(x, square, [&](int number) {
    const double bound = patches_[number].flat_distance(x) - patches_[number].bulge();
    if (number == first || (bound > 0 && bound * bound >= square)) return;
    const PatchPoint candidate = patches_[number].closest(x);
    if (square_distance(candidate) >= square) return;
    square = square_distance(candidate);
    nearest = candidate;
  });
  SurfaceProjection result{};
  result.point = nearest.x;
  result.gap = std::sqrt(square);
  if (dot(x - nearest.x, cross(nearest.da, nearest.db)) < 0) result.gap = -result.gap;
  differentiate(nearest, result);
  return result;
}

SurfaceTriangles TriangulatedSurface::triangles(double chord_error) const {
  // second derivatives of a quartic make up to three times its distance from the facet
  const int n = std::max(1, static_cast<int>(std::ceil(std::sqrt(3 * largest_bulge_ / chord_error))));
  SurfaceTriangles result;
  const auto number = [](int i, int j) { return (i + j) * (i + j + 1) / 2 + j; };
  for (const SmoothPatch& patch : patches_) {
    const int first = static_cast<int>(result.points.size());
    for (int row = 0; row <= n; ++row)
      for (int j = 0; j <= row; ++j)
        result.points.push_back(patch.at(static_cast<double>(row - j) / n, static_cast<double>(j) / n).x);
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        result.facets.push_back({first + number(i, j), first + number(i + 1, j), first + number(i, j + 1)});
        if (i + j + 1 < n)
          result.facets.push_back({first + number(i + 1, j), first + number(i + 1, j + 1), first + number(i, j + 1)});
      }
  }
  return welded(result, 1e-9 * bounds_.extent());
}

SolidMoments TriangulatedSurface::moments() const {
  // quadrature rule of degree 5
  constexpr double near = 0.1012865073234563, far = 0.4701420641051151;
  constexpr double at[7][3] = {{1.0 / 3, 1.0 / 3, 0.1125},
                               {near, near, 0.0629695902724136},
                               {1 - 2 * near, near, 0.0629695902724136},
                               {near, 1 - 2 * near, 0.0629695902724136},
                               {far, far, 0.0661970763942531},
                               {1 - 2 * far, far, 0.0661970763942531},
                               {far, 1 - 2 * far, 0.0661970763942531}};
  SolidMoments result;
  for (const SmoothPatch& patch : patches_)
    for (const auto& q : at) {
      const PatchPoint p = patch.at(q[0], q[1]);
      result.add_side(p.x, q[2] * cross(p.da, p.db));
    }
  return result;
}

}  // namespace mudline
