#include "ale/point_locator.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace mudline {

namespace {

/// How far a reference point lies beyond a side, in reference units; negative inside.
double beyond(CellShape shape, int side, const double xi[2]) {
  if (num_corners(shape) == 3) return side == 0 ? -xi[1] : (side == 1 ? xi[0] + xi[1] - 1 : -xi[0]);
  switch (side) {
    case 0: return -1 - xi[1];
    case 1: return xi[0] - 1;
    case 2: return xi[1] - 1;
    default: return -1 - xi[0];
  }
}

double outside(CellShape shape, const double xi[2]) {
  double worst = -1e300;
  for (int s = 0; s < num_sides(shape); ++s) worst = std::max(worst, beyond(shape, s, xi));
  return worst;
}

constexpr double edge_tolerance = 1e-10;

/// Point t in [-1, 1] of a side in reference coordinates.
void along_side(CellShape shape, int side, double t, double (&xi)[2]) {
  static constexpr double triangle[4][2] = {{0, 0}, {1, 0}, {0, 1}, {0, 0}}, square[5][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  const auto& from = num_corners(shape) == 3 ? triangle[side] : square[side];
  const auto& to = num_corners(shape) == 3 ? triangle[side + 1] : square[side + 1];
  for (int i = 0; i < 2; ++i) xi[i] = from[i] + 0.5 * (1 + t) * (to[i] - from[i]);
}

/// A side of the boundary as seen from a point.
class BoundarySide {
 public:
  BoundarySide(const WholeMesh::Element& element, int side, const Positions& x, const std::array<double, 2>& point) {
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

bool PointLocator::invert(int e, const std::array<double, 2>& point, double xi[2]) const {
  const auto& element = mesh_.elements()[e];
  const int nodes = num_nodes(element.shape);
  const double middle = num_corners(element.shape) == 3 ? 1.0 / 3 : 0.0;
  xi[0] = xi[1] = middle;
  double N[9], dN[18];
  for (int iteration = 0; iteration < 30; ++iteration) {
    evaluate_shape(element.shape, xi, N, dN);
    double r[2] = {point[0], point[1]}, j[2][2] = {{0, 0}, {0, 0}};
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < 2; ++i) {
        r[i] -= N[a] * x_[element.nodes[a]][i];
        for (int k = 0; k < 2; ++k) j[i][k] += x_[element.nodes[a]][i] * dN[2 * a + k];
      }
    const double det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
    if (!(std::abs(det) > 0)) return false;
    double step[2] = {(j[1][1] * r[0] - j[0][1] * r[1]) / det, (-j[1][0] * r[0] + j[0][0] * r[1]) / det};
    const double size = std::hypot(step[0], step[1]);
    if (!(size < 1e6)) return false;
    const double factor = size > 1 ? 1 / size : 1.0;  // far from the solution the quadratic map misleads
    xi[0] += factor * step[0];
    xi[1] += factor * step[1];
    if (size < 1e-13) return true;
  }
  return outside(element.shape, xi) < 0.5;
}

MeshPlace PointLocator::find(const std::array<double, 2>& point, int guess) const {
  const auto& elements = mesh_.elements();
  std::set<int> seen;
  MeshPlace best;
  double least = 1e300;
  int here = guess;
  for (int step = 0; step < 200 && here >= 0; ++step) {
    seen.insert(here);
    double xi[2];
    const bool inverted = invert(here, point, xi);
    const CellShape shape = elements[here].shape;
    const double off = inverted ? outside(shape, xi) : 1e200;
    if (off < least) {
      least = off;
      best = {here, {xi[0], xi[1]}};
    }
    if (off <= edge_tolerance) return best;
    // on through the side that the point is farthest beyond; where that is closed, through the next best
    int next = -1;
    double farthest = edge_tolerance;
    for (int s = 0; s < num_sides(shape); ++s) {
      const int other = elements[here].neighbours[s];
      if (other < 0 || elements[other].block != elements[guess].block || seen.count(other)) continue;
      const double distance = inverted ? beyond(shape, s, xi) : 1.0;
      if (distance <= farthest) continue;
      farthest = distance;
      next = other;
    }
    here = next;
  }
  if (least < 0.1) return best;  // just beyond a curved boundary
  // the walk was caught in a corner: look everywhere
  for (int e : mesh_.block_elements(elements[guess].block)) {
    double xi[2];
    if (!invert(e, point, xi)) continue;
    const double off = outside(elements[e].shape, xi);
    if (off >= least) continue;
    least = off;
    best = {e, {xi[0], xi[1]}};
    if (off <= edge_tolerance) break;
  }
  return best;
}

MeshPlace PointLocator::nearest_on_boundary(const std::array<double, 2>& point) const {
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
      // distances change by no more than the way along the side, which even a strongly curved one has less than twice as long as its chord
      if (near - 2 * side.chord() / samples > least) continue;
      nearest = side.stationary(std::max(nearest - 2.0 / samples, -1.0), std::min(nearest + 2.0 / samples, 1.0));
      near = side.distance(nearest);
      if (near >= least) continue;
      least = near;
      best.element = e;
      along_side(element.shape, s, nearest, best.xi);
    }
  }
  return best;
}

}  // namespace mudline
