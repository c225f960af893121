// Nodes that slide on the surfaces of a mesh in space, without a mesh inside.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ale/surface_motion.hpp"
#include "core/pi.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

using Places = Positions;
using Map = std::function<Point(double, double)>;

/// Faces of n by m cells over [0, 1]^2, with the nodes of quadratic shapes.
struct Grid {
  Grid(CellShape shape, int n, int m) : shape(shape), columns(2 * n + 1), rows(2 * m + 1) {
    for (int j = 0; j < 2 * m; j += 2)
      for (int i = 0; i < 2 * n; i += 2)
        if (shape == CellShape::quad9) {
          add({id(i, j), id(i + 2, j), id(i + 2, j + 2), id(i, j + 2), id(i + 1, j), id(i + 2, j + 1), id(i + 1, j + 2),
               id(i, j + 1), id(i + 1, j + 1)});
        } else {
          add({id(i, j), id(i + 2, j), id(i, j + 2), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
          add({id(i + 2, j), id(i + 2, j + 2), id(i, j + 2), id(i + 2, j + 1), id(i + 1, j + 2), id(i + 1, j + 1)});
        }
  }
  int id(int i, int j) const { return j * columns + i; }
  void add(std::array<int, 9> nodes) { faces.push_back({shape, nodes, {"wall"}}); }
  /// Nodes at map(u, v), the inner vertices moved by `skew` of a cell, mid-side nodes halfway between them in u and v.
  Places places(const Map& map, double skew) const {
    std::vector<Vec<double, 2>> uv(columns * rows);
    const double cell[2] = {2.0 / (columns - 1), 2.0 / (rows - 1)};
    for (int j = 0; j < rows; j += 2)
      for (int i = 0; i < columns; i += 2) {
        const bool inside = i > 0 && j > 0 && i < columns - 1 && j < rows - 1;
        for (int d = 0; d < 2; ++d)
          uv[id(i, j)][d] =
              0.5 * cell[d] * (d == 0 ? i : j) + (inside ? skew * cell[d] * std::sin(1.3 * i + 2.1 * j + d) : 0.0);
      }
    for (const SurfaceFace& face : faces)
      for (int a = num_corners(face.shape); a < num_nodes(face.shape); ++a) {
        const std::vector<int> around = corners_around(face.shape, a);
        auto& middle = uv[face.nodes[a]] = {0, 0};
        for (int c : around)
          for (int d = 0; d < 2; ++d) middle[d] += uv[face.nodes[c]][d] / around.size();
      }
    Places x;
    for (const auto& at : uv) x.push_back(map(at[0], at[1]));
    return x;
  }
  SurfaceMotion motion(const Places& source, double slide = 0.4) const {
    return {split_surfaces(faces, source, {}, pi / 6, [](int) { return false; }), source, slide};
  }
  bool inside(int node) const {
    const int i = node % columns, j = node / columns;
    return i > 0 && j > 0 && i < columns - 1 && j < rows - 1;
  }

  CellShape shape;
  int columns, rows;
  std::vector<SurfaceFace> faces;
};

Point cylinder(double u, double v) {
  const double angle = pi * (u - 0.5);
  return {std::cos(angle), std::sin(angle), 2 * v};
}
Point flat(double u, double v) { return {3 * u, v, 0.3}; }

std::optional<NearBody> no_body(const Point&) { return {}; }

double distance_from(const Places& x, const Places& y) {
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, length(x[i] - y[i]));
  return largest;
}

/// Whether no corner of the faces is folded against the outward direction.
bool sound(const Grid& grid, const Places& x, const std::function<Point(const Point&)>& outward) {
  for (const SurfaceFace& face : grid.faces) {
    const int corners = num_corners(face.shape);
    for (int c = 0; c < corners; ++c) {
      const Point &at = x[face.nodes[c]], &next = x[face.nodes[(c + 1) % corners]],
                  &before = x[face.nodes[(c + corners - 1) % corners]];
      if (!(dot(cross(next - at, before - at), outward(at)) > 0)) return false;
    }
  }
  return true;
}

TEST(MeshSurfaces, ABoxHasSixPatchesTwelveCurvesAndMaterialCorners) {
  // a box of one cell's faces, of which one belongs to another set
  const Places corner = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  std::vector<SurfaceFace> faces;
  for (int side = 0; side < 6; ++side) {
    const std::vector<int> nodes = side_nodes(CellShape::hex8, side);
    SurfaceFace face{CellShape::quad4, {}, {side == 5 ? "top" : "rest"}};
    std::copy(nodes.begin(), nodes.end(), face.nodes.begin());
    faces.push_back(face);
  }
  const auto off = [](int) { return false; };
  const MeshSurfaces box = split_surfaces(faces, corner, {}, pi / 6, off);
  EXPECT_EQ(box.patches.size(), 6u);
  EXPECT_EQ(box.curves.size(), 12u);
  for (int node : box.patch_of) EXPECT_EQ(node, -1);
  // Edges on a body divide patches only where the side set changes.
  const auto on = [](int) { return true; };
  const MeshSurfaces smooth = split_surfaces(faces, corner, {}, pi / 6, on);
  EXPECT_EQ(smooth.patches.size(), 2u);
  ASSERT_EQ(smooth.curves.size(), 1u);  // a closed curve around the top, cut somewhere
  EXPECT_EQ(smooth.curves[0].nodes.size(), 5u);
  EXPECT_EQ(smooth.curves[0].nodes.front(), smooth.curves[0].nodes.back());
  EXPECT_EQ(std::count(smooth.patch_of.begin(), smooth.patch_of.end(), -1), 4);
  // A named corner determines where it ends.
  const MeshSurfaces named = split_surfaces(faces, corner, {faces[5].nodes[2]}, pi / 6, on);
  ASSERT_EQ(named.curves.size(), 1u);
  EXPECT_EQ(named.curves[0].nodes.front(), faces[5].nodes[2]);
}

TEST(MeshSurfaces, RegionsDivide) {
  const Places x = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
  std::vector<SurfaceFace> faces = {{CellShape::quad4, {0, 1, 2, 3}, {}}, {CellShape::quad4, {1, 4, 5, 2}, {}}};
  const auto off = [](int) { return false; };
  EXPECT_EQ(split_surfaces(faces, x, {}, 0.5, off).patches.size(), 1u);
  faces[1].block = 1;
  EXPECT_EQ(split_surfaces(faces, x, {}, 0.5, off).patches.size(), 2u);
}

TEST(FacePlace, ClosestPointOfACurvedFace) {
  const Grid grid(CellShape::quad9, 4, 2);
  const Places x = grid.places(cylinder, 0.1);
  const SurfaceFace& face = grid.faces[5];
  for (const FacePlace& place : {FacePlace{0.2, -0.7}, FacePlace{-0.9, 0.4}}) {
    const Point n = face_normal(face, place, x);
    const ClosestOnSide found = closest_on_side(face, x, face_point(face, place, x) + 0.05 / length(n) * n);
    EXPECT_TRUE(found.inside);
    EXPECT_NEAR(found.distance, 0.05, 1e-12);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(found.place[i], place[i], 1e-11);
  }
  // beside the face: on its edge
  const ClosestOnSide beside = closest_on_side(face, x, face_point(face, {0.3, 1.4}, x));
  EXPECT_FALSE(beside.inside);
  EXPECT_NEAR(beside.place[1], 1, 1e-12);
}

/// Points on all sides of a strongly bent face, near and far: none of a grid on the face is closer than what is found.
TEST(ClosestOnSide, NoOtherPointOfABentFaceIsCloser) {
  for (const CellShape shape : {CellShape::tri6, CellShape::quad9}) {
    Places x;
    CurvedSide face{shape, {}};
    for (int a = 0; a < num_nodes(shape); ++a) {
      const auto xi = reference_node(shape, a);
      x.push_back({xi[0], xi[1] + 0.1 * xi[0] * xi[0], 0.3 * std::sin(2 * xi[0] + xi[1])});
      face.nodes[a] = a;
    }
    for (int k = 0; k < 200; ++k) {
      const Point at{-2.5 + 0.73 * (k % 7), -2.5 + 0.61 * (k % 8), -0.8 + 0.27 * (k % 9)};
      const ClosestOnSide found = closest_on_side(face, x, at);
      const auto place = [&](double a, double b) {
        const double xi[2] = {a, b};
        double N[9], dN[18];
        evaluate_shape(shape, xi, N, dN);
        Point result{};
        for (int i = 0; i < num_nodes(shape); ++i) result += N[i] * x[i];
        return result;
      };
      EXPECT_NEAR(length(at - place(found.place[0], found.place[1])), found.distance, 1e-13);
      constexpr int n = 60;
      double least = 1e300;
      for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= (shape == CellShape::tri6 ? n - i : n); ++j) {
          const double a = 1.0 * i / n, b = 1.0 * j / n;
          const Point here = shape == CellShape::tri6 ? place(a, b) : place(2 * a - 1, 2 * b - 1);
          least = std::min(least, length(at - here));
        }
      EXPECT_LE(found.distance, least + 1e-12) << k;
      EXPECT_GE(found.distance, least - 0.06) << k;  // the grid's points are this far apart
    }
  }
}

