#include "algebra/block_amg_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "algebra/bordered.hpp"
#include "algebra/tests/solver_cases.hpp"

namespace mudline {
namespace {

using cases::at;

// The limits are measured counts with a margin of a tenth: a rise is a defect of the preconditioner.
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

TEST(BlockAmg, FieldsThatArePrescribedThroughout) {
  cases::check_prescribed_fields<model::Problem>(at(1e-2));
  model::Settings space = cases::in_space_at(1e-2);
  space.layers = 28;  // slender, with more pressures than multigrid's coarsest level takes
  cases::check_prescribed_fields<model::ProblemInSpace>(space);
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

TEST(BlockAmg, InSpaceCountsHoldOverTimeStepAndPermeability) {
  constexpr double corners[][2] = {{1e-4, 1e-12}, {1e-4, 1e-6}, {1e-1, 1e-8}, {1e2, 1e-12}, {1e2, 1e-6}};
  for (const auto& [dt, mobility] : corners) EXPECT_LE(cases::check_in_space(cases::in_space_at(dt, mobility)), 25);
}

TEST(BlockAmg, InSpaceQuasiStaticAndDry) {
  model::Settings settings = cases::in_space_at(10, 1e-12);
  settings.inertia = false;
  EXPECT_LE(cases::check_in_space(settings), 25);
  settings.fluid = false;
  EXPECT_LE(cases::check_in_space(settings), 20);
}

TEST(BlockAmg, StiffContactWithFriction) {
  model::Settings settings = cases::in_space_at(10, 1e-12);
  settings.inertia = false;
  model::ProblemInSpace problem(settings, Tpetra::getDefaultComm());
  problem.contact = 1e3 * settings.young / (settings.size / settings.cells);
  EXPECT_LE(cases::check_block_amg_on(problem), 40);
}

TEST(BlockAmg, StretchedElements) {
  model::Settings settings = cases::in_space_at(10, 1e-12);
  settings.inertia = false;
  EXPECT_LE(cases::check_block_amg_on(model::ProblemInSpace(settings, Tpetra::getDefaultComm(), 0.1)), 50);
}

TEST(BlockAmg, SolvesNoFurtherThanIsEnough) {
  model::Problem problem(at(1e-1), Tpetra::getDefaultComm());
  BlockAmgSolver solver;
  ASSERT_EQ(solver.prepare(problem.dofs()), "");
  EXPECT_TRUE(solver.iterative());
  const RCP<const CrsMatrix> matrix = problem.assemble();
  solver.set_matrix(matrix, [&] { return problem.block_data(); });
  const Vector b = problem.load();
  Vector x(problem.dofs()->owned());
  const int full = solver.solve(b, x, 1e-8).iterations;
  const std::vector<double> enough{1e-2 * b.norm2(), 1e-2};
  const LinearReport report = solver.solve(b, x, {1e-8, enough});
  EXPECT_TRUE(report.converged);
  EXPECT_LT(2 * report.iterations, full);
  FieldResidualEvaluator evaluate(problem.dofs());
  Vector residual(problem.dofs()->owned());
  const FieldResidual left = evaluate(*matrix, b, x, residual);
  for (int f = 0; f < 2; ++f) EXPECT_LE(left.norm[f], enough[f]);
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
  const std::string turns = reason({{"displacement", 2, {0}, 1}, {"rotation", 3, {0}, 1}});
  EXPECT_NE(turns.find("'rotation'"), std::string::npos);
  EXPECT_NE(turns.find("'direct'"), std::string::npos);
  EXPECT_NE(reason({{"displacement", 4, {0}, 1}}).find("three components"), std::string::npos);
  for (const int components : {2, 3}) EXPECT_EQ(reason({{"displacement", components, {0}, 1}}), "");
  EXPECT_EQ(reason({{"displacement", 2, {0}, 1}, {"heat", 1, {0}, 1}, {"body", 3, {0}, 1, true}}), "");
}

/// A dense matrix over a field on the mesh and one apart from it, and the inverse of its inner block.
struct DenseCase {
  static constexpr int inner = 6, all = 9;
  RCP<DofMap> dofs;
  RCP<CrsMatrix> matrix;
  double a[all][all];

  DenseCase() {
    dofs = rcp(new DofMap(Tpetra::getDefaultComm(), {{"displacement", 2, {0, 1, 2}, 3}, {"body", 3, {0}, 1, true}}));
    matrix = rcp(new CrsMatrix(dofs->owned(), all));
    for (int i = 0; i < all; ++i)
      for (int j = 0; j < all; ++j) {
        a[i][j] = (i == j ? 8.0 : 0.0) + std::sin(1.0 + 3 * i + 7 * j);
        const GlobalOrdinal column = j;
        matrix->insertGlobalValues(i, 1, &a[i][j], &column);
      }
    matrix->fillComplete();
  }
};

class InnerInverse : public Operator {
 public:
  explicit InnerInverse(const DenseCase& dense) : dense_(dense) {}
  RCP<const Map> getDomainMap() const override { return dense_.dofs->owned(); }
  RCP<const Map> getRangeMap() const override { return dense_.dofs->owned(); }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double, double) const override {
    constexpr int n = DenseCase::inner;
    const auto from = x.getLocalViewHost(Tpetra::Access::ReadOnly);
    const auto to = y.getLocalViewHost(Tpetra::Access::ReadWrite);
    double m[n][n + 1];
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) m[i][j] = dense_.a[i][j];
      m[i][n] = from(i, 0);
    }
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < n; ++i)
        if (i != k)
          for (int j = n; j >= k; --j) m[i][j] -= m[i][k] / m[k][k] * m[k][j];
    for (int i = 0; i < n; ++i) to(i, 0) = m[i][n] / m[i][i];
  }

 private:
  const DenseCase& dense_;
};

TEST(Bordered, IsTheInverseWhereItsInnerPartIs) {
  const DenseCase dense;
  FieldBlocks blocks(*dense.matrix, dense.dofs);
  const Bordered inverse(*dense.matrix, *dense.dofs, blocks, rcp(new InnerInverse(dense)), {1});
  Vector x(dense.dofs->owned()), b(dense.dofs->owned()), y(dense.dofs->owned());
  x.randomize();
  dense.matrix->apply(x, b);
  inverse.apply(b, y);
  y.update(-1, x, 1);
  EXPECT_LT(y.normInf(), 1e-12);
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
