#pragma once

// Linear solver checks shared by the one-rank and the two-rank test programs.

#include "algebra/block_amg_solver.hpp"
#include "algebra/mumps_solver.hpp"
#include "algebra/tests/distributed_cases.hpp"
#include "algebra/tests/model_in_space.hpp"
#include "core/section.hpp"

namespace mudline::cases {

inline BlockData no_data() { return {}; }

/// Has the solver read its parameters from a list, as from a deck.
template <class Solver>
void configure(Solver& solver, Teuchos::ParameterList& list) {
  Parameters p(Section(list, std::make_shared<Sources>(), std::make_shared<FunctionLibrary>(), ""));
  solver.parameters(p);
  p.finish();
}

/// Configures "direct" to factor by one process or by all.
inline void configure_direct(MumpsSolver& solver, bool reproducible) {
  Teuchos::ParameterList list;
  list.set("reproducible", reproducible);
  configure(solver, list);
}

/// Checks new factors for a sequence of matrices with one graph.
inline void check_direct(bool reproducible = true) {
  model::Settings settings;
  settings.cells = 12;
  model::Problem problem(settings, Tpetra::getDefaultComm());
  const Vector b = rough_load(problem);
  Vector x(problem.dofs()->owned());
  MumpsSolver solver;
  configure_direct(solver, reproducible);
  ASSERT_EQ(solver.prepare(problem.dofs()), "");
  for (const double dt : {1e-1, 1e-3, 1e2}) {
    problem.settings().dt = dt;
    const RCP<const CrsMatrix> matrix = problem.assemble();
    solver.set_matrix(matrix, no_data);
    const LinearReport report = solver.solve(b, x, 1e-10);
    EXPECT_TRUE(report.converged) << report.reason;
    EXPECT_TRUE(report.factored);
    EXPECT_LT(load_residual(*problem.dofs(), *matrix, b, x), 1e-8);
    EXPECT_FALSE(solver.solve(b, x, 1e-10).factored);
  }
}

/// Old factors precondition slightly different matrices; a very different one is factored again. The solution is always
/// that of the current matrix.
inline void check_reuse() {
  model::Settings settings;
  settings.cells = 12;
  model::Problem problem(settings, Tpetra::getDefaultComm());
  Teuchos::ParameterList list;
  list.set("reuse factorisation", true);
  MumpsSolver solver, reference;
  configure(solver, list);
  ASSERT_EQ(solver.prepare(problem.dofs()), "");
  ASSERT_EQ(reference.prepare(problem.dofs()), "");
  const Vector b = rough_load(problem);
  Vector x(problem.dofs()->owned()), exact(problem.dofs()->owned());
  const auto solve_with = [&](double softening) {
    problem.settings().stiffness = [=](double px, double py) { return px < 4 && py > 6 ? softening : 1.0; };
    const RCP<const CrsMatrix> matrix = problem.assemble();
    solver.set_matrix(matrix, no_data);
    const LinearReport report = solver.solve(b, x, 1e-10);
    EXPECT_TRUE(report.converged) << report.reason;
    reference.set_matrix(matrix, no_data);
    reference.solve(b, exact, 1e-12);
    for (int f = 0; f < 2; ++f) EXPECT_LT(field_difference(*problem.dofs(), x, exact, f), 1e-7);
    return report;
  };
  EXPECT_TRUE(solve_with(1.0).factored);
  const LinearReport near = solve_with(0.95);
  EXPECT_FALSE(near.factored);
  EXPECT_GT(near.iterations, 0);
  EXPECT_LE(near.iterations, 8);
  const LinearReport far = solve_with(1e-3);
  EXPECT_TRUE(far.factored);
  EXPECT_EQ(far.iterations, 8);
  EXPECT_FALSE(solve_with(1e-3).factored);
  solver.reset();
  EXPECT_TRUE(solve_with(1.0).factored);
}

inline void check_singular(bool reproducible = true) {
  // Two free dofs joined by a spring: a rigid-body motion.
  const auto comm = Tpetra::getDefaultComm();
  const bool first = comm->getRank() == 0;
  const auto dofs = rcp(new DofMap(
      comm,
      {{"displacement", 1, first ? std::vector<GlobalOrdinal>{0, 1} : std::vector<GlobalOrdinal>{}, first ? 2 : 0}}));
  Kokkos::View<int**, Kokkos::LayoutRight> elements("elements", first ? 1 : 0, 2);
  if (first) elements(0, 1) = 1;
  Assembler assembler(dofs);
  const int group = assembler.add_group(elements);
  assembler.finalise();
  MumpsSolver solver;
  configure_direct(solver, reproducible);
  ASSERT_EQ(solver.prepare(dofs), "");
  Vector b(dofs->owned()), x(dofs->owned());
  if (first) b.replaceLocalValue(0, 1.0);
  const auto solve_with = [&](double diagonal) {
    assembler.begin(Kokkos::View<char*>("constrained", dofs->num_overlap_dofs()));
    if (first) {
      const MatrixScatter scatter = assembler.scatter(group);
      for (int a = 0; a < 2; ++a)
        for (int c = 0; c < 2; ++c) scatter.add(0, a, c, a == c ? diagonal : -1);
    }
    assembler.end();
    solver.set_matrix(assembler.matrix(), no_data);
    return solver.solve(b, x, 1e-10);
  };
  const LinearReport singular = solve_with(1);
  EXPECT_FALSE(singular.converged);
  EXPECT_NE(singular.reason.find("singular"), std::string::npos) << singular.reason;
  const LinearReport broken = solve_with(std::nan(""));
  EXPECT_FALSE(broken.converged);
  EXPECT_NE(broken.reason.find("not finite"), std::string::npos) << broken.reason;
  EXPECT_TRUE(solve_with(2).converged);  // and it recovers
}

/// One solve of the block solver, compared with the direct solution. Returns the iterations.
template <class Problem>
int check_block_amg_under(const Vector& b, Problem& problem, double tolerance = 1e-8) {
  const RCP<const CrsMatrix> matrix = problem.assemble();
  Vector x(problem.dofs()->owned()), exact(problem.dofs()->owned());
  MumpsSolver direct;
  direct.prepare(problem.dofs());
  direct.set_matrix(matrix, no_data);
  EXPECT_TRUE(direct.solve(b, exact, 1e-12).converged);
  BlockAmgSolver solver;
  EXPECT_EQ(solver.prepare(problem.dofs()), "");
  solver.set_matrix(matrix, [&] { return problem.block_data(); });
  const LinearReport report = solver.solve(b, x, tolerance);
  EXPECT_TRUE(report.converged) << report.reason;
  EXPECT_LE(report.relative_residual, tolerance);
  for (int f = 0; f < problem.dofs()->num_fields(); ++f)
    EXPECT_LT(field_difference(*problem.dofs(), x, exact, f), 1e-6) << "field " << f;
  return report.iterations;
}

/// One solve of the gravity problem, compared with the direct solution. Returns the iterations.
template <class Problem>
int check_block_amg_on(Problem&& problem, double tolerance = 1e-8) {
  return check_block_amg_under(problem.load(), problem, tolerance);
}

inline int check_block_amg(const model::Settings& settings) {
  return check_block_amg_on(model::Problem(settings, Tpetra::getDefaultComm()));
}

inline model::Settings at(double dt, double mobility = 1e-8) {
  model::Settings settings;
  settings.dt = dt;
  settings.mobility = mobility;
  return settings;
}

/// Blocks without a coupling inside: every unknown of a field is prescribed. All rows are loaded, prescribed ones too.
template <class Problem>
void check_prescribed_fields(model::Settings settings) {
  for (const bool held : {false, true}) {
    settings.soil_held = held;
    settings.drained_throughout = !held;
    Problem problem(settings, Tpetra::getDefaultComm());
    Vector b(problem.dofs()->owned());
    const auto values = b.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (int f = 0; f < 2; ++f)
      for (int i = problem.dofs()->owned_begin(f); i < problem.dofs()->owned_end(f); ++i)
        values(i, 0) =
            (f == 0 ? 100 : 1e-3) * std::sin(0.7 * static_cast<double>(problem.dofs()->owned()->getGlobalElement(i)));
    EXPECT_LE(check_block_amg_under(b, problem), held ? 48 : 22) << "held " << held;
  }
}

/// Settings of a small box in space at a time step.
inline model::Settings in_space_at(double dt, double mobility = 1e-8) {
  model::Settings settings = at(dt, mobility);
  settings.cells = 5;
  return settings;
}

inline int check_in_space(const model::Settings& settings) {
  return check_block_amg_on(model::ProblemInSpace(settings, Tpetra::getDefaultComm()));
}

}  // namespace mudline::cases
