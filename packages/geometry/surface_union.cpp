#include "geometry/surface_union.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tensor/vec.hpp"

namespace mudline {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int cuts = 18;

/// The distance to the box, a lower bound of the gap; 0 inside.
double distance_to(const Bounds& box, const Point& x) {
  Point beyond{};
  for (int i = 0; i < 3; ++i) beyond[i] = std::max({0.0, box.low[i] - x[i], x[i] - box.high[i]});
  return length(beyond);
}

}  // namespace

SurfaceFoot PlacedSurface::closest(const Point& x) const {
  SurfaceFoot own = surface->closest(to_frame(x)), result{};
  result.gap = own.gap;
  result.normal = rotation(own.normal);
  result.foot = from_frame(own.foot);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          result.turning[i][j] += rotation.matrix[i][k] * own.turning[k][l] * rotation.matrix[j][l];
  return result;
}

Bounds PlacedSurface::bounds() const {
  const Bounds& own = surface->bounds();
  Bounds result{position, position};
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const double r = rotation.matrix[i][k];
      if (std::abs(r) < 1e-12) continue;  // of right angles; an infinite length would become one across
      result.low[i] += std::min(r * own.low[k], r * own.high[k]);
      result.high[i] += std::max(r * own.low[k], r * own.high[k]);
    }
  return result;
}

SurfaceUnion::SurfaceUnion(std::vector<PlacedSurface> parts) : parts_(std::move(parts)) {
  if (parts_.empty()) throw std::logic_error("a union needs a part");
  bounds_ = Bounds::nothing();
  for (const PlacedSurface& part : parts_) {
    const Bounds box = part.bounds();
    bounds_.enclose(box.low);
    bounds_.enclose(box.high);
  }
}

SurfaceFoot SurfaceUnion::closest(const Point& x) const {
  SurfaceFoot result{};
  result.gap = infinity;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const double bound = distance_to(parts_[i].surface->bounds(), parts_[i].to_frame(x));
    if (bound > 0 && bound >= result.gap) continue;
    const SurfaceFoot foot = parts_[i].closest(x);
    if (foot.gap >= result.gap) continue;
    result = foot;
    result.part = static_cast<int>(i);
  }
  return result;
}

SurfaceTriangles SurfaceUnion::triangles(double chord_error) const {
  SurfaceTriangles result;
  for (const PlacedSurface& part : parts_) {
    SurfaceTriangles own = part.surface->triangles(chord_error);
    for (Point& x : own.points) x = part.from_frame(x);
    result.add(own);
  }
  return result;
}

void SurfaceUnion::add_common(int part, const Block& block, SolidMoments& sum) const {
  Point centre{}, lengths{};
  for (int i = 0; i < 3; ++i) {
    centre[i] = 0.5 * (block.low[i] + block.high[i]);
    lengths[i] = block.high[i] - block.low[i];
  }
  const double reach = 0.5 * length(lengths);
  // the larger gap is that of what two solids have in common, the smaller one that of both together
  SurfaceFoot foot = parts_[part].surface->closest(centre);
  if (foot.gap >= reach) return;
  const Point outside = parts_[part].from_frame(centre);
  SurfaceFoot before{};
  before.gap = infinity;
  for (int i = 0; i < part; ++i) {
    const SurfaceFoot other = parts_[i].closest(outside);
    if (other.gap < before.gap) before = other;
  }
  if (before.gap > foot.gap) {
    foot = before;
    foot.normal = parts_[part].rotation.back(before.normal);
  }
  if (foot.gap >= reach) return;
  if (foot.gap <= -reach || block.cuts == 0) {
    double across = 0;
    for (int i = 0; i < 3; ++i) across += std::abs(foot.normal[i]) * lengths[i];
    sum.add_block(centre, lengths, std::min(1.0, std::max(0.0, 0.5 - foot.gap / across)));
    return;
  }
  const auto longest = std::max_element(lengths.begin(), lengths.end()) - lengths.begin();
  Block low{block.low, block.high, block.cuts - 1}, high = low;
  low.high[longest] = high.low[longest] = centre[longest];
  add_common(part, low, sum);
  add_common(part, high, sum);
}

SolidMoments SurfaceUnion::moments() const {
  SolidMoments result;
  if (!std::isfinite(bounds_.extent())) return result;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    SolidMoments own = parts_[i].surface->moments(), common;
    const Bounds& box = parts_[i].surface->bounds();
    if (i > 0) add_common(static_cast<int>(i), {box.low, box.high, cuts}, common);
    own.add(common, -1);
    result.add(own.placed(parts_[i].rotation.matrix, parts_[i].position), 1);
  }
  return result;
}

}  // namespace mudline
