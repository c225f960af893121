#include "ale/face_locator.hpp"

#include <algorithm>
#include <utility>

namespace mudline {

FaceLocator::FaceLocator(const std::vector<SurfaceFace>& faces, const Positions& x) : faces_(faces), x_(x) {
  std::map<int, std::vector<int>> patches;
  for (std::size_t f = 0; f < faces.size(); ++f) patches[faces[f].patch].push_back(static_cast<int>(f));
  for (auto& [patch, numbers] : patches) {
    std::vector<CurvedSide> sides;
    for (int f : numbers) sides.push_back(faces[f]);
    patches_.emplace(patch, Patch{numbers, SideLocator(std::move(sides), x)});
  }
}

SurfacePlace FaceLocator::nearest(int number, const Point& point, int guess) const {
  const Patch& patch = patches_.at(number);
  SideLocator::Place best;
  if (guess >= 0 && faces_[guess].patch == number) {
    const auto at = std::lower_bound(patch.faces.begin(), patch.faces.end(), guess);
    patch.locator.approach(static_cast<int>(at - patch.faces.begin()), point, best);
  }
  patch.locator.approach(point, best);
  return {patch.faces[best.side], best.xi};
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
  SurfacePlace place;
  SideLocator::Place best;
  for (const auto& [number, patch] : patches_) {
    const double before = best.distance;
    patch.locator.approach(point, best);
    if (best.distance < before) place = {patch.faces[best.side], best.xi};
  }
  return place;
}

}  // namespace mudline
