#pragma once

#include <functional>
#include <vector>

#include "discretisation/byte_stream.hpp"
#include "tensor/vec.hpp"

namespace mudline {

using CurvePoint = Vec<double, 2>;  // [m]

/// A run of a plane curve, x(t) = sum_k coefficients[k] T_k(2 t - 1) for t in [0, 1], with Chebyshev's polynomials.
struct PolynomialRun {
  std::vector<CurvePoint> coefficients;
  void transfer(ByteStream& s) { s(coefficients); }

  struct Value {
    CurvePoint x, d, dd;  // [m] and its derivatives with respect to t
  };
  Value at(double t) const;
  /// The same run backwards.
  PolynomialRun reversed() const;
};

/// Runs, end to end, of polynomials of degree 12 and less that stay within `tolerance` [m] of the continuous curve f on
/// [from, to] at equal parameters; as few as it needs, with ends at the corners of f and where a derivative of it
/// jumps. A polynomial spline of degree 12 and less is reproduced to rounding. Empty where f cannot be followed: it is
/// not continuous.
std::vector<PolynomialRun> polynomial_runs(const std::function<CurvePoint(double)>& f, double from, double to,
                                           double tolerance);

}  // namespace mudline
