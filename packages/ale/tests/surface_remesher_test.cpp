// Remeshing of surfaces, without a mesh inside.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "ale/surface_remesher.hpp"
#include "ale_mesh.hpp"
#include "core/pi.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

using testing::cube;

/// The surface of a cube of ten-node tetrahedra, mapped to another shape.
struct Surface {
  explicit Surface(const std::function<Point(const Point&)>& map, int n = 4)
      : mesh(cube(CellShape::tet10, n, 0)), whole(*mesh) {
    source = whole.gather(mesh->coordinates());
    surfaces = split_surfaces(boundary_faces(whole), source, {}, pi / 6, [](int) { return false; });
    for (const Point& place : source) x.push_back(map(place));
    relative.assign(x.size(), 1.0);
  }
  RemeshedSurface remesh(const std::function<double(const Point&)>& size) const {
    const SurfaceSizes sizes{relative, [&](double factor, const Point& at) { return factor * size(at); }};
    return SurfaceRemesher(surfaces, x, sizes).remesh();
  }
  std::unique_ptr<Mesh> mesh;
  GhostedMesh whole;
  MeshSurfaces surfaces;
  Positions source, x;
  std::vector<double> relative;
};

/// Maps the cube to a round bar of radius 1 and length 3: squares become circles.
Point bar(const Point& p) {
  const double a = 2 * p[0] - 1, b = 2 * p[1] - 1, far = std::max(std::abs(a), std::abs(b)), r = std::hypot(a, b);
  return r > 0 ? Point{a * far / r, b * far / r, 3 * p[2]} : Point{0, 0, 3 * p[2]};
}

struct Measures {
  double area = 0, volume = 0, quality = 1;
};

Measures measures(const RemeshedSurface& made) {
  Measures result;
  for (const auto& face : made.faces) {
    const Point &a = made.vertices[face.vertices[0]].place, &b = made.vertices[face.vertices[1]].place,
                &c = made.vertices[face.vertices[2]].place;
    const Point ab = b - a, ac = c - a, bc = c - b;
    const double twice = length(cross(ab, ac));
    result.area += 0.5 * twice;
    result.volume += dot(a, cross(b, c)) / 6;
    result.quality = std::min(result.quality, 2 * std::sqrt(3.0) * twice / (dot(ab, ab) + dot(ac, ac) + dot(bc, bc)));
  }
  return result;
}

/// Whether every edge has one face on either side.
bool closed(const RemeshedSurface& made) {
  std::map<std::pair<int, int>, int> directed;
  for (const auto& face : made.faces)
    for (int k = 0; k < 3; ++k) ++directed[{face.vertices[k], face.vertices[(k + 1) % 3]}];
  for (const auto& [edge, count] : directed)
    if (count != 1 || !directed.count({edge.second, edge.first})) return false;
  return !directed.empty();
}

double size_at(const RemeshedSurface& made, int face, int k, const std::function<double(const Point&)>& size) {
  const Point &a = made.vertices[made.faces[face].vertices[k]].place,
              &b = made.vertices[made.faces[face].vertices[(k + 1) % 3]].place;
  return 2 * distance(a, b) / (size(a) + size(b));
}

TEST(SurfaceRemesher, ABarGetsFacesOfTheWantedSizeOnItsSurface) {
  const Surface was(bar);
  const auto size = [](const Point& x) { return 0.2 + 0.1 * x[2]; };
  const RemeshedSurface made = was.remesh(size);
  EXPECT_GT(made.faces.size(), 1.5 * was.surfaces.faces.size());
  EXPECT_TRUE(closed(made));
  const Measures now = measures(made);
  EXPECT_NEAR(now.volume, 3 * pi, 0.02 * 3 * pi);
  EXPECT_NEAR(now.area, 8 * pi, 0.02 * 8 * pi);
  EXPECT_GT(now.quality, 0.5);
  int within = 0, all = 0;
  double largest = 0;
  for (int f = 0; f < static_cast<int>(made.faces.size()); ++f)
    for (int k = 0; k < 3; ++k) {
      const double ratio = size_at(made, f, k, size);
      largest = std::max(largest, ratio);
      within += ratio > 0.6 && ratio < 1.4;
      ++all;
    }
  EXPECT_LT(largest, 1.5);
  EXPECT_GT(within, 0.95 * all);
  for (const SurfaceVertex& vertex : made.vertices) {  // the old faces are within 2e-3 of the round bar
    const double r = std::hypot(vertex.place[0], vertex.place[1]), z = vertex.place[2];
    const double off = std::min({std::abs(r - 1), std::abs(z), std::abs(z - 3)});
    EXPECT_LT(off, 2e-3);
  }
}

