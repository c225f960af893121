#pragma once

#include <functional>
#include <vector>

#include "discretisation/byte_stream.hpp"
#include "tensor/curve_point.hpp"

namespace mudline {

/// One piece (run) of a plane curve, x(t) = sum_k coefficients[k] T_k(2 t - 1) for t in [0, 1], with Chebyshev's
/// polynomials.
struct PolynomialRun {
  std::vector<PlanePoint> coefficients;
  void transfer(ByteStream& s) { s(coefficients); }

  CurvePoint<2> at(double t) const;
  /// The run in the opposite direction.
  PolynomialRun reversed() const;
};

/// Consecutive polynomial pieces of degree 12 and less that stay within `tolerance` [m] of the continuous curve f on
/// [from, to] at equal parameters; as few as needed, with ends at the corners of f and where a derivative of f jumps. A
/// polynomial spline of degree 12 and less is reproduced to rounding. Empty where f cannot be approximated because it
/// is not continuous.
std::vector<PolynomialRun> polynomial_runs(const std::function<PlanePoint(double)>& f, double from, double to,
                                           double tolerance);

}  // namespace mudline
