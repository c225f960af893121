#pragma once

#include <map>
#include <string>

#include "checks/doubts.hpp"
#include "simulation/model.hpp"
#include "simulation/observer.hpp"

namespace mudline {

/// Watches how long the sides of the soil's surface become that touch a body, on a mesh that keeps its topology. A wall
/// of few long sides does not resolve pore pressure and friction along the body. Warns once per contact, at the run's
/// end; after a restart it is the rest of the run that counts.
class StretchWatch : public Observer {
 public:
  /// Declares its quantity, which belongs to the section "plausibility".
  static void declare(Doubts& doubts);
  explicit StretchWatch(const Doubts& doubts) : doubts_(doubts) {}
  void step(const RunView& run) override;
  void end_run(const RunView& run, RunEnd end) override;

 private:
  /// The side that was stretched most.
  struct Record {
    double ratio = 0, before = 0, now = 0;  // [-], [m] its lengths in the mesh at the start and when it was longest
    double time = 0;                        // [s]
  };
  /// That among the sides that touch. Collective.
  static Record longest(const Model& model, const Contact& contact);

  const Doubts doubts_;
  std::map<std::string, Record> records_;  // by contact
};

}  // namespace mudline
