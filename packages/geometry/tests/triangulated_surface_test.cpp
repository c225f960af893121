#include "geometry/triangulated_surface.hpp"

#include "core/tests/input_error.hpp"
#include "geometry/rounded_box.hpp"
#include "geometry/tests/surface_fixture.hpp"

namespace mudline {
namespace {

/// Largest differences between a triangulated sphere of radius 1 and the sphere, from well inside to well outside.
struct SphereErrors {
  double gap = 0, normal = 0, turning = 0;  // [m], [-], [1/m]
  explicit SphereErrors(const Surface& surface) {
    RandomPoints random({{-1.5, -1.5, -1.5}, {1.5, 1.5, 1.5}});
    for (int i = 0; i < 3000; ++i) {
      const Point x = random.next();
      const double r = length(x);
      if (r < 0.7 || r > 1.4) continue;
      const SurfaceProjection projection = surface.closest(x);
      gap = std::max(gap, std::abs(projection.gap - (r - 1)));
      normal = std::max(normal, length(projection.normal - 1 / r * x));
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          turning = std::max(turning, std::abs(projection.turning[k][l] - ((k == l) - x[k] * x[l] / r / r) / r));
    }
  }
};

TEST(TriangulatedSurface, ConvergesToTheSphere) {
  const SphereErrors coarse{TriangulatedSurface(icosphere(3))}, fine{TriangulatedSurface(icosphere(5))};
  const auto order = [](double a, double b) { return 0.5 * std::log2(a / b); };
  RecordProperty("gap", std::to_string(fine.gap));
  EXPECT_GT(order(coarse.gap, fine.gap), 3.8) << coarse.gap << " " << fine.gap;
  EXPECT_GT(order(coarse.normal, fine.normal), 2.8) << coarse.normal << " " << fine.normal;
  EXPECT_GT(order(coarse.turning, fine.turning), 1.8) << coarse.turning << " " << fine.turning;
  EXPECT_LT(fine.gap, 5e-8);
  EXPECT_LT(fine.normal, 6e-6);
  EXPECT_LT(fine.turning, 3e-3);
  EXPECT_LT(SphereErrors(TriangulatedSurface(icosphere(1))).gap, 3e-4);  // 80 facets
}

TEST(TriangulatedSurface, ConvergesToTheEllipsoid) {
  const Point axis{1, 0.7, 0.5};
  double gap[2] = {}, normal[2] = {};
  for (int level = 0; level < 2; ++level) {
    SurfaceTriangles triangles = icosphere(3 + level);
    for (Point& x : triangles.points)
      for (int i = 0; i < 3; ++i) x[i] *= axis[i];
    const TriangulatedSurface surface(triangles);
    RandomPoints random({{-1.2, -0.9, -0.7}, {1.2, 0.9, 0.7}});
    for (int i = 0; i < 3000; ++i) {
      const SurfaceProjection projection = surface.closest(random.next());
      if (projection.gap < -0.1 || projection.gap > 0.3) continue;
      double value = -1;
      Point slope{};
      for (int k = 0; k < 3; ++k) {
        value += projection.point[k] * projection.point[k] / axis[k] / axis[k];
        slope[k] = 2 * projection.point[k] / axis[k] / axis[k];
      }
      gap[level] = std::max(gap[level], std::abs(value) / length(slope));
      normal[level] = std::max(normal[level], length(projection.normal - 1 / length(slope) * slope));
    }
  }
  EXPECT_GT(std::log2(gap[0] / gap[1]), 3) << gap[0] << " " << gap[1];
  EXPECT_GT(std::log2(normal[0] / normal[1]), 2) << normal[0] << " " << normal[1];
  EXPECT_LT(gap[1], 5e-6);
  EXPECT_LT(normal[1], 2e-3);
}

TEST(TriangulatedSurface, DerivativesAreThoseOfTheGap) {
  SurfaceTriangles triangles = icosphere(2);
  for (Point& x : triangles.points) x = {1.3 * x[0], x[1], 0.8 * x[2] + 0.1 * x[0] * x[0]};
  const TriangulatedSurface surface(triangles);
  const DerivativeErrors errors(surface, {{-1.6, -1.3, -1.1}, {1.6, 1.3, 1.2}}, 1e-5, 0.02);
  EXPECT_GT(errors.compared, 350);
  EXPECT_LT(errors.normal, 1e-7);
  EXPECT_LT(errors.turning, 1e-4);
  EXPECT_LT(errors.symmetry, 1e-12);
  EXPECT_LT(errors.along, 1e-12);
  EXPECT_LT(errors.projection, 1e-12);
  EXPECT_LT(errors.length, 1e-14);
}

TEST(TriangulatedSurface, GapAndNormalAreContinuousAcrossEdges) {
  SurfaceTriangles triangles = icosphere(1);
  for (Point& x : triangles.points) x[2] *= 0.7;
  const TriangulatedSurface surface(triangles);
  double gap = 0, normal = 0;
  int jumps = 0;
  Point last{};
  SurfaceProjection before{};
  for (int i = 0; i <= 20000; ++i) {
    const double a = i * 3e-4;
    const Point x{1.1 * std::cos(a) * std::cos(0.3 * a), 1.1 * std::sin(a) * std::cos(0.3 * a),
                  0.8 * std::sin(0.3 * a)};
    const SurfaceProjection projection = surface.closest(x);
    if (i > 0) {
      const double step = length(x - last);
      gap = std::max(gap, std::abs(projection.gap - before.gap) / step);
      normal = std::max(normal, length(projection.normal - before.normal) / step);
      jumps += std::abs(projection.turning[0][0] - before.turning[0][0]) > 1e-2;
    }
    last = x;
    before = projection;
  }
  EXPECT_GT(jumps, 5);     // edges were crossed
  EXPECT_LT(gap, 0.3);     // the path does not follow the surface
  EXPECT_LT(normal, 2.5);  // [1/m]; of the ellipsoid up to 2
}

TEST(TriangulatedSurface, NoPointOfItIsNearerThanTheClosestPoint) {
  SurfaceTriangles waisted = icosphere(2);
  for (Point& x : waisted.points) {
    const double width = 0.35 + 0.65 * x[2] * x[2];
    x = {width * x[0], width * x[1], 1.4 * x[2]};
  }
  for (const SurfaceTriangles& triangles : {waisted, RoundedBox({2, 1, 0.3}, 0).triangles(1)}) {
    const TriangulatedSurface surface(triangles);
    const SurfaceTriangles drawn = surface.triangles(1e-3);
    RandomPoints random({{-1.4, -1.2, -1.8}, {1.4, 1.2, 1.8}});
    for (int i = 0; i < 200; ++i) {
      const Point x = random.next();
      const double gap = std::abs(surface.closest(x).gap);
      double nearest = 1e300;
      for (const Point& point : drawn.points) nearest = std::min(nearest, length(point - x));
      EXPECT_LE(gap, nearest + 1e-12);
      EXPECT_GE(gap, nearest - 0.05);
    }
  }
}

TEST(TriangulatedSurface, LongFacetsStayNearTheBody) {
  // as CAD programs write shafts: facets from end to end, beside small ones of the fillets
  const auto body = surface(revolved(text_parameter("type", "torpedo") + text_parameter("tip", "cone") +
                                     number_parameter("diameter", 1) + number_parameter("length", 12) +
                                     number_parameter("tip length", 1.5) + number_parameter("tip radius", 0.2) +
                                     number_parameter("shoulder radius", 0.5) + number_parameter("top radius", 0.3)));
  for (const double chord_error : {1e-2, 1e-3}) {
    const TriangulatedSurface smoothed(body->triangles(chord_error));
    RandomPoints random({{-1, -1, -1}, {1, 1, 13}});
    for (int i = 0; i < 2000; ++i) {
      const Point x = random.next();
      const SurfaceProjection projection = body->closest(x);
      if (projection.gap < -0.1 || projection.gap > 0.5) continue;
      ASSERT_NEAR(smoothed.closest(x).gap, projection.gap, 0.5 * chord_error);
    }
  }
}

TEST(TriangulatedSurface, CostGrowsAsTheLogarithm) {
  // counts of opened boxes instead of times
  std::vector<int> opened;
  for (const int cuts : {2, 5}) {
    const SurfaceTriangles sphere = icosphere(cuts);
    std::vector<Bounds> boxes(sphere.facets.size(), Bounds::nothing());
    for (std::size_t f = 0; f < boxes.size(); ++f)
      for (const int point : sphere.facets[f]) boxes[f].enclose(sphere.points[point]);
    const BoxTree tree(boxes);
    RandomPoints random({{-1, -1, -1}, {1, 1, 1}});
    opened.push_back(0);
    for (int i = 0; i < 1000; ++i) {
      Point x = random.next();
      x = 1.001 / length(x) * x;
      double square = 1e300;
      int nearest = -1;
      tree.search(x, square, [&](int number) {
        ++opened.back();
        Point centre{};
        for (const int point : sphere.facets[number]) centre += 1.0 / 3 * sphere.points[point];
        const Point d = x - centre;
        if (dot(d, d) >= square) return;
        square = dot(d, d);
        nearest = number;
      });
      ASSERT_GE(nearest, 0);
    }
  }
  EXPECT_LT(opened[1], 2 * opened[0]);  // 64 times the facets
}

TEST(TriangulatedSurface, TurnsWhatIsInsideOut) {
  SurfaceTriangles triangles = icosphere(2);
  for (auto& facet : triangles.facets) std::swap(facet[0], facet[1]);
  const TriangulatedSurface surface(triangles);
  EXPECT_NEAR(surface.closest({0, 0, 2}).normal[2], 1, 1e-3);
  EXPECT_NEAR(surface.moments().volume, 4.18879, 2e-3);
}

TEST(TriangulatedSurface, MomentsBoundsAndTriangles) {
  SurfaceTriangles triangles = icosphere(3);
  for (Point& x : triangles.points) x = Point{0.4, -0.3, 2} + x;
  const TriangulatedSurface surface(triangles);
  const SolidMoments moments = surface.moments();
  EXPECT_NEAR(moments.volume, 4.18879, 2e-4);
  EXPECT_NEAR(moments.centroid()[2], 2, 1e-5);
  EXPECT_NEAR(moments.inertia()[0][0], 0.4 * 4.18879, 3e-4);
  EXPECT_NEAR(moments.inertia()[0][1], 0, 1e-5);
  EXPECT_LE(surface.bounds().high[2], 3.01);
  EXPECT_GE(surface.bounds().high[2], 3 - 1e-3);
  const SurfaceTriangles drawn = surface.triangles(1e-3);
  EXPECT_NO_THROW(closed_edges(drawn));
  for (const auto& facet : drawn.facets) {
    Point centre{};
    for (const int point : facet) centre += 1.0 / 3 * drawn.points[point];
    EXPECT_LE(std::abs(surface.closest(centre).gap), 1e-3);
  }
}

TEST(TriangulatedSurface, SharpEdgesStayWithinTheirFacets) {
  const TriangulatedSurface surface(RoundedBox({2, 1, 1}, 0).triangles(1));
  EXPECT_NEAR(surface.largest_angle(), 1.5708, 1e-4);
  // the corners are points of the surface, whatever the smoothing does to the sides
  for (const double sx : {-1.0, 1.0})
    for (const double sy : {-0.5, 0.5}) EXPECT_NEAR(surface.closest({sx, sy, 0.5}).gap, 0, 1e-12);
}

TEST(TriangulatedSurface, FaultsAreNamed) {
  const auto error = [](const SurfaceTriangles& triangles) {
    return input_error([&] { TriangulatedSurface surface(triangles); });
  };
  SurfaceTriangles open = icosphere(1);
  open.facets.erase(open.facets.begin() + 3);
  EXPECT_NE(error(open).find("the surface is not closed: 3 edges have one facet only, the first one at ("),
            std::string::npos)
      << error(open);
  SurfaceTriangles turned = icosphere(1);
  std::swap(turned.facets[3][0], turned.facets[3][1]);
  EXPECT_NE(error(turned).find("the facets beside 3 edges are wound against each other"), std::string::npos);
  SurfaceTriangles twice = icosphere(1);
  twice.facets.push_back(twice.facets[3]);
  EXPECT_NE(error(twice).find("3 edges have more than two facets"), std::string::npos) << error(twice);
  SurfaceTriangles flat = icosphere(0);
  flat.points[flat.facets[2][2]] = 0.5 * (flat.points[flat.facets[2][0]] + flat.points[flat.facets[2][1]]);
  EXPECT_NE(error(flat).find("1 facet has no area, the first one at ("), std::string::npos) << error(flat);
  // a pyramid so flat that its sides are upside down relative to the mean normal at the points of its base
  const SurfaceTriangles wedge{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0.01}},
                               {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  EXPECT_NE(error(wedge).find("the surface is folded at ("), std::string::npos) << error(wedge);
  EXPECT_EQ(error({}), "the surface has no facets");
}

}  // namespace
}  // namespace mudline
