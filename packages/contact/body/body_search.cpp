#include "contact/body/body_search.hpp"

#include <algorithm>

namespace mudline {

namespace {

BodyPlace place_of_foot(const ContourFoot& foot) {
  BodyPlace place;
  place.gap = foot.gap;
  place.normal = {foot.normal[0], foot.normal[1], 0};
  place.foot = {foot.foot[0], foot.foot[1], 0};
  place.turning[0][0] = foot.turning;
  place.travel = foot.travel;
  return place;
}

BodyPlace place_of_foot(const SurfaceFoot& foot) {
  BodyPlace place;
  place.gap = foot.gap;
  place.normal = foot.normal;
  place.foot = foot.foot;
  std::copy_n(&foot.turning[0][0], 9, &place.turning[0][0]);
  return place;
}

}  // namespace

BodyInStep body_in_step(const RigidBody& body, const BodyPlacement& old, const BodyPlacement& now) {
  BodyInStep step{body.unknowns(), old, now};
  if (body.surface())
    for (int k = 0; k < 3; ++k) step.turning[k] = now.turning(k);
  return step;
}

void search(const RigidBody& body, const BodyInStep& step, const ContactTables& rule, const SideContact& side,
            int point, ContactStart& start) {
  const Point at = rule.place(point, side.x);
  start.height = body.height(step.now, at);
  if (body.surface()) {
    start.now = place_of_foot(body.foot(step.now, at));
    if (looks_back(side, start.shift, start.now.gap - start.offset))
      start.before = place_of_foot(body.foot(step.old, rule.place(point, side.x_old)));
    return;
  }
  const ContourFoot now = body.closest(step.now, in_plane(at));
  start.now = place_of_foot(now);
  if (!looks_back(side, start.shift, now.gap - start.offset)) return;
  const ContourFoot before = body.closest(step.old, in_plane(rule.place(point, side.x_old)));
  start.before = place_of_foot(before);
  start.travelled = body.contour().distance(before, now);
}

}  // namespace mudline
