#include "algebra/block_amg_solver.hpp"
#include "algebra/linear_solver.hpp"
#include "algebra/mumps_solver.hpp"

namespace mudline {

void register_linear_solvers(Registry<LinearSolver>& registry) {
  registry.add<MumpsSolver>(
      "direct",
      "Sparse LU factorisation (MUMPS) of the whole system. Robust for any fields and contact; the "
      "default in two dimensions.");
  registry.add<BlockAmgSolver>("block amg",
                               "GMRES with a block preconditioner: p-multigrid for the displacement, two scalar "
                               "multigrid cycles for the pore pressure. Lower memory on fine meshes; iteration counts "
                               "hardly depend on mesh, time step and permeability.");
}

}  // namespace mudline
