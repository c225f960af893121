#include "ale/point_locator.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "discretisation/element_map.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

constexpr double edge_tolerance = 1e-10;

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
    boxes_[block] = std::make_unique<const BoxTree>(std::move(boxes));
  }
  return *boxes_[block];
}

MeshPlace PointLocator::nearest_on_boundary(const Point& point) const {
  if (!boundary_) {
    std::vector<CurvedSide> sides;
    for (int e = 0; e < static_cast<int>(mesh_.elements().size()); ++e) {
      const auto& element = mesh_.elements()[e];
      for (int s = 0; s < num_sides(element.shape); ++s) {
        if (element.neighbours[s] != GhostedMesh::outside) continue;
        CurvedSide& side = sides.emplace_back(CurvedSide{side_shape(element.shape, s), {}});
        auto node = side.nodes.begin();
        for (int a : side_nodes(element.shape, s)) *node++ = element.nodes[a];
        boundary_sides_.push_back({e, s});
      }
    }
    boundary_ = std::make_unique<const SideLocator>(std::move(sides), x_);
  }
  SideLocator::Place nearest;
  boundary_->approach(point, nearest);
  MeshPlace result;
  if (nearest.side < 0) return result;
  const auto [element, side] = boundary_sides_[nearest.side];
  const auto place = on_side(mesh_.elements()[element].shape, side, nearest.xi);
  result.element = element;
  std::copy(place.begin(), place.end(), result.xi);
  return result;
}

}  // namespace mudline
