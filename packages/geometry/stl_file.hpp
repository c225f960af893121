#pragma once

#include <string>

#include "geometry/surface_triangles.hpp"

namespace mudline {

/// The facets of a binary or an ASCII STL file, in the file's unit of length; every facet has its own points.
/// InputError, without a position, for a file that is not an STL file.
SurfaceTriangles read_stl(const std::string& file);

}  // namespace mudline
