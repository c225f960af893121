#pragma once

#include <memory>
#include <vector>

#include "algebra/dof_map.hpp"
#include "algebra/field_residual.hpp"
#include "algebra/linear_solver.hpp"

namespace mudline {

struct KrylovResult {
  bool converged = false;
  int iterations = 0;
  double relative_residual = 0;  // true residual, worst over the fields
  double decades = 0;            // orders of magnitude that the residual had to fall
};

/// Restarted GMRES, preconditioned from the right, that converges in every field: the rows of each field are divided by
/// the residual that is allowed in that field, so that the norm that GMRES minimises weighs the fields alike.
class FieldGmres {
 public:
  explicit FieldGmres(RCP<const DofMap> dofs);
  /// Solves A x = b from x = 0 until the true residual of each field meets `tolerance`.
  /// `preconditioner` approximates the inverse of A.
  KrylovResult solve(const RCP<const CrsMatrix>& matrix, const RCP<const Operator>& preconditioner, const Vector& b,
                     Vector& x, const LinearTolerance& tolerance, int max_iterations);

 private:
  RCP<Vector> row_scale(const FieldResidual& residual) const;
  RCP<const DofMap> dofs_;
  FieldResidualEvaluator evaluate_;
};

}  // namespace mudline
