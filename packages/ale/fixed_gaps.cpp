#include "ale/fixed_gaps.hpp"

#include <algorithm>

#include "tensor/vec.hpp"

namespace mudline {

Point FixedGaps::kept(const SurfaceFace& face, const FacePlace& place, const Point& at, double span) {
  double N[9], dN[18], gap = 0, least = 1e300, most = -1e300;
  evaluate_shape(face.shape, place.data(), N, dN);
  for (int a = 0; a < num_nodes(face.shape); ++a) {
    auto known = gaps_.find(face.nodes[a]);
    if (known == gaps_.end()) {
      const auto there = body_(x_[face.nodes[a]]);
      if (!there) return at;
      known = gaps_.emplace(face.nodes[a], there->gap).first;
    }
    gap += N[a] * known->second;
    least = std::min(least, known->second);
    most = std::max(most, known->second);
  }
  gap = std::clamp(gap, least, most);
  if (gap >= 0.25 * span) return at;
  const NearBody here = *body_(at);
  return at + (gap - here.gap) * here.normal;
}

}  // namespace mudline
