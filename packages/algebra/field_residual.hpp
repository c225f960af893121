#pragma once

#include <vector>

#include "algebra/dof_map.hpp"
#include "algebra/linear_solver.hpp"

namespace mudline {

/// The residual of a linear system, field by field.
struct FieldResidual {
  std::vector<double> norm;       // ||(b - A x)_f||
  std::vector<double> reference;  // the largest of ||b_f||, the terms ||A_fg x_g||, and 1e-6 || |A_f| |x| ||
  /// Worst norm/reference over the fields; a field without terms counts as zero. NaN stays NaN.
  double relative() const;
  /// Raises the references so that a residual norm of `tolerance.enough` meets the relative tolerance.
  void loosen(const LinearTolerance& tolerance);
};

/// Evaluates r = b - A x and its norms. Forces and volume fluxes have different units, so one norm over all rows would
/// see only one of them. The reference of a field is the largest of its terms, not ||b_f|| alone: a balance may have no
/// source at all, or (late in a Newton iteration) one far below the round-off of the terms that cancel in it.
class FieldResidualEvaluator {
 public:
  explicit FieldResidualEvaluator(RCP<const DofMap> dofs);
  FieldResidual operator()(const CrsMatrix& matrix, const Vector& b, const Vector& x, Vector& residual);

 private:
  std::vector<double> field_norms(const Vector& v) const;
  /// product_ = |A| |x|
  void absolute_product(const CrsMatrix& matrix, const Vector& x);
  RCP<const DofMap> dofs_;
  Vector part_, product_;
};

}  // namespace mudline
