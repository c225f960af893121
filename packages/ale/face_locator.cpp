#include "ale/face_locator.hpp"

namespace mudline {

FaceLocator::FaceLocator(const std::vector<SurfaceFace>& faces, const Positions& x) : faces_(faces), x_(x) {
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Bounds box = Bounds::nothing();
    for (int a = 0; a < num_nodes(faces[f].shape); ++a) box.enclose(x[faces[f].nodes[a]]);
    const Point half = 0.5 * (box.high - box.low);
    // A curved face does not bulge far out of the box of its nodes.
    balls_[faces[f].patch].push_back({static_cast<int>(f), box.low + half, 1.5 * length(half)});
  }
}

void FaceLocator::look(const std::vector<Ball>& balls, const Point& point, Nearest& best) const {
  for (const Ball& ball : balls) {
    const double reach = best.distance + ball.radius;
    const Point off = point - ball.centre;
    if (dot(off, off) > reach * reach) continue;
    const ClosestOnSide there = closest_on_side(faces_[ball.face], x_, point, best.distance);
    if (there.distance < best.distance) best = {{ball.face, there.place}, there.distance};
  }
}

SurfacePlace FaceLocator::nearest(int patch, const Point& point, int guess) const {
  Nearest best;
  if (guess >= 0) {
    const ClosestOnSide there = closest_on_side(faces_[guess], x_, point);
    best = {{guess, there.place}, there.distance};
  }
  look(balls_.at(patch), point, best);
  return best.place;
}

SurfacePlace FaceLocator::over(int patch, const Point& point) const {
  SurfacePlace place = nearest(patch, point);
  const Point direction = normal(place);
  Point found = at(place);
  for (int k = 0; k < 20; ++k) {
    const Point off = found - point, before = found;
    place = nearest(patch, point + dot(off, direction) * direction, place.face);
    found = at(place);
    if (length(found - before) <= 1e-14 * (length(off) + length(point))) break;
  }
  return place;
}

SurfacePlace FaceLocator::nearest(const Point& point) const {
  Nearest best;
  for (const auto& [patch, balls] : balls_) look(balls, point, best);
  return best.place;
}

}  // namespace mudline
