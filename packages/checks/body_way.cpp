#include "checks/body_way.hpp"

#include <algorithm>

namespace mudline {

namespace {

constexpr int parts_of_a_stage = 200;

}  // namespace

BodyWay::BodyWay(const Model& model, const RigidBody& body, const Section& deck) : body(body), places{{0, {}, 0}} {
  BodyState now;
  std::shared_ptr<const BodyMotion> before;
  double time = 0, angle = 0;
  for (const auto& stage : model.stages()) {
    const double begin = time, dt = stage->duration / parts_of_a_stage;
    const auto law = model.motion_in(*stage, body.name());
    time += stage->duration;
    if (law != before) now.moving_time = 0;
    before = law;
    if (!law) continue;
    const Section own = deck.section("stages").section(stage->name).section("motions");
    motions.push_back({stage->name, begin, stage->duration, law,
                       own.has_section(body.name()) ? own.section(body.name())
                                                    : deck.section("bodies").section(body.name()).section("motion")});
    if (law->released()) free_time += stage->duration;
    if (!release) release = law->released();
    for (int i = 0; !release && i < parts_of_a_stage; ++i) {
      const BodyState next = law->advance(now, begin + i * dt, begin + (i + 1) * dt);
      angle += length((next.turn * now.turn.inverse()).vector());
      now = next;
      places.push_back({begin + (i + 1) * dt, now.displacement, angle});
    }
  }
}

double BodyWay::largest_speed() const {
  double fastest = 0;
  for (std::size_t i = 1; i < places.size(); ++i)
    if (places[i].time > places[i - 1].time)
      fastest = std::max(
          fastest, length(places[i].displacement - places[i - 1].displacement) / (places[i].time - places[i - 1].time));
  return fastest;
}

}  // namespace mudline
