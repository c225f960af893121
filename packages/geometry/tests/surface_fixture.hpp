#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>

#include "core/deck.hpp"
#include "core/tests/deck_text.hpp"
#include "geometry/surface_shape.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// A deck in memory that has a section "surface" with the given entries.
struct SurfaceDeck {
  explicit SurfaceDeck(const std::string& parameters) {
    deck.overlay("<ParameterList name=\"deck\">\n" + section_xml("surface", parameters) + "</ParameterList>\n",
                 "deck.xml");
    register_contours(contours);
    register_surfaces(surfaces);
  }
  std::unique_ptr<SurfaceShape> shape() { return surfaces.create(deck.root().section("surface"), registries); }
  Deck deck;
  Registry<ContourShape> contours{"contour"};
  SurfaceRegistry surfaces{"surface"};
  SurfaceRegistries registries{surfaces, contours};
};

inline std::shared_ptr<const Surface> surface(const std::string& parameters) {
  return SurfaceDeck(parameters).shape()->surface();
}

inline std::string revolved(const std::string& contour) {
  return text_parameter("type", "revolved") + section_xml("contour", contour);
}

/// Random points of a box.
struct RandomPoints {
  explicit RandomPoints(Bounds box) : box(box) {}
  Point next() {
    Point x;
    for (int i = 0; i < 3; ++i) x[i] = box.low[i] + (box.high[i] - box.low[i]) * unit(random);
    return x;
  }
  Bounds box;
  std::mt19937 random{5};
  std::uniform_real_distribution<double> unit{0, 1};
};

/// What a gap and its derivatives miss: the largest differences at random points.
struct DerivativeErrors {
  double normal = 0, turning = 0;  // against differences of the gap [-] and of the normal [1/m]
  double symmetry = 0, along = 0;  // of the turning [1/m]; along: turning . normal
  double foot = 0, length = 0;     // foot + gap normal - x [m]; |normal| - 1
  int compared = 0;

  /// `jump`: a change of the turning [1/m] over a step h above which the point is left out, for the second derivatives
  /// may jump between pieces of a surface.
  DerivativeErrors(const Surface& surface, const Bounds& box, double h, double jump, int points = 500) {
    RandomPoints random(box);
    for (int n = 0; n < points; ++n) {
      const Point x = random.next();
      const SurfaceFoot at = surface.closest(x);
      length = std::max(length, std::abs(mudline::length(at.normal) - 1));
      foot = std::max(foot, mudline::length(at.foot + at.gap * at.normal - x));
      SurfaceFoot side[3][2];
      bool smooth = true;
      for (int j = 0; j < 3; ++j)
        for (int s = 0; s < 2; ++s) {
          Point y = x;
          y[j] += s == 0 ? -h : h;
          side[j][s] = surface.closest(y);
          for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l) smooth = smooth && std::abs(side[j][s].turning[k][l] - at.turning[k][l]) < jump;
        }
      if (!smooth) continue;
      ++compared;
      for (int j = 0; j < 3; ++j) {
        normal = std::max(normal, std::abs((side[j][1].gap - side[j][0].gap) / (2 * h) - at.normal[j]));
        double product = 0;
        for (int k = 0; k < 3; ++k) {
          const double difference = (side[j][1].normal[k] - side[j][0].normal[k]) / (2 * h);
          turning = std::max(turning, std::abs(difference - at.turning[k][j]));
          symmetry = std::max(symmetry, std::abs(at.turning[k][j] - at.turning[j][k]));
          product += at.turning[j][k] * at.normal[k];
        }
        along = std::max(along, std::abs(product));
      }
    }
  }
};

/// A regular icosahedron whose facets are cut into four so many times, all points on the sphere of radius 1.
inline SurfaceTriangles icosphere(int cuts) {
  const double t = 0.5 * (1 + std::sqrt(5.0));
  SurfaceTriangles result{{{-1, t, 0},
                           {1, t, 0},
                           {-1, -t, 0},
                           {1, -t, 0},
                           {0, -1, t},
                           {0, 1, t},
                           {0, -1, -t},
                           {0, 1, -t},
                           {t, 0, -1},
                           {t, 0, 1},
                           {-t, 0, -1},
                           {-t, 0, 1}},
                          {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
  for (Point& x : result.points) x = 1 / length(x) * x;
  for (int cut = 0; cut < cuts; ++cut) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [found, added] = middles.try_emplace(std::minmax(a, b), static_cast<int>(result.points.size()));
      if (added) {
        const Point x = result.points[a] + result.points[b];
        result.points.push_back(1 / length(x) * x);
      }
      return found->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& f : result.facets) {
      const int a = middle(f[0], f[1]), b = middle(f[1], f[2]), c = middle(f[2], f[0]);
      finer.insert(finer.end(), {{f[0], a, c}, {f[1], b, a}, {f[2], c, b}, {a, b, c}});
    }
    result.facets = finer;
  }
  return result;
}

}  // namespace mudline
