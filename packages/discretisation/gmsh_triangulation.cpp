#include "discretisation/gmsh_triangulation.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "core/child_process.hpp"
#include "discretisation/byte_stream.hpp"
#include "discretisation/gmsh_session.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// Adds the sides to Gmsh's model as lines of one element each, and the regions as surfaces. Tags are numbers from 1.
void outline(const std::vector<Vec<double, 2>>& vertices, const std::vector<OutlinedRegion>& regions) {
  for (std::size_t v = 0; v < vertices.size(); ++v)
    gmsh::model::geo::addPoint(vertices[v][0], vertices[v][1], 0, 0, static_cast<int>(v) + 1);
  std::map<std::pair<int, int>, int> lines;  // by their ends, as they were added
  for (std::size_t r = 0; r < regions.size(); ++r) {
    std::vector<int> curves;
    for (const std::vector<int>& loop : regions[r].loops) {
      std::vector<int> chain;
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const int from = loop[i] + 1, to = loop[(i + 1) % loop.size()] + 1;
        const auto back = lines.find({to, from});
        if (back != lines.end()) {
          chain.push_back(-back->second);
          continue;
        }
        const int line = gmsh::model::geo::addLine(from, to);
        gmsh::model::geo::mesh::setTransfiniteCurve(line, 2);
        lines[{from, to}] = line;
        chain.push_back(line);
      }
      curves.push_back(gmsh::model::geo::addCurveLoop(chain));
    }
    gmsh::model::geo::addPlaneSurface(curves, static_cast<int>(r) + 1);
  }
  gmsh::model::geo::synchronize();
}

template <class Chain>
double twice_area(const std::vector<Vec<double, 2>>& x, const Chain& chain) {
  double sum = 0;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const auto &a = x[chain[i]], &b = x[chain[(i + 1) % chain.size()]], &origin = x[chain[0]];
    sum += (a[0] - origin[0]) * (b[1] - origin[1]) - (b[0] - origin[0]) * (a[1] - origin[1]);
  }
  return sum;
}

/// Gmsh meshes another area where a boundary cuts itself.
void check_areas(const Triangulation& mesh, const std::vector<OutlinedRegion>& regions) {
  for (std::size_t r = 0; r < regions.size(); ++r) {
    double outlined = 0, sum = 0;
    for (const auto& loop : regions[r].loops) outlined += twice_area(mesh.points, loop);
    for (const auto& triangle : mesh.triangles[r]) sum += twice_area(mesh.points, triangle);
    if (!(std::abs(sum - outlined) <= 1e-9 * outlined)) throw NoTriangulation("its boundary cuts itself");
  }
}

/// Gmsh may merge vertices that are very close.
void check_sides(const Triangulation& mesh, const std::vector<OutlinedRegion>& regions) {
  for (std::size_t r = 0; r < regions.size(); ++r) {
    std::set<std::pair<int, int>> sides;
    for (const auto& triangle : mesh.triangles[r])
      for (int k = 0; k < 3; ++k) sides.insert({triangle[k], triangle[(k + 1) % 3]});
    for (const auto& loop : regions[r].loops)
      for (std::size_t i = 0; i < loop.size(); ++i)
        if (sides.count({loop[i], loop[(i + 1) % loop.size()]}) == 0)
          throw NoTriangulation("Gmsh left out a side of its boundary");
  }
}

/// Sets a point of the plane or of space from Gmsh's coordinates.
void set_place(const double* from, Vec<double, 2>& place) { place = {from[0], from[1]}; }
void set_place(const double* from, Point& place) { place = {from[0], from[1], from[2]}; }

