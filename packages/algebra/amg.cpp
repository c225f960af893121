#include "algebra/amg.hpp"

#include <MueLu_CreateTpetraPreconditioner.hpp>
#include <TpetraExt_MatrixMatrix.hpp>

#include <cstdlib>

#include "algebra/tpetra_compat.hpp"

namespace mudline {

namespace {

// Eigenvalue estimates start from random vectors; a fixed seed makes every set-up, and so a restarted run, repeatable.
void fix_random_start() { std::srand(1); }

Teuchos::ParameterList multigrid_list(const AmgInput& input) {
  Teuchos::ParameterList list;
  list.set("verbosity", "none");
  list.set("number of equations", input.equations);
  list.set("multigrid algorithm", "sa");
  list.set("smoother: type", "RELAXATION");
  Teuchos::ParameterList& smoother = list.sublist("smoother: params");
  smoother.set("relaxation: type", "Symmetric Gauss-Seidel");
  smoother.set("relaxation: sweeps", 1);
  // One level more or less is worth six outer iterations at 200 000 unknowns, so the coarse size is the same for all.
  list.set("coarse: max size", 1000);
  if (parallel_klu2_is_wrong && input.matrix->getComm()->getSize() > 1) {
    list.set("coarse: type", "RELAXATION");
    Teuchos::ParameterList& coarse = list.sublist("coarse: params");
    coarse.set("relaxation: type", "Symmetric Gauss-Seidel");
    coarse.set("relaxation: sweeps", 40);
  }
  Teuchos::ParameterList& user = list.sublist("user data");
  if (!input.null_space.is_null()) user.set("Nullspace", input.null_space);
  if (!input.coordinates.is_null()) user.set("Coordinates", input.coordinates);
  return list;
}

}  // namespace

RCP<Operator> amg_cycle(const AmgInput& input) {
  fix_random_start();
  Teuchos::ParameterList list = multigrid_list(input);
  return MueLu::CreateTpetraPreconditioner(RCP<Operator>(input.matrix), list);
}

RCP<CrsMatrix> combination(double alpha, const CrsMatrix& a, double beta, const CrsMatrix& b) {
  return Tpetra::MatrixMatrix::add(alpha, false, a, beta, false, b);
}

}  // namespace mudline
