#include "simulation/mesh_watch.hpp"

#include <cstdio>

#include "core/log.hpp"
#include "core/told.hpp"
#include "simulation/stage.hpp"

namespace mudline {

namespace {

std::string describe(const MeshQuality& quality, const Mesh& mesh) {
  return std::to_string(quality.poor) + " of " + std::to_string(mesh.num_global_elements()) +
         " elements have a scaled Jacobian below " + told(MeshQuality::doubtful, "%.3g") + ", the smallest is " +
         told(quality.lowest, "%.3g") + told(quality.place[0], " at (%.4g, ") + told(quality.place[1], "%.4g") +
         (mesh.dimension() == 3 ? told(quality.place[2], ", %.4g)") : ")");
}

}  // namespace

void MeshWatch::look(const RunView& run) {
  quality_ = mesh_quality(run.model.mesh(), run.state.coordinates);
  if (warned_ || quality_.lowest >= MeshQuality::doubtful) return;
  warned_ = true;
  log::warn("the mesh is poor: " + describe(quality_, run.model.mesh()) + " at t " + told(run.state.time, "%.6g s") +
            "; doubt the results there (a 'mesh motion' or another mesh helps)");
}

void MeshWatch::report(const RunView& run, Report& to) {
  look(run);
  to["mesh/quality"] = {"-", quality_.lowest};
  const Ale* ale = run.model.ale();
  if (ale == nullptr || !ale->remeshing()) return;
  to["mesh/elements"] = {"-", static_cast<double>(run.model.mesh().num_global_elements())};
  to["mesh/remeshings"] = {"-", static_cast<double>(ale->remeshings())};
}

std::string MeshWatch::objection(const RunView& run) {
  if (run.stage.allow_folded || quality_.folded == 0) return "";
  return "the mesh is folded: " + describe(quality_, run.model.mesh()) + " at t " + told(run.state.time, "%.6g s") +
         "; the state is saved and the run ends here: use a " + "'mesh motion' or another mesh, or go on with stages/" +
         run.stage.name + "/allow folded elements = true";
}

}  // namespace mudline
