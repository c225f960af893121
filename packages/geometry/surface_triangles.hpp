#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/function.hpp"

namespace mudline {

/// A surface of flat triangles, their corners counter-clockwise as seen from outside the body.
struct SurfaceTriangles {
  std::vector<Point> points;               // [m]
  std::vector<std::array<int, 3>> facets;  // points of their corners

  /// Twice the area [m2] times the outer normal.
  Point area_vector(std::size_t facet) const;
  /// Adds the facets of another surface together with its points.
  void add(const SurfaceTriangles& other);
};

/// The surface with one point where several are within `tolerance` [m] of each other, and without the facets of which
/// two corners become one.
SurfaceTriangles welded(const SurfaceTriangles& triangles, double tolerance);

/// An edge that two facets share. It runs from the corner `corner` of the first facet to its next corner.
struct FacetEdge {
  int facet, neighbour, corner;
};

/// All edges of a surface that encloses a body, each once. InputError, without a position, for facets without area,
/// edges with one facet only (and how many these are) or with more than two, and neighbours that are wound against each
/// other.
std::vector<FacetEdge> closed_edges(const SurfaceTriangles& triangles);

}  // namespace mudline