TEST(SurfaceMotion, ASurfaceAtRestOrTurnedStaysToTheLastBit) {
  for (CellShape shape : {CellShape::tri6, CellShape::quad9})
    for (const Map& map : {Map(cylinder), Map(flat)}) {
      const Grid grid(shape, 6, 5);
      const Places source = grid.places(map, 0.1);
      const SurfaceMotion motion = grid.motion(source);
      Places x = source;
      motion.move(source, no_body, x);
      EXPECT_EQ(x, source);
      Places turned;
      for (const Point& at : source)
        turned.push_back({0.6 * at[0] - 0.8 * at[2] + 7, at[1] - 3, 0.8 * at[0] + 0.6 * at[2]});
      x = turned;
      motion.move(turned, no_body, x);
      for (std::size_t node = 0; node < x.size(); ++node) EXPECT_EQ(x[node], turned[node]) << name(shape) << node;
    }
}

TEST(SurfaceMotion, SkewedVerticesSlideBackOnTheCylinder) {
  for (CellShape shape : {CellShape::tri6, CellShape::quad9}) {
    double off[2];
    for (int level = 0; level < 2; ++level) {
      const Grid grid(shape, 8 << level, 6 << level);
      const Places source = grid.places(cylinder, 0);
      const SurfaceMotion motion = grid.motion(source);
      Places x = grid.places(cylinder, 0.25);
      const Places skewed = x;
      ASSERT_TRUE(sound(grid, x, [](const Point& at) { return Point{at[0], at[1], 0}; }));
      off[level] = 0;
      for (int times = 0; times < 3; ++times) {
        const Places before = x;
        motion.move(before, no_body, x);
        EXPECT_TRUE(sound(grid, x, [](const Point& at) { return Point{at[0], at[1], 0}; }));
        for (std::size_t node = 0; node < x.size(); ++node) {
          if (!grid.inside(static_cast<int>(node))) {
            EXPECT_EQ(x[node], source[node]);  // nodes of curves stay where they were put
          }
          off[level] = std::max(off[level], std::abs(std::hypot(x[node][0], x[node][1]) - 1));
        }
      }
      EXPECT_LT(distance_from(x, source), 0.1 * distance_from(skewed, source));
    }
    EXPECT_LT(off[0], 2e-3);
    EXPECT_GT(std::log2(off[0] / off[1]), 2.7);  // curved faces give third order
  }
}

