#include "ale/point_locator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "discretisation/element_map.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

constexpr double edge_tolerance = 1e-10;

/// A line of two or three nodes as seen from a point.
class SeenLine {
 public:
  SeenLine(int count, const Point* off) : count_(count) { std::copy(off, off + count, off_); }
  /// The closest point's coordinate in [-1, 1], and its distance [m]; only approximate where that is larger than
  /// `least`.
  std::pair<double, double> nearest(double least) const {
    constexpr int samples = 8;  // a parabola has no more than three places where its distance is stationary
    double place = -1, near = 1e300;
    for (int k = 0; k <= samples; ++k) {
      const double t = -1 + 2.0 * k / samples, here = distance(t);
      if (here >= near) continue;
      near = here;
      place = t;
    }
    // Distances change by at most the arc length, which even on a strongly curved line is less than twice the chord.
    if (near - 2 * mudline::distance(off_[1], off_[0]) / samples > least) return {place, near};
    place = stationary(std::max(place - 2.0 / samples, -1.0), std::min(place + 2.0 / samples, 1.0));
    return {place, distance(place)};
  }

 private:
  double distance(double t) const { return mudline::distance(at(t, false), Point{}); }
  /// The coordinate of least distance, if the distance falls and then rises between the two.
  double stationary(double low, double high) const {
    const auto rises = [&](double t) { return dot(at(t, false), at(t, true)) >= 0; };
    if (rises(low)) return low;
    if (!rises(high)) return high;
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (rises(middle) ? high : low) = middle;
    }
    return high;
  }
  Point at(double t, bool slope) const {
    double N[3], dN[3];
    evaluate_line(count_, t, N, dN);
    Point result{};
    for (int a = 0; a < count_; ++a) result += (slope ? dN : N)[a] * off_[a];
    return result;
  }
  int count_;
  Point off_[3];
};

/// A side of an element as seen from a point: the line itself in the plane, a face with its edges in space.
class SeenSide {
 public:
  SeenSide(const GhostedMesh::Element& element, int side, const Positions& x, const Point& point)
      : shape_(side_shape(element.shape, side)) {
    for (int a : side_nodes(element.shape, side)) off_.push_back(x[element.nodes[a]] - point);
  }
  /// Sets `place` (coordinates of the side) to the closest point and `least` to its distance [m], if that is below
  /// `least`; returns whether it is.
  bool nearer(double& least, Vec<double, 2>& place) const {
    if (dimension(shape_) == 1) {
      const auto [t, here] = SeenLine(static_cast<int>(off_.size()), off_.data()).nearest(least);
      return take({t, 0}, here, least, place);
    }
    double size = 0;
    for (const Point& off : off_) size = std::max(size, distance(off, off_[0]));
    if (length(off_[0]) - 2 * size > least) return false;
    const int corners = num_corners(shape_);
    bool found = false;
    for (int e = 0; e < corners; ++e) {
      const auto [a, b] = edge_corners(shape_, e);
      const Point line[3] = {off_[a], off_[b], order(shape_) == 2 ? off_[corners + e] : Point{}};
      const auto [t, here] = SeenLine(order(shape_) + 1, line).nearest(least);
      const auto from = reference_node(shape_, a), to = reference_node(shape_, b);
      const auto along = [&](int k) { return 0.5 * (1 - t) * from[k] + 0.5 * (1 + t) * to[k]; };
      found = take({along(0), along(1)}, here, least, place) || found;
    }
    return inside(least, place) || found;
  }

 private:
  static bool take(const Vec<double, 2>& at, double here, double& least, Vec<double, 2>& place) {
    if (here >= least) return false;
    least = here;
    place = at;
    return true;
  }
  /// Looks inside the face, by the Gauss-Newton method from its middle and from halfway to each corner.
  bool inside(double& least, Vec<double, 2>& place) const {
    bool found = false;
    const auto centre = cell_centre(shape_);
    for (int start = 0; start <= num_corners(shape_); ++start) {
      Vec<double, 2> xi{centre[0], centre[1]};
      if (start > 0)
        for (int k = 0; k < 2; ++k) xi[k] = 0.5 * (xi[k] + reference_node(shape_, start - 1)[k]);
      for (int iteration = 0; iteration < 60; ++iteration) {
        double N[9], dN[18];
        evaluate_shape(shape_, xi.data(), N, dN);
        Point r{}, along[2] = {};
        for (std::size_t a = 0; a < off_.size(); ++a) {
          r += N[a] * off_[a];
          for (int k = 0; k < 2; ++k) along[k] += dN[2 * a + k] * off_[a];
        }
        const double aa = dot(along[0], along[0]), ab = dot(along[0], along[1]), bb = dot(along[1], along[1]),
                     ra = dot(r, along[0]), rb = dot(r, along[1]), det = aa * bb - ab * ab;
        if (outside_cell(shape_, xi.data()) > 0.5 || !(det > 0)) break;
        if (outside_cell(shape_, xi.data()) <= 0) found = take(xi, length(r), least, place) || found;
        const double step[2] = {(ab * rb - bb * ra) / det, (ab * ra - aa * rb) / det};
        if (std::hypot(step[0], step[1]) < 1e-15) break;
        for (int k = 0; k < 2; ++k) xi[k] += step[k];
      }
    }
    return found;
  }

