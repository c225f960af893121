#pragma once

#include "geometry/surface_triangles.hpp"

namespace mudline {

/// Unit normals at the points of a closed surface: those of a cubic surface that goes through the point and is fitted
/// to its neighbours and their neighbours by least squares. Instead, the mean of the facets' normals at the point,
/// weighted by area, is taken where a facet in reach is at more than 30 degrees to it, so that the body has an edge
/// there; where the neighbours' distances differ by more than 4 to 1, as on the long facets of shafts; where the points
/// do not determine a cubic surface; and where its normal is farther from the mean than those of the facets.
/// InputError, without a position, where the mean vanishes.
std::vector<Point> point_normals(const SurfaceTriangles& surface);

}  // namespace mudline