TEST(SurfaceMotion, MiddlesOfEdgesThatBulgeFarDoNotSwing) {
  const Map wrapped = [](double u,
                         double v) {  // an edge along u spans 120 degrees: it bulges by 0.29 of its chord
    const double angle = 4.0 / 3 * pi * (u - 0.5);
    return Point{std::cos(angle), std::sin(angle), 2 * v};
  };
  for (CellShape shape : {CellShape::tri6, CellShape::quad9}) {
    const Grid grid(shape, 2, 2);
    const Places source = grid.places(wrapped, 0);
    Places x = source;
    const int middle = grid.id(1, 2), ends[] = {grid.id(0, 2), grid.id(2, 2)};
    x[middle] = wrapped(0.25 + 0.02, 0.5);
    const Point chord = x[ends[1]] - x[ends[0]];
    const Places before = x;
    grid.motion(source).move(before, no_body, x);
    const auto along = [&](const Places& places) {
      return dot(places[middle] - source[middle], chord) / dot(chord, chord);
    };
    EXPECT_GT(along(before), 0.04);
    EXPECT_LT(std::abs(along(x)), 1e-9);
  }
}

TEST(SurfaceMotion, VerticesGiveWayToATetrahedronWithoutAVertexInside) {
  // The tetrahedron has one node in a plane and three on an upright wall beside it, which is then moved.
  const Grid grid(CellShape::quad9, 4, 4);
  const auto wall = [&](double at) {
    Places x = grid.places(flat, 0);
    for (const Point& place : {Point{at, 0.4, 0.3}, Point{at, 0.6, 0.3}, Point{at, 0.5, 0.6}}) x.push_back(place);
    return x;
  };
  const int vertex = grid.id(4, 4), first = grid.columns * grid.rows;  // the vertex lies at 1.5, cells are 0.75 wide
  const BoundarySimplex simplex{{vertex, first, first + 2, first + 1}, {-1, -1, -1, -1}};
  const Places source = wall(1.8);
  MeshSurfaces surfaces = split_surfaces(grid.faces, source, {}, pi / 6, [](int) { return false; });
  const SurfaceMotion motion(surfaces, source, 0.4, {simplex});
  Places x = source;
  motion.move(source, no_body, x);
  EXPECT_EQ(x, source);
  const auto way = [&](const Places& from) {
    Places to = from;
    motion.move(from, no_body, to);
    EXPECT_EQ(to[vertex][2], from[vertex][2]);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(to[first + i], from[first + i]);
    return to[vertex][0] - from[vertex][0];
  };
  EXPECT_LT(way(wall(1.55)), -0.05);
  EXPECT_LT(way(wall(1.7)), 0);
  EXPECT_GT(way(wall(1.9)), 0);
  EXPECT_EQ(way(wall(1.4)), 0);  // the tetrahedron was folded before: it does not count
}

