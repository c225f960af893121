#include "algebra/amg.hpp"

#include <MueLu_CreateTpetraPreconditioner.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <TpetraExt_MatrixMatrix.hpp>

#include <algorithm>
#include <cstdlib>

#include "algebra/field_blocks.hpp"
#include "algebra/tpetra_compat.hpp"

namespace mudline {

namespace {

// Eigenvalue estimates start from random vectors. A fixed seed makes every set-up, and so a restarted run, repeatable.
void fix_random_start() { std::srand(1); }

/// True if no unknown depends on another one: all of them are prescribed.
bool is_diagonal(const CrsMatrix& matrix) {
  const std::vector<char> alone = isolated_rows(matrix, 0, static_cast<LocalOrdinal>(local_rows(matrix)));
  const int here = std::find(alone.begin(), alone.end(), 0) == alone.end();
  int everywhere = 0;
  Teuchos::reduceAll(*matrix.getComm(), Teuchos::REDUCE_MIN, here, Teuchos::outArg(everywhere));
  return everywhere != 0;
}

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
  const auto relax_coarsest = [&](int sweeps) {
    list.set("coarse: type", "RELAXATION");
    Teuchos::ParameterList& coarse = list.sublist("coarse: params");
    coarse.set("relaxation: type", "Symmetric Gauss-Seidel");
    coarse.set("relaxation: sweeps", sweeps);
  };
  if (is_diagonal(*input.matrix)) {  // nothing to aggregate; one sweep is the inverse
    list.set("max levels", 1);
    relax_coarsest(1);
  } else if (parallel_klu2_is_wrong && input.matrix->getComm()->getSize() > 1) {
    relax_coarsest(40);
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
