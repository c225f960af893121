#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulation/model.hpp"

namespace mudline {

/// A body on its way through the stages, as it is known before the run.
struct BodyWay {
  BodyWay(const Model& model, const RigidBody& body, const Section& deck);

  /// A stage's motion of the body.
  struct Motion {
    std::string stage;
    double begin, duration;  // [s]
    std::shared_ptr<const BodyMotion> law;
    Section entry;
  };
  struct Place {
    double time;         // [s]
    Point displacement;  // [m]
    double angle;        // [rad] rotation so far
  };
  /// The largest speed between consecutive places [m/s].
  double largest_speed() const;

  const RigidBody& body;
  std::vector<Motion> motions;
  /// To which prescribed motion brings it before any stage releases it; the start first.
  std::vector<Place> places;
  const ReleasedMotion* release = nullptr;  // the first one; null: no stage releases the body
  double free_time = 0;                     // [s] duration of all stages that release it
};

}  // namespace mudline