TEST(SurfaceMotion, ASlideIsBounded) {
  const Grid grid(CellShape::quad9, 8, 6);
  const Places source = grid.places(cylinder, 0), skewed = grid.places(cylinder, 0.25);
  Places x = skewed;
  grid.motion(source, 0.05).move(skewed, no_body, x);
  const double cell = 2.0 / 6;
  EXPECT_GT(distance_from(x, skewed), 0.01 * cell);
  EXPECT_LT(distance_from(x, skewed), 0.05 * 2 * cell);
}

TEST(SurfaceMotion, APlanePatchStaysPlane) {
  for (CellShape shape : {CellShape::tri6, CellShape::quad9}) {
    const Grid grid(shape, 8, 6);
    const Places source = grid.places(flat, 0), skewed = grid.places(flat, 0.25);
    Places x = skewed;
    grid.motion(source).move(skewed, no_body, x);
    EXPECT_GT(distance_from(x, skewed), 0.01);
    for (const Point& at : x) EXPECT_EQ(at[2], 0.3);  // to the last bit
    const auto tilted = [](double u, double v) { return Point{3 * u, 0.6 * v, 0.8 * v + 0.3}; };
    const Places slope = grid.places(tilted, 0.25);
    x = slope;
    grid.motion(grid.places(tilted, 0)).move(slope, no_body, x);
    EXPECT_GT(distance_from(x, slope), 0.01);
    for (const Point& at : x) EXPECT_NEAR(0.8 * at[1] - 0.6 * (at[2] - 0.3), 0, 1e-15);
  }
}

TEST(SurfaceMotion, VerticesGiveWayToACurveThatSlides) {
  // the lower curve slides by 40 per cent of an edge, which would fold the flat faces above it
  const Map squeezed = [](double u, double v) { return cylinder(u, v * v * v); };
  const Grid grid(CellShape::tri6, 8, 6);
  const Places source = grid.places(cylinder, 0), x_old = grid.places(squeezed, 0.1);
  Places x = x_old;
  for (int i = 1; i < grid.columns - 1; ++i) {
    const double u = (i + 0.8) / (grid.columns - 1.0);
    x[grid.id(i, 0)] = cylinder(u, 0);
  }
  const Places wanted = x;
  const SurfaceMotion motion = grid.motion(source);
  for (int times = 0; times < 3; ++times) {
    const Places before = times == 0 ? x_old : x;
    for (int i = 0; i < grid.columns; ++i) x[grid.id(i, 0)] = wanted[grid.id(i, 0)];
    motion.move(before, no_body, x);
    EXPECT_TRUE(sound(grid, x, [](const Point& at) { return Point{at[0], at[1], 0}; }));
    if (times == 0) {
      EXPECT_GT(distance_from(x, x_old), 0);
    }
  }
  for (int i = 0; i < grid.columns; ++i) EXPECT_EQ(x[grid.id(i, 0)], wanted[grid.id(i, 0)]);
}

TEST(SurfaceMotion, NodesOnABodyKeepTheGapOfTheirPlace) {
  const Grid grid(CellShape::tri6, 8, 6);
  const auto gap = [](double z) { return -1e-4 * (1 + z); };
  const Map on_body = [&](double u, double v) {
    const Point at = cylinder(u, v);
    return Point{(1 + gap(at[2])) * at[0], (1 + gap(at[2])) * at[1], at[2]};
  };
  const BodySearch body = [](const Point& x) {
    const double r = std::hypot(x[0], x[1]);
    return std::optional<NearBody>({r - 1, {x[0] / r, x[1] / r, 0}});
  };
  const Places source = grid.places(on_body, 0), x_old = grid.places(on_body, 0.25);
  Places x = x_old;
  const SurfaceMotion motion = grid.motion(source);
  motion.move(x_old, body, x);
  EXPECT_GT(distance_from(x, x_old), 0.02);
  for (std::size_t node = 0; node < x.size(); ++node)
    EXPECT_NEAR(body(x[node])->gap, gap(x[node][2]), 2e-7) << node;  // gaps reach 3e-4, faces are 1e-3 off the cylinder
}

}  // namespace
}  // namespace mudline
