#pragma once

#include "simulation/observer.hpp"

namespace mudline {

/// The depth of bodies below the mudline and the soil's resistance to them, and the reactions of prescribed motions: at
/// the end of each stage, and their peaks. The mudline is the height of the highest node at the start of the run,
/// or after the geostatic stages that it begins with.
///
/// The resistance of a body is the vertical force of all its contacts on it [N], upward positive; "force x" is the
/// horizontal one.
class ResistanceResults : public Observer {
 public:
  void take_start(const RunView& run) override;
  void results(const RunView& run, ResultTable& to) override;

 private:
  void add_body(const RunView& run, const std::string& name, const RigidBody& body, ResultTable& to) const;

  double mudline_ = 0;    // [m]
  bool started_ = false;  // this program has seen the run's start
};

}  // namespace mudline
