#pragma once

#include "discretisation/mesh_quality.hpp"
#include "simulation/model.hpp"
#include "simulation/observer.hpp"

namespace mudline {

/// Reports the quality of the mesh, warns once where it is poor, and ends a run whose elements fold.
class MeshWatch : public Observer {
 public:
  void begin_run(const RunView& run) override { look(run); }
  void report(const RunView& run, Report& to) override;
  void remeshed(const RunView& run) override { look(run); }
  std::string objection(const RunView& run) override;

 private:
  void look(const RunView& run);

  MeshQuality quality_;  // of the committed state's mesh
  bool warned_ = false;
};

}  // namespace mudline
