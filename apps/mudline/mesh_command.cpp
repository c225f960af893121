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
  const std::size_t at = command.result.rfind('@');
  if (at == std::string::npos || at == 0 || at + 1 == command.result.size())
    throw InputError("expected results and a stage, 'results/pile@set-up', given '" + command.result + "'");
  const ResultState result(stage_checkpoint(command.result.substr(0, at), command.result.substr(at + 1)), comm);
  const Mesh& mesh = result.model().mesh();
  write_msh(mesh, result.state().coordinates, command.output);
  log::info(command.output + ": " + std::to_string(mesh.num_global_elements()) + " elements, " +
            std::to_string(mesh.num_global_nodes()) + " nodes");
  return 0;
}

}  // namespace mudline::cli
