#include "geometry/revolved_surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/pi.hpp"

namespace mudline {

namespace {

/// n_r / r, the turning of the normal around the axis [1/m].
double turning_around(const ContourProjection& projection, double r, double size) {
  // near the axis of a smooth surface both turnings are the same, and n_r / r is a quotient of rounding errors
  if (r <= 1e-7 * size && r * std::abs(projection.turning) < 1e-3 && std::abs(projection.normal[0]) < 1e-3)
    return projection.turning * projection.tangent[0] * projection.tangent[0];
  // on the axis with the closest point off it, a whole circle of points is nearest
  return r <= 1e-9 * projection.point[0] ? 0.0 : projection.normal[0] / r;
}

}  // namespace

RevolvedSurface::RevolvedSurface(Contour contour) : contour_(std::move(contour)) {
  if (contour_.extent() != ContourExtent::half) throw std::logic_error("only a half contour can be revolved");
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double error = 1e-4 * contour_.length();
  double radius = 0, low = infinity, high = -infinity;
  for (const PlanePoint& x : contour_.sample(error)) {
    radius = std::max(radius, x[0] + error);
    low = std::min(low, x[1] - error);
    high = std::max(high, x[1] + error);
  }
  if (!closed()) {
    const auto& last = *contour_.pieces().back();
    const PlanePoint direction = last.tangent(last.length());
    if (direction[0] > 1e-9) radius = infinity;
    if (direction[1] < -1e-9) low = -infinity;
    if (direction[1] > 1e-9) high = infinity;
  }
  bounds_ = {{-radius, -radius, low}, {radius, radius, high}};
}

bool RevolvedSurface::closed() const {
  const auto& last = *contour_.pieces().back();
  return std::abs(last.point(last.length())[0]) <= 1e-9 * contour_.length();
}

SurfaceProjection RevolvedSurface::closest(const Point& x) const {
  const double r = std::hypot(x[0], x[1]), c = r > 0 ? x[0] / r : 1.0, s = r > 0 ? x[1] / r : 0.0;
  const ContourProjection plane = contour_.closest({r, x[2]});
  SurfaceProjection result{};
  result.gap = plane.gap;
  result.normal = {plane.normal[0] * c, plane.normal[0] * s, plane.normal[1]};
  result.point = {plane.point[0] * c, plane.point[0] * s, plane.point[1]};
  const Point along{plane.tangent[0] * c, plane.tangent[0] * s, plane.tangent[1]}, around{-s, c, 0};
  const double second = turning_around(plane, r, contour_.length());
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      result.turning[i][j] = plane.turning * along[i] * along[j] + second * around[i] * around[j];
  return result;
}

SurfaceTriangles RevolvedSurface::triangles(double chord_error) const {
  std::vector<PlanePoint> line = contour_.sample(0.5 * chord_error);
  if (!closed()) line.push_back({0, line.back()[1]});  // an infinite body is cut off there
  double radius = 0;
  for (const PlanePoint& x : line) radius = std::max(radius, x[0]);
  // a chord over the angle 2 a deviates by radius (1 - cos a)
  const double half = std::acos(std::max(0.5, 1 - 0.5 * chord_error / radius));
  const int sectors = std::max(6, static_cast<int>(std::ceil(pi / half)));
  const double axis = 1e-9 * contour_.length();
  SurfaceTriangles result;
  const auto ring = [&](const PlanePoint& x) {  // one point on the axis, else one for every sector
    std::vector<int> numbers(sectors, static_cast<int>(result.points.size()));
    for (int i = 0; i < (x[0] > axis ? sectors : 1); ++i) {
      const double angle = 2 * pi * i / sectors;
      numbers[i] = static_cast<int>(result.points.size());
      result.points.push_back({x[0] * std::cos(angle), x[0] * std::sin(angle), x[1]});
    }
    return numbers;
  };
  std::vector<int> below = ring(line[0]);
  for (std::size_t k = 1; k < line.size(); ++k) {
    const std::vector<int> above = ring(line[k]);
    for (int i = 0; i < sectors; ++i) {
      const int next = (i + 1) % sectors;
      if (line[k - 1][0] > axis) result.facets.push_back({below[i], below[next], above[next]});
      if (line[k][0] > axis) result.facets.push_back({below[i], above[next], above[i]});
    }
    below = above;
  }
  return result;
}

SolidMoments RevolvedSurface::moments() const {
  SolidMoments result;
  if (!closed()) return result;
  constexpr double at[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
  constexpr double weight[4] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};
  constexpr int runs = 32;
  for (const auto& piece : contour_.pieces())
    for (int i = 0; i < runs; ++i)
      for (int q = 0; q < 4; ++q) {
        const double step = piece->length() / runs, s = step * (i + 0.5 * (1 + at[q]));
        const PlanePoint x = piece->point(s);
        // discs of the height dz
        const double disc = 0.5 * step * weight[q] * piece->tangent(s)[1] * pi * x[0] * x[0];
        result.volume += disc;
        result.first[2] += disc * x[1];
        result.second[0][0] += disc * x[0] * x[0] / 4;
        result.second[2][2] += disc * x[1] * x[1];
      }
  result.second[1][1] = result.second[0][0];
  return result;
}

}  // namespace mudline
