#include <Tpetra_Core.hpp>

#include "commands.hpp"
#include "core/errors.hpp"
#include "core/log.hpp"
#include "discretisation/msh_output.hpp"
#include "simulation/result_state.hpp"
#include "simulation/run_start.hpp"

namespace mudline::cli {

int mesh(const MeshCommand& command) {
  const RCP<const Comm> comm = Tpetra::getDefaultComm();
  if (comm->getSize() > 1) throw InputError("mesh writes the whole mesh from one process: start it without mpirun");
  const RunStart end = RunStart::named(command.result);
  if (const std::string why = end.missing(); !why.empty()) throw InputError(why);
  const ResultState result(end.checkpoint(), comm);
  const Mesh& mesh = result.model().mesh();
  write_msh(mesh, result.state().coordinates, command.output);
  log::info(command.output + ": " + std::to_string(mesh.num_global_elements()) + " elements, " +
            std::to_string(mesh.num_global_nodes()) + " nodes");
  return 0;
}

}  // namespace mudline::cli
