#pragma once

#include <optional>
#include <string>

#include "discretisation/mesh.hpp"
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
  /// The mudline and where the tip was at the start.
  void add_start(const std::string& name, const RigidBody& body, Geometry geometry, ResultTable& to) const;
  void add_body(const RunView& run, const std::string& name, const RigidBody& body, ResultTable& to) const;

  std::optional<double> mudline_;  // [m] height; none where the program has gone on from a checkpoint
};

}  // namespace mudline