  CellShape shape_;
  std::vector<Point> off_;
};

}  // namespace

bool PointLocator::invert(int e, const Point& point, double xi[3]) const {
  const auto& element = mesh_.elements()[e];
  return ElementMap(element.shape, [&](int a) { return x_[element.nodes[a]].data(); }).invert(point.data(), xi);
}

MeshPlace PointLocator::find(const Point& point, int guess) const {
  const auto& elements = mesh_.elements();
  std::set<int> seen;
  Found found;
  int here = guess;
  for (int step = 0; step < 200; ++step) {
    if (here < 0) break;
    seen.insert(here);
    double xi[3] = {0, 0, 0};
    if (!invert(here, point, xi)) break;  // the point is far from a curved element
    const CellShape shape = elements[here].shape;
    if (found.take(here, shape, xi)) return found.place;
    // The walk goes on through the side that the point is farthest beyond; where that is closed, through the next best.
    int next = -1;
    double farthest = edge_tolerance;
    for (int s = 0; s < num_sides(shape); ++s) {
      const int other = elements[here].neighbours[s];
      if (other < 0 || elements[other].block != elements[guess].block || seen.count(other)) continue;
      const double distance = beyond_side(shape, s, xi);
      if (distance <= farthest) continue;
      farthest = distance;
      next = other;
    }
    here = next;
  }
  if (found.off < 0.1) return found.place;  // just beyond a curved boundary
  // The walk got stuck in a corner.
  const int block = elements[guess].block;
  const std::vector<int>& all = mesh_.block_elements(block);
  const auto look_at = [&](int e) {
    double xi[3] = {0, 0, 0};
    return invert(e, point, xi) && found.take(e, elements[e].shape, xi);
  };
  double square = std::numeric_limits<double>::min();  // squared search radius around the boxes
  boxes(block).search(point, square, [&](int i) {
    if (look_at(all[i])) square = 0;
  });
  if (square == 0) return found.place;
  std::any_of(all.begin(), all.end(), look_at);
  return found.place;
}

bool PointLocator::Found::take(int element, CellShape shape, const double (&xi)[3]) {
  const double here = outside_cell(shape, xi);
  if (here < off) {
    off = here;
    place = {element, {xi[0], xi[1], xi[2]}};
  }
  return off <= edge_tolerance;
}

const BoxTree& PointLocator::boxes(int block) const {
  if (boxes_.empty()) boxes_.resize(mesh_.mesh().blocks().size());
  if (!boxes_[block]) {
    std::vector<Bounds> boxes;
    for (int e : mesh_.block_elements(block)) {
      Bounds box = Bounds::nothing();
      enclose(box, mesh_.elements()[e], x_);
      for (int d = 0; d < place_size; ++d) {  // a margin, because elements may bulge
        const double more = 0.25 * (box.high[d] - box.low[d]);
        box.low[d] -= more;
        box.high[d] += more;
      }
      boxes.push_back(box);
    }
    boxes_[block] = std::make_unique<const BoxTree>(boxes);
  }
  return *boxes_[block];
}

MeshPlace PointLocator::nearest_on_boundary(const Point& point) const {
  MeshPlace best;
  double least = 1e300;
  for (int e = 0; e < static_cast<int>(mesh_.elements().size()); ++e) {
    const auto& element = mesh_.elements()[e];
    for (int s = 0; s < num_sides(element.shape); ++s) {
      if (element.neighbours[s] != GhostedMesh::outside) continue;
      Vec<double, 2> nearest;
      if (!SeenSide(element, s, x_, point).nearer(least, nearest)) continue;
      best.element = e;
      const auto place = on_side(element.shape, s, nearest);
      std::copy(place.begin(), place.end(), best.xi);
    }
  }
  return best;
}

}  // namespace mudline
