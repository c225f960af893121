#include "algebra/mumps_solver.hpp"

#include <gtest/gtest.h>

#include "algebra/tests/solver_cases.hpp"

namespace mudline {
namespace {

TEST(MumpsSolver, SolvesASequenceOnOneGraph) { cases::check_direct(); }
TEST(MumpsSolver, ReusesFactorsWithinTheTolerance) { cases::check_reuse(); }
TEST(MumpsSolver, NamesASingularMatrix) { cases::check_singular(); }

TEST(MumpsSolver, TakesANewGraph) {
  MumpsSolver solver;
  for (const int cells : {4, 6}) {
    model::Settings settings;
    settings.cells = cells;
    model::Problem problem(settings, Tpetra::getDefaultComm());
    solver.prepare(problem.dofs());
    for (int repeat = 0; repeat < 2; ++repeat) {
      solver.set_matrix(problem.assemble(), cases::no_data);
      Vector x(problem.dofs()->owned());
      EXPECT_TRUE(solver.solve(problem.load(), x, 1e-10).converged);
    }
  }
}

TEST(MumpsSolver, ZeroLoadGivesZero) {
  model::Settings settings;
  settings.cells = 4;
  model::Problem problem(settings, Tpetra::getDefaultComm());
  MumpsSolver solver;
  solver.prepare(problem.dofs());
  solver.set_matrix(problem.assemble(), cases::no_data);
  Vector b(problem.dofs()->owned()), x(problem.dofs()->owned());
  EXPECT_TRUE(solver.solve(b, x, 1e-10).converged);
  EXPECT_EQ(x.normInf(), 0);
}

}  // namespace
}  // namespace mudline
