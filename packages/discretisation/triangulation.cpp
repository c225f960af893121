#include "discretisation/triangulation.hpp"

#ifdef MUDLINE_HAVE_GMSH
#include <gmsh.h>

#include <cmath>
#include <map>
#include <unordered_map>

#include "core/child_process.hpp"
#include "discretisation/byte_stream.hpp"
#include "discretisation/gmsh_session.hpp"
#endif

namespace mudline {

#ifndef MUDLINE_HAVE_GMSH

bool has_triangulation() { return false; }

Triangulation triangulate(const std::vector<std::array<double, 2>>&, const std::vector<OutlinedRegion>&,
                          const std::function<double(double x, double y)>&, double) {
  throw NoTriangulation("this program was built without Gmsh (MUDLINE_GMSH=OFF)");
}

#else

namespace {

/// The sides as lines of one element each, the regions as surfaces. Tags are numbers from 1.
void outline(const std::vector<std::array<double, 2>>& vertices, const std::vector<OutlinedRegion>& regions) {
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
double twice_area(const std::vector<std::array<double, 2>>& x, const Chain& chain) {
  double sum = 0;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const auto &a = x[chain[i]], &b = x[chain[(i + 1) % chain.size()]], &origin = x[chain[0]];
    sum += (a[0] - origin[0]) * (b[1] - origin[1]) - (b[0] - origin[0]) * (a[1] - origin[1]);
  }
  return sum;
}

/// Of a boundary that cuts itself Gmsh makes something else.
void check_areas(const Triangulation& mesh, const std::vector<OutlinedRegion>& regions) {
  for (std::size_t r = 0; r < regions.size(); ++r) {
    double outlined = 0, sum = 0;
    for (const auto& loop : regions[r].loops) outlined += twice_area(mesh.points, loop);
    for (const auto& triangle : mesh.triangles[r]) sum += twice_area(mesh.points, triangle);
    if (!(std::abs(sum - outlined) <= 1e-9 * outlined)) throw NoTriangulation("its boundary cuts itself");
  }
}

/// Nodes are numbered as the elements of the regions meet them, behind the given vertices.
Triangulation read_triangles(const std::vector<std::array<double, 2>>& vertices, std::size_t regions) {
  Triangulation result{vertices, std::vector<std::vector<std::array<int, 3>>>(regions)};
  std::unordered_map<std::size_t, int> numbers;
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    gmsh::model::mesh::getNodes(tags, coordinates, parameters, 0, static_cast<int>(v) + 1);
    if (tags.size() == 1) numbers[tags[0]] = static_cast<int>(v);
  }
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, 1);
  if (!tags.empty()) throw NoTriangulation("Gmsh divided a side of the boundary");
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, 2);
  std::unordered_map<std::size_t, std::array<double, 2>> places;
  for (std::size_t i = 0; i < tags.size(); ++i) places[tags[i]] = {coordinates[3 * i], coordinates[3 * i + 1]};
  constexpr int triangle = 2;  // of Gmsh
  for (std::size_t r = 0; r < regions; ++r) {
    std::vector<std::size_t> elements, nodes;
    gmsh::model::mesh::getElementsByType(triangle, elements, nodes, static_cast<int>(r) + 1);
    for (std::size_t first = 0; first + 3 <= nodes.size(); first += 3) {
      std::array<int, 3> corners{};
      for (int a = 0; a < 3; ++a) {
        const auto [number, added] = numbers.emplace(nodes[first + a], static_cast<int>(result.points.size()));
        corners[a] = number->second;
        if (!added) continue;
        result.points.push_back(places.at(nodes[first + a]));
      }
      if (twice_area(result.points, corners) < 0) std::swap(corners[1], corners[2]);
      result.triangles[r].push_back(corners);
    }
    if (result.triangles[r].empty()) throw NoTriangulation("Gmsh made no elements in it");
  }
  return result;
}

Triangulation in_gmsh(const std::vector<std::array<double, 2>>& vertices, const std::vector<OutlinedRegion>& regions,
                      const std::function<double(double x, double y)>& size) {
  outline(vertices, regions);
  gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
  gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
  gmsh::model::mesh::setSizeCallback([&](int /*dimension*/, int /*entity*/, double x, double y, double /*z*/,
                                         auto... /*since 4.9: the size so far*/) { return size(x, y); });
  gmsh::model::mesh::generate(2);
  if (const std::string error = gmsh_error(); !error.empty()) throw NoTriangulation("Gmsh: " + error);
  const Triangulation result = read_triangles(vertices, regions.size());
  check_areas(result, regions);
  return result;
}

}  // namespace

bool has_triangulation() { return true; }

Triangulation triangulate(const std::vector<std::array<double, 2>>& vertices,
                          const std::vector<OutlinedRegion>& regions,
                          const std::function<double(double x, double y)>& size, double time_limit) {
  std::vector<char> bytes;
  try {
    bytes = in_child_process(
        [&] {
          start_gmsh();
          Triangulation made;
          try {
            made = in_gmsh(vertices, regions, size);
          } catch (const NoTriangulation&) {
            throw;
          } catch (...) {  // Gmsh throws ints and texts, depending on its version; its log knows more
            const std::string error = gmsh_error();
            throw NoTriangulation("Gmsh: " + (error.empty() ? "it gave no reason" : error));
          }
          ByteStream written;
          written(made.points)(made.triangles);
          return written.bytes();
        },
        time_limit);
  } catch (const ChildLost& lost) {
    throw NoTriangulation(std::string("Gmsh ") + lost.what());
  } catch (const std::runtime_error& failure) {
    throw NoTriangulation(failure.what());
  }
  Triangulation result;
  ByteStream stream(std::move(bytes));
  stream(result.points)(result.triangles);
  return result;
}

#endif

}  // namespace mudline
