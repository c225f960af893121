#pragma once

#include "algebra/types.hpp"

namespace mudline {

/// The data that a multigrid cycle is built from.
struct AmgInput {
  RCP<CrsMatrix> matrix;         // global ids dense from 0, the equations of a node adjacent
  int equations = 1;             // per node
  RCP<MultiVector> null_space;   // null: constants
  RCP<MultiVector> coordinates;  // one row per node; null: none
};

/// One V-cycle of smoothed aggregation, a fixed linear operator.
RCP<Operator> amg_cycle(const AmgInput& input);

/// The matrix alpha A + beta B, on the row map of A.
RCP<CrsMatrix> combination(double alpha, const CrsMatrix& a, double beta, const CrsMatrix& b);

}  // namespace mudline
