#include "ale/point_locator.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "discretisation/element_map.hpp"

namespace mudline {

namespace {

constexpr double edge_tolerance = 1e-10;

/// A side of the boundary as seen from a point.
class BoundarySide {
 public:
  BoundarySide(const WholeMesh::Element& element, int side, const Positions& x, const Point& point) {
    const std::vector<int> nodes = side_nodes(element.shape, side);
    count_ = static_cast<int>(nodes.size());
    for (int a = 0; a < count_; ++a)
      for (int i = 0; i < 2; ++i) off_[a][i] = x[element.nodes[nodes[a]]][i] - point[i];
  }
  double chord() const { return std::hypot(off_[1][0] - off_[0][0], off_[1][1] - off_[0][1]); }
  double distance(double t) const {
    const auto off = at(t, false);
    return std::hypot(off[0], off[1]);
  }
  /// Where the distance is least, if it falls and then rises between the two.
  double stationary(double low, double high) const {
    const auto rises = [&](double t) {
      const auto off = at(t, false), way = at(t, true);
      return off[0] * way[0] + off[1] * way[1] >= 0;
    };
    if (rises(low)) return low;
    if (!rises(high)) return high;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (rises(middle) ? high : low) = middle;
    }
    return high;
  }

 private:
  std::array<double, 2> at(double t, bool slope) const {
    double N[3], dN[3];
    evaluate_line(count_, t, N, dN);
    std::array<double, 2> result{};
    for (int a = 0; a < count_; ++a)
      for (int i = 0; i < 2; ++i) result[i] += (slope ? dN : N)[a] * off_[a][i];
    return result;
  }
  double off_[3][2];
  int count_;
};

}  // namespace

bool PointLocator::invert(int e, const Point& point, double xi[3]) const {
  const auto& element = mesh_.elements()[e];
  return ElementMap(element.shape, [&](int a) { return x_[element.nodes[a]].data(); }).invert(point.data(), xi);
}

MeshPlace PointLocator::find(const Point& point, int guess) const {
  const auto& elements = mesh_.elements();
  std::set<int> seen;
  MeshPlace best;
  double least = 1e300;
  int here = guess;
  for (int step = 0; step < 200 && here >= 0; ++step) {
    seen.insert(here);
    double xi[3] = {0, 0, 0};
    const bool inverted = invert(here, point, xi);
    const CellShape shape = elements[here].shape;
    const double off = inverted ? outside_cell(shape, xi) : 1e200;
    if (off < least) {
      least = off;
      best = {here, {xi[0], xi[1], xi[2]}};
    }
    if (off <= edge_tolerance) return best;
    // on through the side that the point is farthest beyond; where that is closed, through the next best
    int next = -1;
    double farthest = edge_tolerance;
    for (int s = 0; s < num_sides(shape); ++s) {
      const int other = elements[here].neighbours[s];
      if (other < 0 || elements[other].block != elements[guess].block || seen.count(other)) continue;
      const double distance = inverted ? beyond_side(shape, s, xi) : 1.0;
      if (distance <= farthest) continue;
      farthest = distance;
      next = other;
    }
    here = next;
  }
  if (least < 0.1) return best;  // just beyond a curved boundary
  // the walk was caught in a corner: look everywhere
  for (int e : mesh_.block_elements(elements[guess].block)) {
    double xi[3] = {0, 0, 0};
    if (!invert(e, point, xi)) continue;
    const double off = outside_cell(elements[e].shape, xi);
    if (off >= least) continue;
    least = off;
    best = {e, {xi[0], xi[1], xi[2]}};
    if (off <= edge_tolerance) break;
  }
  return best;
}

MeshPlace PointLocator::nearest_on_boundary(const Point& point) const {
  constexpr int samples = 8;  // of a side: a parabola has no more than three places where its distance is stationary
  MeshPlace best;
  double least = 1e300;
  for (int e = 0; e < static_cast<int>(mesh_.elements().size()); ++e) {
    const auto& element = mesh_.elements()[e];
    for (int s = 0; s < num_sides(element.shape); ++s) {
      if (element.neighbours[s] >= 0) continue;
      const BoundarySide side(element, s, x_, point);
      double nearest = -1, near = 1e300;
      for (int k = 0; k <= samples; ++k) {
        const double t = -1 + 2.0 * k / samples, here = side.distance(t);
        if (here >= near) continue;
        near = here;
        nearest = t;
      }
      // distances change by no more than the way along the side, which even a strongly curved one has less than twice
      // as long as its chord
      if (near - 2 * side.chord() / samples > least) continue;
      nearest = side.stationary(std::max(nearest - 2.0 / samples, -1.0), std::min(nearest + 2.0 / samples, 1.0));
      near = side.distance(nearest);
      if (near >= least) continue;
      least = near;
      best.element = e;
      const auto place = on_side(element.shape, s, nearest);
      std::copy_n(place.begin(), 2, best.xi);
    }
  }
  return best;
}

}  // namespace mudline
