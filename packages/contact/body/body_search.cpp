#include "contact/body/body_search.hpp"

#include <algorithm>

namespace mudline {

namespace {

BodyPlace place_of_projection(const ContourProjection& projection) {
  BodyPlace place;
  place.gap = projection.gap;
  place.normal = {projection.normal[0], projection.normal[1], 0};
  place.point = {projection.point[0], projection.point[1], 0};
  place.turning[0][0] = projection.turning;
  place.travel = projection.travel;
  return place;
}

BodyPlace place_of_projection(const SurfaceProjection& projection) {
  BodyPlace place;
  place.gap = projection.gap;
  place.normal = projection.normal;
  place.point = projection.point;
  std::copy_n(&projection.turning[0][0], 9, &place.turning[0][0]);
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
    start.now = place_of_projection(body.projection(step.now, at));
    if (looks_back(side, start.shift, start.now.gap - start.offset))
      start.before = place_of_projection(body.projection(step.old, rule.place(point, side.x_old)));
    return;
  }
  const ContourProjection now = body.closest(step.now, in_plane(at));
  start.now = place_of_projection(now);
  if (!looks_back(side, start.shift, now.gap - start.offset)) return;
  const ContourProjection before = body.closest(step.old, in_plane(rule.place(point, side.x_old)));
  start.before = place_of_projection(before);
  start.contour_distance = body.contour().distance(before, now);
}

}  // namespace mudline