/// Reads the simplices that Gmsh has made in the regions, turned so that their `size_of` is positive. `numbers`: the
/// given vertices by Gmsh's tags; other nodes get the numbers after those, in the order in which elements use them.
template <int corners, class Place, class Size>
std::vector<std::vector<std::array<int, corners>>> read_simplices(std::unordered_map<std::size_t, int> numbers,
                                                                  std::size_t regions, std::vector<Place>& points,
                                                                  Size&& size_of) {
  constexpr int dimension = corners - 1, type = dimension == 2 ? 2 : 4;  // of Gmsh
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, dimension);
  std::unordered_map<std::size_t, Place> places;
  for (std::size_t i = 0; i < tags.size(); ++i) set_place(&coordinates[3 * i], places[tags[i]]);
  std::vector<std::vector<std::array<int, corners>>> result(regions);
  for (std::size_t r = 0; r < regions; ++r) {
    std::vector<std::size_t> elements, nodes;  // Gmsh would write into a vector that is not empty
    gmsh::model::mesh::getElementsByType(type, elements, nodes, static_cast<int>(r) + 1);
    for (std::size_t first = 0; first + corners <= nodes.size(); first += corners) {
      std::array<int, corners> simplex{};
      for (int a = 0; a < corners; ++a) {
        const auto [number, added] = numbers.emplace(nodes[first + a], static_cast<int>(points.size()));
        simplex[a] = number->second;
        if (!added) continue;
        const auto place = places.find(nodes[first + a]);
        if (place == places.end()) throw NoTriangulation("Gmsh divided the boundary");
        points.push_back(place->second);
      }
      if (size_of(points, simplex) < 0) std::swap(simplex[corners - 2], simplex[corners - 1]);
      result[r].push_back(simplex);
    }
    if (result[r].empty()) throw NoTriangulation("Gmsh made no elements in it");
  }
  return result;
}

/// Makes `size`, a function of (x, y, z), the only source of element sizes.
template <class Size>
void take_sizes(Size&& size) {
  gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
  gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
  gmsh::model::mesh::setSizeCallback([size](int /*dimension*/, int /*entity*/, double x, double y, double z,
                                            auto... /*since 4.9: the size so far*/) { return size(x, y, z); });
}

void generate(int dimension) {
  gmsh::model::mesh::generate(dimension);
  if (const std::string error = gmsh_error(); !error.empty()) throw NoTriangulation("Gmsh: " + error);
}

Triangulation in_plane(const std::vector<Vec<double, 2>>& vertices, const std::vector<OutlinedRegion>& regions,
                       const std::function<double(double x, double y)>& size) {
  outline(vertices, regions);
  take_sizes([&](double x, double y, double /*z*/) { return size(x, y); });
  generate(2);
  std::unordered_map<std::size_t, int> numbers;
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, 0, static_cast<int>(v) + 1);
    if (tags.size() == 1) numbers[tags[0]] = static_cast<int>(v);
  }
  Triangulation result{vertices, {}};
  result.triangles =
      read_simplices<3>(std::move(numbers), regions.size(), result.points, twice_area<std::array<int, 3>>);
  check_areas(result, regions);
  check_sides(result, regions);
  return result;
}

/// Regions on the two sides of a face; -1: none.
using Sides = std::array<int, 2>;

/// The faces by the two regions that they lie between, each face once.
std::map<Sides, std::vector<std::size_t>> surfaces_between(const std::vector<EnclosedRegion>& regions) {
  struct Face {
    std::array<int, 3> corners;
    Sides sides;
  };
  std::map<std::array<int, 3>, Face> faces;  // by sorted corners
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (const std::array<int, 3>& corners : regions[r].faces) {
      std::array<int, 3> key = corners;
      std::sort(key.begin(), key.end());
      const auto [face, added] = faces.emplace(key, Face{corners, {static_cast<int>(r), -1}});
      if (!added) face->second.sides[1] = static_cast<int>(r);
    }
  std::map<Sides, std::vector<std::size_t>> result;
  for (const auto& [key, face] : faces)
    for (int corner : face.corners) result[face.sides].push_back(static_cast<std::size_t>(corner) + 1);
  return result;
}

/// Adds the surfaces to Gmsh's model as discrete ones, whose triangles Gmsh keeps, and the regions as volumes. Tags are
/// numbers from 1.
void enclose(const std::vector<Point>& vertices, const std::vector<EnclosedRegion>& regions) {
  constexpr int triangle = 2;  // of Gmsh
  std::vector<std::vector<int>> around(regions.size());
  bool first = true;
  for (const auto& [sides, nodes] : surfaces_between(regions)) {
    const int tag = gmsh::model::addDiscreteEntity(2);
    for (int region : sides)
      if (region >= 0) around[region].push_back(tag);
    if (first) {  // the nodes of all surfaces
      std::vector<std::size_t> tags;
      std::vector<double> coordinates;
      for (std::size_t v = 0; v < vertices.size(); ++v) {
        tags.push_back(v + 1);
        coordinates.insert(coordinates.end(), vertices[v].begin(), vertices[v].end());
      }
      gmsh::model::mesh::addNodes(2, tag, tags, coordinates);
    }
    first = false;
    gmsh::model::mesh::addElementsByType(tag, triangle, {}, nodes);
  }
  for (std::size_t r = 0; r < regions.size(); ++r)
    gmsh::model::geo::addVolume({gmsh::model::geo::addSurfaceLoop(around[r])}, static_cast<int>(r) + 1);
  gmsh::model::geo::synchronize();
}