TEST(SurfaceRemesher, CurvesAndPatchesStayWhereTheyAre) {
  const Surface was(bar);
  const RemeshedSurface made = was.remesh([](const Point&) { return 0.25; });
  ASSERT_EQ(made.curves.size(), was.surfaces.curves.size());
  for (std::size_t c = 0; c < made.curves.size(); ++c) {
    const std::vector<int>& old = was.surfaces.curves[c].nodes;
    EXPECT_EQ(made.vertices[made.curves[c].front().vertex].node, old.front());
    EXPECT_EQ(made.vertices[made.curves[c].back().vertex].node, old.back());
    double path_length = 0;
    for (std::size_t i = 1; i < made.curves[c].size(); ++i) {
      EXPECT_GT(made.curves[c][i].s, made.curves[c][i - 1].s);
      path_length +=
          distance(made.vertices[made.curves[c][i].vertex].place, made.vertices[made.curves[c][i - 1].vertex].place);
    }
    const double exact = was.source[old.front()][2] != was.source[old.back()][2] ? 3 : 0.5 * pi;
    EXPECT_NEAR(path_length, exact, 0.01 * exact);
  }
  // Flat patches stay flat, to the last bit.
  std::map<int, double> areas;
  for (const auto& face : made.faces)
    for (int v : face.vertices) {
      const std::set<std::string>& sets = was.surfaces.patches[face.patch].sets;
      if (sets.count("bottom")) EXPECT_EQ(made.vertices[v].place[2], 0.0);
      if (sets.count("top")) EXPECT_EQ(made.vertices[v].place[2], 3.0);
    }
}

TEST(SurfaceRemesher, LongFacesAreCollapsedToo) {
  const Surface was(bar, 8);
  const RemeshedSurface made = was.remesh([](const Point&) { return 0.6; });
  EXPECT_LT(made.faces.size(), 0.5 * was.surfaces.faces.size());
  EXPECT_TRUE(closed(made));
  EXPECT_GT(measures(made).quality, 0.4);
  EXPECT_NEAR(measures(made).volume, 3 * pi, 0.08 * 3 * pi);
}

TEST(SurfaceRemesher, WhatIsGoodStaysAndWhatIsKeptToo) {
  const auto drawn = [](const Point& p) { return Point{p[0], p[1], 3 * p[2]}; };
  Surface was(drawn);
  const auto node_places = [&](const RemeshedSurface& made) {
    for (const SurfaceVertex& vertex : made.vertices)
      if (vertex.node >= 0) {
        EXPECT_LT(distance(vertex.place, was.x[vertex.node]), 1e-7);
      }
  };
  for (SurfacePatch& patch : was.surfaces.patches) patch.material = patch.sets.count("top");
  std::set<int> on_top;
  for (std::size_t node = 0; node < was.x.size(); ++node)
    if (was.source[node][2] == 1 && was.whole.is_vertex(static_cast<int>(node))) on_top.insert(static_cast<int>(node));
  for (MeshPath& path : was.surfaces.curves)
    path.material = was.source[path.nodes.front()][2] == 1 && was.source[path.nodes.back()][2] == 1;
  const RemeshedSurface made = was.remesh([](const Point&) { return 0.15; });
  EXPECT_TRUE(closed(made));
  node_places(made);
  std::size_t kept = 0, top = 0;
  for (const SurfaceVertex& vertex : made.vertices) {
    kept += on_top.count(vertex.node);
    top += vertex.place[2] == 3.0;
  }
  EXPECT_EQ(kept, on_top.size());
  EXPECT_EQ(top, on_top.size());
  // sizes of the mesh itself: nothing changes
  const Surface same([](const Point& p) { return p; });
  const RemeshedSurface again = same.remesh([](const Point&) { return 0.28; });
  ASSERT_EQ(again.faces.size(), same.surfaces.faces.size());
  for (const SurfaceVertex& vertex : again.vertices) EXPECT_GE(vertex.node, 0);
}

TEST(SurfaceRemesher, LastDigitsDoNotDecide) {
  const Surface was(bar);
  Surface shaken(bar);
  for (std::size_t node = 0; node < shaken.x.size(); ++node)
    for (int d = 0; d < 3; ++d) shaken.x[node][d] *= 1 + 3e-16 * std::sin(1.7 * node + d);
  const auto size = [](const Point& x) { return 0.2 + 0.1 * x[2]; };
  const auto noisy = [&](const Point& x) { return size(x) * (1 + 2e-16 * std::sin(1e5 * x[0])); };
  const RemeshedSurface one = was.remesh(size), other = shaken.remesh(noisy);
  ASSERT_EQ(one.faces.size(), other.faces.size());
  for (std::size_t f = 0; f < one.faces.size(); ++f) EXPECT_EQ(one.faces[f].vertices, other.faces[f].vertices);
}

}  // namespace
}  // namespace mudline
