#include "geometry/surface_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/errors.hpp"
#include "core/text.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// One point for all that are within a tolerance of it. Cells of twice the tolerance: a point's neighbours are in those
/// that the box around it reaches.
class PointWelder {
 public:
  explicit PointWelder(double tolerance) : tolerance_(tolerance) {}
  int number(const Point& x) {
    std::array<long long, 3> low{}, high{}, cell{};
    for (int i = 0; i < 3; ++i) {
      low[i] = std::llround(std::floor((x[i] - tolerance_) / (2 * tolerance_)));
      high[i] = std::llround(std::floor((x[i] + tolerance_) / (2 * tolerance_)));
    }
    for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0])
      for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1])
        for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2]) {
          const auto found = cells_.find(cell);
          if (found == cells_.end()) continue;
          for (const int candidate : found->second)
            if (length(points[candidate] - x) <= tolerance_) return candidate;
        }
    for (int i = 0; i < 3; ++i) cell[i] = std::llround(std::floor(x[i] / (2 * tolerance_)));
    cells_[cell].push_back(static_cast<int>(points.size()));
    points.push_back(x);
    return static_cast<int>(points.size()) - 1;
  }
  std::vector<Point> points;

 private:
  double tolerance_;
  std::map<std::array<long long, 3>, std::vector<int>> cells_;
};

std::string place_of(const Point& x) { return tuple_text(x.data(), 3); }

std::string counted(std::size_t count, const std::string& one, const std::string& several) {
  return std::to_string(count) + " " + (count == 1 ? one : several);
}

}  // namespace

Point SurfaceTriangles::area_vector(std::size_t facet) const {
  const auto& corner = facets[facet];
  return cross(points[corner[1]] - points[corner[0]], points[corner[2]] - points[corner[0]]);
}

void SurfaceTriangles::add(const SurfaceTriangles& other) {
  const int shift = static_cast<int>(points.size());
  points.insert(points.end(), other.points.begin(), other.points.end());
  for (const auto& facet : other.facets) facets.push_back({facet[0] + shift, facet[1] + shift, facet[2] + shift});
}

SurfaceTriangles welded(const SurfaceTriangles& triangles, double tolerance) {
  PointWelder welder(tolerance);
  std::vector<int> number;
  for (const Point& x : triangles.points) number.push_back(welder.number(x));
  SurfaceTriangles result;
  for (const auto& facet : triangles.facets) {
    const std::array<int, 3> corner{number[facet[0]], number[facet[1]], number[facet[2]]};
    if (corner[0] != corner[1] && corner[1] != corner[2] && corner[2] != corner[0]) result.facets.push_back(corner);
  }
  result.points = std::move(welder.points);
  return result;
}

std::vector<FacetEdge> closed_edges(const SurfaceTriangles& triangles) {
  struct Side {
    int low, high, facet, corner;
    bool upwards;  // from the lower point number to the higher one
  };
  const auto& facets = triangles.facets;
  std::vector<Side> sides;
  std::size_t flat = 0, first_flat = 0;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    double longest = 0;
    for (int k = 0; k < 3; ++k) {
      const int a = facets[f][k], b = facets[f][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<int>(f), k, a < b});
      longest = std::max(longest, length(triangles.points[a] - triangles.points[b]));
    }
    if (length(triangles.area_vector(f)) > 1e-9 * longest * longest) continue;
    if (flat++ == 0) first_flat = f;
  }
  if (flat > 0)
    throw InputError(counted(flat, "facet has", "facets have") + " no area, the first one at " +
                     place_of(triangles.points[facets[first_flat][0]]));
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::array<int, 3>{a.low, a.high, a.facet} < std::array<int, 3>{b.low, b.high, b.facet};
  });
  std::vector<FacetEdge> result;
  std::size_t open = 0, crowded = 0, against = 0;
  Point open_at{}, crowded_at{}, against_at{};
  const auto note = [&](std::size_t& count, Point& at, const Side& side) {
    if (count++ == 0) at = 0.5 * (triangles.points[side.low] + triangles.points[side.high]);
  };
  for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    if (end - i == 1)
      note(open, open_at, sides[i]);
    else if (end - i > 2)
      note(crowded, crowded_at, sides[i]);
    else if (sides[i].upwards == sides[i + 1].upwards)
      note(against, against_at, sides[i]);
    else
      result.push_back({sides[i].facet, sides[i + 1].facet, sides[i].corner});
  }
  if (open > 0)
    throw InputError("the surface is not closed: " + counted(open, "edge has", "edges have") +
                     " one facet only, the first one at " + place_of(open_at));
  if (crowded > 0)
    throw InputError(counted(crowded, "edge has", "edges have") + " more than two facets, the first one at " +
                     place_of(crowded_at));
  if (against > 0)
    throw InputError("the facets beside " + counted(against, "edge are", "edges are") +
                     " wound against each other, the first one at " + place_of(against_at));
  return result;
}

}  // namespace mudline