double six_volumes(const std::vector<Point>& x, const std::array<int, 4>& t) {
  return dot(x[t[1]] - x[t[0]], cross(x[t[2]] - x[t[0]], x[t[3]] - x[t[0]]));
}

/// The tetrahedra fill another volume than the surface encloses where the surface cuts itself.
void check_volumes(const Tetrahedra& mesh, const std::vector<EnclosedRegion>& regions) {
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const int origin = regions[r].faces[0][0];
    double enclosed = 0, sum = 0;
    for (const auto& face : regions[r].faces) enclosed += six_volumes(mesh.points, {origin, face[0], face[1], face[2]});
    for (const auto& tetrahedron : mesh.tetrahedra[r]) sum += six_volumes(mesh.points, tetrahedron);
    if (!(std::abs(sum - enclosed) <= 1e-9 * enclosed)) throw NoTriangulation("its boundary cuts itself");
  }
}

Tetrahedra in_space(const std::vector<Point>& vertices, const std::vector<EnclosedRegion>& regions,
                    const std::function<double(const Point&)>& size) {
  enclose(vertices, regions);
  take_sizes([&](double x, double y, double z) { return size({x, y, z}); });
  gmsh::option::setNumber("Mesh.Optimize", 1);
  constexpr int delaunay = 1;  // HXT does not repeat its mesh
  gmsh::option::setNumber("Mesh.Algorithm3D", delaunay);
  generate(3);
  std::unordered_map<std::size_t, int> numbers;
  for (std::size_t v = 0; v < vertices.size(); ++v) numbers[v + 1] = static_cast<int>(v);
  Tetrahedra result{vertices, {}};
  result.tetrahedra = read_simplices<4>(std::move(numbers), regions.size(), result.points, six_volumes);
  check_volumes(result, regions);
  return result;
}

void transfer(ByteStream& stream, Triangulation& mesh) { stream(mesh.points)(mesh.triangles); }
void transfer(ByteStream& stream, Tetrahedra& mesh) { stream(mesh.points)(mesh.tetrahedra); }

/// The result of `work`, which runs with Gmsh open in a process of its own.
template <class Result, class Work>
Result made_in_gmsh(double time_limit, Work&& work) {
  std::vector<char> bytes;
  try {
    bytes = in_child_process(
        [&] {
          start_gmsh();
          Result made;
          try {
            made = work();
          } catch (const NoTriangulation&) {
            throw;
          } catch (const std::bad_alloc&) {
            throw;
          } catch (...) {  // Gmsh throws ints or strings, depending on its version; its log says more
            const std::string error = gmsh_error();
            throw NoTriangulation("Gmsh: " + (error.empty() ? "it gave no reason" : error));
          }
          ByteStream written;
          transfer(written, made);
          return written.bytes();
        },
        {time_limit});
  } catch (const ChildLost&) {
    throw;
  } catch (const std::runtime_error& failure) {
    throw NoTriangulation(failure.what());
  }
  Result result;
  ByteStream stream(std::move(bytes));
  transfer(stream, result);
  return result;
}

}  // namespace

Triangulation triangulate_by_gmsh(const std::vector<Vec<double, 2>>& vertices,
                                  const std::vector<OutlinedRegion>& regions,
                                  const std::function<double(double x, double y)>& size, double time_limit) {
  return made_in_gmsh<Triangulation>(time_limit, [&] { return in_plane(vertices, regions, size); });
}

Tetrahedra tetrahedra_by_gmsh(const std::vector<Point>& vertices, const std::vector<EnclosedRegion>& regions,
                              const std::function<double(const Point&)>& size, double time_limit) {
  return made_in_gmsh<Tetrahedra>(time_limit, [&] { return in_space(vertices, regions, size); });
}

}  // namespace mudline
