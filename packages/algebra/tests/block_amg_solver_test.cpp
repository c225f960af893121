#include "algebra/block_amg_solver.hpp"

#include <gtest/gtest.h>

#include "algebra/tests/solver_cases.hpp"

namespace mudline {
namespace {

using cases::at;

// Counts measured when this was written, with a margin of a tenth: a rise is a defect of the preconditioner.
TEST(BlockAmg, CountsOnTheModelProblem) {
  EXPECT_LE(cases::check_block_amg(at(1e-1)), 30);
  EXPECT_LE(cases::check_block_amg(at(1e-3)), 18);
}

TEST(BlockAmg, CountsHoldOverTimeStepAndPermeability) {
  for (const double dt : {1e-4, 1e2})
    for (const double mobility : {1e-12, 1e-6}) EXPECT_LE(cases::check_block_amg(at(dt, mobility)), 33);
}

TEST(BlockAmg, ImpermeableSoil) { EXPECT_LE(cases::check_block_amg(at(1e-2, 0)), 30); }

TEST(BlockAmg, QuasiStatic) {
  model::Settings settings = at(10);
  settings.inertia = false;
  EXPECT_LE(cases::check_block_amg(settings), 33);
}

TEST(BlockAmg, NoDrainedBoundary) {
  model::Settings settings = at(1e-2);
  settings.drained_top = false;
  EXPECT_LE(cases::check_block_amg(settings), 33);
}

TEST(BlockAmg, DrySoil) {
  model::Settings settings = at(1e-2);
  settings.fluid = false;
  EXPECT_LE(cases::check_block_amg(settings), 20);
}

TEST(BlockAmg, LayersOfVeryDifferentPermeability) {
  model::Settings settings = at(1.0, 1e-8);
  settings.permeability = [](double, double y) { return y > 5 ? 1e-3 : 1e2; };
  EXPECT_LE(cases::check_block_amg(settings), 45);
}

TEST(BlockAmg, SoftZoneAndUnsymmetricTangent) {
  model::Settings settings = at(1e-2);
  settings.stiffness = [](double x, double y) { return x < 3 && y > 6 ? 0.05 : 1.0; };
  settings.skew = 0.2;
  EXPECT_LE(cases::check_block_amg(settings), 60);
}

TEST(BlockAmg, KeepsThePreconditionerUntilItNoLongerFits) {
  model::Settings settings = at(1e-2);
  settings.cells = 16;
  model::Problem problem(settings, Tpetra::getDefaultComm());
  BlockAmgSolver solver;
  ASSERT_EQ(solver.prepare(problem.dofs()), "");
  int evaluations = 0;
  const Vector b = problem.load();
  Vector x(problem.dofs()->owned());
  const auto solve_at = [&](double dt) {
    problem.settings().dt = dt;
    solver.set_matrix(problem.assemble(), [&] {
      ++evaluations;
      return problem.block_data();
    });
    const LinearReport report = solver.solve(b, x, 1e-8);
    EXPECT_TRUE(report.converged) << report.reason;
    return report;
  };
  EXPECT_TRUE(solve_at(1e-2).factored);
  EXPECT_FALSE(solve_at(1.05e-2).factored);
  EXPECT_EQ(evaluations, 1);
  solve_at(1e-4);
  EXPECT_TRUE(solve_at(1e-4).iterations <= 25);
  EXPECT_EQ(evaluations, 2);
  solver.reset();
  EXPECT_TRUE(solve_at(1e-4).factored);
}

TEST(BlockAmg, SaysWhichFieldsItCannotTreat) {
  const auto comm = Tpetra::getDefaultComm();
  BlockAmgSolver solver;
  const auto reason = [&](std::vector<FieldLayout> fields) { return solver.prepare(rcp(new DofMap(comm, fields))); };
  EXPECT_NE(reason({{"pore pressure", 1, {0}, 1}}).find("'displacement'"), std::string::npos);
  const std::string body = reason({{"displacement", 2, {0}, 1}, {"rigid body", 3, {0}, 1}});
  EXPECT_NE(body.find("'rigid body'"), std::string::npos);
  EXPECT_NE(body.find("'direct'"), std::string::npos);
  EXPECT_NE(reason({{"displacement", 3, {0}, 1}}).find("two displacement components"), std::string::npos);
  EXPECT_EQ(reason({{"displacement", 2, {0}, 1}}), "");
}

TEST(BlockAmg, ReportsNoConvergence) {
  Teuchos::ParameterList list;
  list.set("maximum iterations", 3);
  BlockAmgSolver solver;
  cases::configure(solver, list);
  model::Settings settings = at(1e-1);
  settings.cells = 8;
  model::Problem problem(settings, Tpetra::getDefaultComm());
  solver.prepare(problem.dofs());
  solver.set_matrix(problem.assemble(), [&] { return problem.block_data(); });
  Vector x(problem.dofs()->owned());
  const LinearReport report = solver.solve(problem.load(), x, 1e-8);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.reason.find("3 iterations"), std::string::npos) << report.reason;
}

TEST(LinearSolvers, AreRegistered) {
  Registry<LinearSolver> registry("linear solver");
  register_linear_solvers(registry);
  EXPECT_EQ(registry.names(), (std::vector<std::string>{"direct", "block amg"}));
  for (const EntryDoc& entry : registry.document()) EXPECT_GE(entry.parameters.size(), 2u) << entry.name;
}

}  // namespace
}  // namespace mudline
