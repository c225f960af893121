#pragma once

#include "discretisation/triangulation.hpp"

namespace mudline {

/// triangulate() and tetrahedra_in() of triangulation.hpp.
Triangulation triangulate_by_gmsh(const std::vector<Vec<double, 2>>& vertices,
                                  const std::vector<OutlinedRegion>& regions,
                                  const std::function<double(double x, double y)>& size, double time_limit);
Tetrahedra tetrahedra_by_gmsh(const std::vector<Point>& vertices, const std::vector<EnclosedRegion>& regions,
                              const std::function<double(const Point&)>& size, double time_limit);

}  // namespace mudline
