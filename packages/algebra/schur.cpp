#include "algebra/schur.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/amg.hpp"
#include "algebra/field_blocks.hpp"

namespace mudline {

namespace {

/// The positive root of z^2 - t z - q/4 = 0 for q >= 0, (t + sqrt(t^2 + q))/2, without cancellation for t < 0.
double positive_root(double t, double q) {
  const double root = std::hypot(t, std::sqrt(q));
  if (t >= 0) return 0.5 * (t + root);
  return q > 0 ? 0.5 * q / (root - t) : 0;
}

/// A wave term that is below this fraction of the other term even for the longest wave is not worth a solve.
constexpr double negligible = 1e-3;

}  // namespace

SchurCoefficients schur_coefficients(const BlockData& data, double x_min) {
  const double M = data.constrained_modulus, c = data.inertia, s = data.storage, h = data.conduction;
  const double g = data.coupling_u * data.coupling_p;
  const double sM = s * M, hc = h * c;
  const double z_minus_sM = positive_root(g + hc - sM, 4 * g * sM);
  const double z_minus_hc = positive_root(g + sM - hc, 4 * g * hc);
  const double z = std::max(z_minus_sM + sM, z_minus_hc + hc);
  SchurCoefficients result;
  if (!(z > 0)) return result;
  const double D = z - sM * (hc / z);  // h M r1 = h M s c / z

  result.consolidation = z_minus_hc > 0;
  if (result.consolidation) {
    result.theta = D / z_minus_hc;
    result.sigma = z_minus_sM / M;
  }
  result.wave = c > 0 && z_minus_sM > 0;
  if (result.wave) {
    result.l1 = D * z / (c * z_minus_sM);
    // Without storage and drainage a constant pressure would be undetermined; a small term determines it.
    result.m1 = std::max(s * D / z_minus_sM, 1e-6 * result.l1 * x_min);
    if (result.consolidation) {
      const double wave = 1 / (result.l1 * x_min + result.m1);
      const double consolidation = 1 / (result.theta * (s + h * x_min + result.sigma));
      result.wave = wave > negligible * consolidation;
    }
  }
  // Without waves the soil also deforms sideways where its boundaries permit; the drained modulus saves one or two
  // iterations (measured).
  if (!result.wave && data.drained_modulus > 0) result.sigma = z_minus_sM / data.drained_modulus;
  return result;
}

SchurInverse::SchurInverse(const SchurCoefficients& coefficients, RCP<CrsMatrix> block, RCP<CrsMatrix> mass,
                           RCP<CrsMatrix> laplacian, const std::vector<char>& constrained)
    : map_(block->getRowMap()), constrained_(constrained), term_(rcp(new MultiVector(block->getRowMap(), 1))) {
  const auto add_term = [&](const RCP<CrsMatrix>& matrix) {
    isolate(*matrix, constrained_);
    AmgInput input;
    input.matrix = matrix;
    terms_.push_back(amg_cycle(input));
  };
  if (coefficients.wave) add_term(combination(coefficients.l1, *laplacian, coefficients.m1, *mass));
  if (coefficients.consolidation)
    add_term(combination(coefficients.theta, *block, coefficients.theta * coefficients.sigma, *mass));

  Vector diagonal(map_);
  block->getLocalDiagCopy(diagonal);
  const auto values = diagonal.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (std::size_t i = 0; i < constrained_.size(); ++i) diagonal_.push_back(values(i, 0) != 0 ? values(i, 0) : 1);
}

void SchurInverse::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double, double) const {
  y.putScalar(0);
  for (const RCP<Operator>& term : terms_) {
    term->apply(x, *term_);
    y.update(1, *term_, 1);
  }
  const auto right = x.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto solution = y.getLocalViewHost(Tpetra::Access::ReadWrite);
  for (std::size_t i = 0; i < constrained_.size(); ++i)
    if (constrained_[i]) solution(i, 0) = right(i, 0) / diagonal_[i];
}

}  // namespace mudline
