#include "ale/side_locator.hpp"

#include <utility>

namespace mudline {

SideLocator::SideLocator(std::vector<CurvedSide> sides, const Positions& x) : sides_(std::move(sides)), x_(x) {
  std::vector<Bounds> boxes;
  for (const CurvedSide& side : sides_) {
    Bounds box = Bounds::nothing();
    for (int a = 0; a < num_nodes(side.shape); ++a) box.enclose(x[side.nodes[a]]);
    const double margin = 0.25 * length(box.high - box.low);  // a curved side bulges out of the box of its nodes
    for (int d = 0; d < place_size; ++d) {
      box.low[d] -= margin;
      box.high[d] += margin;
    }
    boxes.push_back(box);
  }
  boxes_ = BoxTree(std::move(boxes));
}

void SideLocator::approach(const Point& point, Place& best) const {
  Place here{-1, {}, best.distance};
  double square = here.distance * here.distance;
  boxes_.search(point, square, [&](int number) {
    const ClosestOnSide there = closest_on_side(sides_[number], x_, point, here.distance);
    const bool first_of_equals = there.distance == here.distance && number < here.side;
    if (!(there.distance < here.distance || first_of_equals)) return;
    here = {number, there.place, there.distance};
    square = here.distance * here.distance;
  });
  if (here.side >= 0) best = here;
}

void SideLocator::approach(int number, const Point& point, Place& best) const {
  const ClosestOnSide there = closest_on_side(sides_[number], x_, point);
  if (there.distance < best.distance) best = {number, there.place, there.distance};
}

}  // namespace mudline
