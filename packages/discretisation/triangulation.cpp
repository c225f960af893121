#include "discretisation/triangulation.hpp"

#include "discretisation/gmsh_library.hpp"

namespace mudline {

namespace {

const GmshLibrary& library() {
  std::string why;
  if (const GmshLibrary* found = find_gmsh_library(why)) return *found;
  throw NoTriangulation(why);
}

}  // namespace

Triangulation triangulate(const std::vector<Vec<double, 2>>& vertices, const std::vector<OutlinedRegion>& regions,
                          const std::function<double(double x, double y)>& size, double time_limit) {
  if (vertices.size() > most_sides)
    throw NoTriangulation("its boundary would have " + std::to_string(vertices.size()) + " sides, more than " +
                          std::to_string(most_sides) + ": are all sizes in m, or with the right unit?");
  return library().triangulate(vertices, regions, size, time_limit);
}

Tetrahedra tetrahedra_in(const std::vector<Point>& vertices, const std::vector<EnclosedRegion>& regions,
                         const std::function<double(const Point&)>& size, double time_limit) {
  return library().tetrahedra_in(vertices, regions, size, time_limit);
}

}  // namespace mudline
