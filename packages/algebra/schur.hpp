#pragma once

#include <vector>

#include "algebra/linear_solver.hpp"

namespace mudline {

/// Approximate inverse of the pressure Schur complement by two scalar pressure solves.
///
/// The Jacobian is [[F, -cu L], [cp L^T, C]] with F = c_m M + c_k K, C = c_s S + c_h H, cu = c_p alpha and
/// cp = c_v alpha; eliminating the displacement leaves  Shat = C + cu cp L^T F^-1 L.  L carries a pressure gradient,
/// which drives compressional motion only: in a homogeneous medium a wave of squared number x = kappa^2 meets
/// F = c + M x (c = c_m rho inertia, M = c_k (lambda + 2G)), L^T F^-1 L = x/(c + M x), and with s = c_s/Q,
/// h = c_h k/gamma_w, g = cu cp
///
///     Shat = s + h x + g x/(c + M x),     Shat^-1 = (c + M x)/(h M x^2 + (s M + h c + g) x + s c).
///
/// The denominator has the roots x = -r1, -r2 <= 0, as its discriminant (s M - h c + g)^2 + 4 g h c is not negative:
///
///     Shat^-1 = w1/(x + r1) + w2/(x + r2) = 1/(l1 x + m1) + 1/(l2 x + m2),
///
/// in which x stands for the pressure Laplacian and 1 for the pressure mass matrix.
/// With z = h M r2 (the larger root of z^2 - (s M + h c + g) z + s M h c, finite also for h = 0) and D = z - h M r1:
///
///     l1 = D z/(c (z - s M)),   m1 = s D/(z - s M)
///     l2 = h D/(z - h c),       m2 = z D/(M (z - h c)).
///
/// The first term is the slow compressional wave, absent without inertia; the second one is consolidation. Without
/// inertia the second is the fixed-stress form s + h x + g/M, with the drained modulus for M.
///
/// The second term is written as theta [C + sigma 1], theta = D/(z - h c), sigma = (z - s M)/M, and takes C from the
/// matrix itself, so that layers of different permeability enter with their own values. Each term takes one multigrid
/// cycle.
struct SchurCoefficients {
  bool wave = false;           // first term present
  double l1 = 0, m1 = 0;       // factors of the Laplacian and of the mass matrix
  bool consolidation = false;  // second term present
  double theta = 0, sigma = 0;
};

/// `x_min`: the smallest squared wave number of the domain [1/m2]; a wave term that is small even there is dropped.
SchurCoefficients schur_coefficients(const BlockData& data, double x_min);

/// The approximate inverse Shat^-1 of the pressure Schur complement, as an operator.
class SchurInverse : public Operator {
 public:
  /// `block`: C with the constrained rows and columns isolated; mass and laplacian without constraints, all on one map.
  SchurInverse(const SchurCoefficients& coefficients, RCP<CrsMatrix> block, RCP<CrsMatrix> mass,
               RCP<CrsMatrix> laplacian, const std::vector<char>& constrained);

  RCP<const Map> getDomainMap() const override { return map_; }
  RCP<const Map> getRangeMap() const override { return map_; }
  void apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp = Teuchos::NO_TRANS, double = 1,
             double = 0) const override;

 private:
  RCP<const Map> map_;
  std::vector<RCP<Operator>> terms_;
  std::vector<char> constrained_;
  std::vector<double> diagonal_;  // diagonal of C; constrained unknowns are solved exactly
  mutable RCP<MultiVector> term_;
};

}  // namespace mudline
