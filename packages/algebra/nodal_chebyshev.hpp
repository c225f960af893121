#pragma once

#include <vector>

#include "algebra/joined_nodes.hpp"

namespace mudline {

/// Chebyshev smoother on D^-1 A, started from zero: y ~ A^-1 x on the upper part of the spectrum. D holds the blocks of
/// the diagonal of A that couple the unknowns of one node, unsymmetric as they are: a stiff contact with friction makes
/// one direction of a node stiff, which the diagonal alone does not see. Joined nodes share one block: where a contact
/// presses only a part of a side, its nodes still have soft modes of moving together, which no block of one node sees.
class NodalChebyshev : public Operator {
 public:
  struct Settings {
    int degree = 2;
    double ratio = 10;  // largest eigenvalue over the smallest one that is smoothed
  };
  /// `joined`: by owned node; empty: none.
  NodalChebyshev(RCP<const NodeMatrix> matrix, const Settings& settings, const std::vector<char>& joined = {});

  RCP<const Map> getDomainMap() const override { return matrix_->getDomainMap(); }
  RCP<const Map> getRangeMap() const override { return matrix_->getDomainMap(); }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp = Teuchos::NO_TRANS, double = 1,
             double = 0) const override;

  /// Largest eigenvalue of D^-1 A, as estimated.
  double largest_eigenvalue() const { return largest_; }

 private:
  void invert_blocks();
  /// Estimates the largest eigenvalue by the power method. The start depends only on the global ids, so that a repeated
  /// set-up gives the same value.
  double estimate_largest() const;
  /// y = share * y + factor * D^-1 x
  void add_inverse(double factor, const MultiVector& x, double share, MultiVector& y) const;

  RCP<const NodeMatrix> matrix_;
  Settings settings_;
  std::vector<float> inverse_;  // (node, component, component)
  JoinedNodes joined_;
  double largest_ = 1;
  mutable MultiVector residual_, step_;
};

}  // namespace mudline
