// Iterations, set-up and solve time of the "block amg" solver on the model problem over mesh, permeability and time
// step, with the direct solver for comparison; prints markdown. `block_amg_table small` leaves out the finest mesh.
// `block_amg_table reuse` instead solves a sequence of matrices with a growing soft zone, as in a Newton iteration
// under a footing, with fresh and with reused factors and preconditioners.

#include <Tpetra_Core.hpp>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>

#include "algebra/block_amg_solver.hpp"
#include "algebra/mumps_solver.hpp"
#include "algebra/tests/model_problem.hpp"
#include "core/section.hpp"

namespace {

using namespace mudline;

constexpr double tolerance = 1e-8;

/// Processor time of this rank, which other work on the machine disturbs less than the wall clock.
template <class Work>
double seconds(Work work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

struct Timed {
  LinearReport report;
  double total = 0, solve_only = 0;
};

/// Solves twice: the second solve reuses the preconditioner or the factors.
template <class Solver>
Timed measure(const model::Problem& problem, const RCP<const CrsMatrix>& matrix) {
  Solver solver;
  Timed result;
  const Vector b = problem.load();
  Vector x(problem.dofs()->owned());
  if (!solver.prepare(problem.dofs()).empty()) return result;
  solver.set_matrix(matrix, [&] { return problem.block_data(); });
  result.total = seconds([&] { result.report = solver.solve(b, x, tolerance); });
  result.solve_only = seconds([&] { solver.solve(b, x, tolerance); });
  return result;
}

void reuse_factors(MumpsSolver& solver, bool keep) {
  Teuchos::ParameterList list;
  list.set("reuse factorisation", keep);
  Parameters p(Section(list, std::make_shared<Sources>(), std::make_shared<FunctionLibrary>(), ""));
  solver.parameters(p);
}

struct Sequence {
  double time = 0;
  int iterations = 0, factored = 0;
};

/// Ten matrices; the tangent is a tenth of the elastic one in a zone that starts `first_depth` deep and grows by
/// `growth` per matrix.
Sequence solve_sequence(LinearSolver& solver, model::Problem& problem, double first_depth, double growth) {
  Sequence result;
  const Vector b = problem.load();
  Vector x(problem.dofs()->owned());
  solver.prepare(problem.dofs());
  for (int step = 0; step < 10; ++step) {
    const double depth = first_depth + growth * step;
    problem.settings().stiffness = [=](double px, double py) {
      return std::abs(px - 5) < 0.5 + 0.5 * depth && py > 10 - depth ? 0.1 : 1.0;
    };
    const RCP<const CrsMatrix> matrix = problem.assemble();
    solver.set_matrix(matrix, [&] { return problem.block_data(); });
    LinearReport report;
    result.time += seconds([&] { report = solver.solve(b, x, tolerance); });
    result.iterations += report.iterations;
    result.factored += report.factored ? 1 : 0;
    if (!report.converged) std::printf("%s\n", report.reason.c_str());
  }
  return result;
}

void print_reuse(const RCP<const Comm>& comm) {
  const bool root = comm->getRank() == 0;
  if (root)
    std::printf(
        "| unknowns | time step [s] | growth [m] | factored each time [s] | kept factors [s] | factorisations | "
        "iterations | block amg [s] | set-ups | iterations |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const int cells : {33, 149})
    for (const double dt : {1e-3, 1e-2, 1e2})
      for (const double growth : {0.02, 0.2}) {
        model::Settings settings;
        settings.cells = cells;
        settings.dt = dt;
        model::Problem problem(settings, comm);
        MumpsSolver fresh, kept;
        reuse_factors(fresh, false);
        reuse_factors(kept, true);
        BlockAmgSolver amg;
        const Sequence a = solve_sequence(fresh, problem, 1, growth), b = solve_sequence(kept, problem, 1, growth),
                       c = solve_sequence(amg, problem, 1, growth);
        if (root)
          std::printf("| %d | %.0e | %.2f | %.3f | %.3f | %d | %d | %.3f | %d | %d |\n",
                      static_cast<int>(problem.dofs()->owned()->getGlobalNumElements()), dt, growth, a.time, b.time,
                      b.factored, b.iterations, c.time, c.factored, c.iterations);
        std::fflush(stdout);
      }
}

void print_row(model::Problem& problem, double dt, double mobility, bool root) {
  problem.settings().dt = dt;
  problem.settings().mobility = mobility;
  const RCP<const CrsMatrix> matrix = problem.assemble();
  const Timed amg = measure<BlockAmgSolver>(problem, matrix);
  const Timed direct = measure<MumpsSolver>(problem, matrix);
  if (!root) return;
  std::printf("| %d | %.0e | %.0e | %d%s | %.0e | %.3f | %.3f | %.3f | %.3f |\n",
              static_cast<int>(matrix->getGlobalNumRows()), dt, mobility, amg.report.iterations,
              amg.report.converged ? "" : " (failed)", amg.report.relative_residual, amg.total - amg.solve_only,
              amg.solve_only, direct.total - direct.solve_only, direct.solve_only);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Tpetra::ScopeGuard scope(&argc, &argv);
  const auto comm = Tpetra::getDefaultComm();
  const bool root = comm->getRank() == 0;
  const bool small = argc > 1 && std::strcmp(argv[1], "small") == 0;
  if (argc > 1 && std::strcmp(argv[1], "reuse") == 0) {
    print_reuse(comm);
    return 0;
  }
  std::vector<int> meshes{33, 74, 149};
  if (small) meshes.pop_back();
  if (root)
    std::printf(
        "| unknowns | time step [s] | mobility [m2/(Pa s)] | iterations | residual | set-up [s] | solve [s] | direct "
        "set-up [s] | direct solve [s] |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const int cells : meshes) {
    model::Settings settings;
    settings.cells = cells;
    model::Problem problem(settings, comm);
    for (const double dt : {1e-4, 1e-1, 1e2})
      for (const double mobility : {1e-12, 1e-10, 1e-8, 1e-6}) print_row(problem, dt, mobility, root);
  }
  return 0;
}
