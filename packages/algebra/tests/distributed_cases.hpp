#pragma once

// Checks shared by the one-rank and the two-rank test programs.

#include <gtest/gtest.h>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Core.hpp>

#include <cmath>
#include <vector>

#include "algebra/tests/model_problem.hpp"

namespace mudline::cases {

/// ||a - b|| / ||b|| over the rows of one field.
inline double field_difference(const DofMap& dofs, const Vector& a, const Vector& b, int f) {
  double here[2] = {0, 0}, sum[2];
  const auto u = a.getLocalViewHost(Tpetra::Access::ReadOnly), v = b.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (int i = dofs.owned_begin(f); i < dofs.owned_end(f); ++i) {
    here[0] += (u(i, 0) - v(i, 0)) * (u(i, 0) - v(i, 0));
    here[1] += v(i, 0) * v(i, 0);
  }
  Teuchos::reduceAll(*dofs.comm(), Teuchos::REDUCE_SUM, 2, here, sum);
  return std::sqrt(sum[0] / sum[1]);
}

/// Largest ||(b - A x)_f|| / ||b_f|| over the fields with a load.
inline double load_residual(const DofMap& dofs, const CrsMatrix& matrix, const Vector& b, const Vector& x) {
  Vector product(dofs.owned());
  matrix.apply(x, product);
  double worst = 0;
  for (int f = 0; f < dofs.num_fields(); ++f) worst = std::fmax(worst, field_difference(dofs, product, b, f));
  return worst;
}

/// A right-hand side whose every entry is set, the constrained ones to zero; the same on any number of ranks.
inline Vector rough_load(const model::Problem& problem) {
  const DofMap& dofs = *problem.dofs();
  Vector b = problem.load();
  const auto values = b.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (int f = 0; f < dofs.num_fields(); ++f)
    for (int i = 0; i < dofs.field(f).num_owned; ++i)
      for (int c = 0; c < dofs.field(f).components; ++c) {
        const int dof = dofs.dof(f, i) + c;
        const double wave = std::sin(0.7 * static_cast<double>(dofs.field(f).node_ids[i]) + c);
        if (!problem.constrained()(dof)) values(dof, 0) += f == 0 ? 100 * wave : 1e-3 * wave;
      }
  return b;
}

/// Compares the assembled FECrsMatrix with a plain sum over all elements in dense rows.
inline void check_assembly() {
  const auto comm = Tpetra::getDefaultComm();
  model::Settings settings;
  settings.cells = 3;
  model::Problem problem(settings, comm);
  const DofMap& dofs = *problem.dofs();
  for (const double dt : {0.1, 0.01, 0.1}) {  // the values must not depend on what was assembled before
    problem.settings().dt = dt;
    const RCP<const CrsMatrix> matrix = problem.assemble();
    const int n = static_cast<int>(dofs.owned()->getGlobalNumElements());
    std::vector<double> here(static_cast<std::size_t>(n) * n, 0.0), dense(here.size());
    const int size = static_cast<int>(problem.element_dofs().extent(1));
    for (int e = 0; e < problem.num_elements(); ++e) {
      const auto element = problem.element_matrix(e);
      for (int a = 0; a < size; ++a)
        for (int b = 0; b < size; ++b) {
          const int i = problem.element_dofs()(e, a), j = problem.element_dofs()(e, b);
          if (i != j && (problem.constrained()(i) || problem.constrained()(j))) continue;
          here[dofs.overlap()->getGlobalElement(i) * n + dofs.overlap()->getGlobalElement(j)] += element[a][b];
        }
    }
    Teuchos::reduceAll(*comm, Teuchos::REDUCE_SUM, n * n, here.data(), dense.data());
    const auto local = matrix->getLocalMatrixHost();
    double worst = 0;
    for (int row = 0; row < dofs.num_owned_dofs(); ++row) {
      const GlobalOrdinal global_row = dofs.owned()->getGlobalElement(row);
      double scale = 0;
      std::vector<double> rest(dense.begin() + global_row * n, dense.begin() + (global_row + 1) * n);
      for (const double value : rest) scale = std::fmax(scale, std::fabs(value));
      for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k)
        rest[matrix->getColMap()->getGlobalElement(local.graph.entries(k))] -= local.values(k);
      for (const double value : rest) worst = std::fmax(worst, std::fabs(value) / scale);
    }
    EXPECT_LT(worst, 1e-13);
  }
}

}  // namespace mudline::cases
