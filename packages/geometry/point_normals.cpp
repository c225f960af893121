#include "geometry/point_normals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/errors.hpp"
#include "core/text.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

constexpr double smooth_cosine = 0.8660254037844386;  // of 30 degrees
constexpr double stretched = 4;                       // ratio of neighbours' distances
constexpr int unknowns = 9;                           // of a cubic height over the tangent plane, 0 at the point

/// Solves a x = b with a symmetric matrix a; false where it is not clearly positive definite.
bool solve(double (&a)[unknowns][unknowns], double (&b)[unknowns]) {
  for (int k = 0; k < unknowns; ++k) {
    const double before = a[k][k];
    for (int m = 0; m < k; ++m) a[k][k] -= a[k][m] * a[k][m];
    if (!(a[k][k] > 1e-9 * before)) return false;
    a[k][k] = std::sqrt(a[k][k]);
    for (int i = k + 1; i < unknowns; ++i) {
      for (int m = 0; m < k; ++m) a[i][k] -= a[i][m] * a[k][m];
      a[i][k] /= a[k][k];
    }
  }
  for (int i = 0; i < unknowns; ++i) {
    for (int m = 0; m < i; ++m) b[i] -= a[i][m] * b[m];
    b[i] /= a[i][i];
  }
  for (int i = unknowns - 1; i >= 0; --i) {
    for (int m = i + 1; m < unknowns; ++m) b[i] -= a[m][i] * b[m];
    b[i] /= a[i][i];
  }
  return true;
}

class NormalFinder {
 public:
  explicit NormalFinder(const SurfaceTriangles& surface) : surface_(surface), around_(surface.points.size()) {
    for (std::size_t f = 0; f < surface.facets.size(); ++f) {
      facet_normals_.push_back(unit(surface.area_vector(f)));
      for (const int point : surface.facets[f]) around_[point].push_back(static_cast<int>(f));
    }
  }

  /// Mean normal of the facets, weighted by area: it is least tilted at long facets, as of shafts.
  Point mean(int point) const {
    Point sum{};
    double area = 0;
    for (const int f : around_[point]) {
      sum += surface_.area_vector(f);
      area += length(surface_.area_vector(f));
    }
    const double size = length(sum);
    if (size < 1e-6 * area)
      throw InputError("the facets around " + tuple_text(surface_.points[point].data(), 3) + " have no common normal");
    return 1 / size * sum;
  }

  /// The normal of the cubic surface, or the mean.
  Point fitted(int point) const {
    const Point normal = mean(point);
    std::set<int> ring, wide;
    for (const int f : around_[point]) ring.insert(surface_.facets[f].begin(), surface_.facets[f].end());
    for (const int neighbour : ring)
      for (const int f : around_[neighbour]) {
        if (dot(facet_normals_[f], normal) < smooth_cosine) return normal;
        wide.insert(surface_.facets[f].begin(), surface_.facets[f].end());
      }
    wide.erase(point);
    ring.erase(point);
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
    for (const int neighbour : ring) {
      const double distance = length(surface_.points[neighbour] - surface_.points[point]);
      nearest = std::min(nearest, distance);
      farthest = std::max(farthest, distance);
    }
    if (farthest > stretched * nearest) return normal;
    const int flat = std::abs(normal[0]) < 0.6 ? 0 : 1;  // an axis that is not along the normal
    Point axis{};
    axis[flat] = 1;
    const Point first = unit(cross(normal, axis)), second = cross(normal, first);
    double a[unknowns][unknowns] = {}, b[unknowns] = {}, scale = 0;
    for (const int p : wide) scale = std::max(scale, length(surface_.points[p] - surface_.points[point]));
    for (const int p : wide) {
      const Point d = 1 / scale * (surface_.points[p] - surface_.points[point]);
      const double u = dot(d, first), v = dot(d, second), weight = 1 / dot(d, d);
      const double row[unknowns] = {u, v, u * u, u * v, v * v, u * u * u, u * u * v, u * v * v, v * v * v};
      for (int i = 0; i < unknowns; ++i) {
        b[i] += weight * row[i] * dot(d, normal);
        for (int j = 0; j < unknowns; ++j) a[i][j] += weight * row[i] * row[j];
      }
    }
    if (!solve(a, b)) return normal;
    const Point result = unit(normal - b[0] * first - b[1] * second);
    double least = 1;
    for (const int f : around_[point]) least = std::min(least, dot(facet_normals_[f], normal));
    return dot(result, normal) >= least ? result : normal;
  }

 private:
  const SurfaceTriangles& surface_;
  std::vector<std::vector<int>> around_;  // facets, by point
  std::vector<Point> facet_normals_;
};

}  // namespace

std::vector<Point> point_normals(const SurfaceTriangles& surface) {
  const NormalFinder finder(surface);
  std::vector<Point> result;
  for (std::size_t i = 0; i < surface.points.size(); ++i) result.push_back(finder.fitted(static_cast<int>(i)));
  return result;
}

}  // namespace mudline
