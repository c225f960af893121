#include "discretisation/cad_curve.hpp"

#include <algorithm>

namespace mudline {

PlanePoint CadCurve::start() const { return kind == Kind::general ? runs.front().at(0).x : points.front(); }
PlanePoint CadCurve::end() const { return kind == Kind::general ? runs.back().at(1).x : points.back(); }

CadCurve CadCurve::reversed() const {
  CadCurve result = *this;
  std::reverse(result.points.begin(), result.points.end());
  std::reverse(result.runs.begin(), result.runs.end());
  for (PolynomialRun& run : result.runs) run = run.reversed();
  return result;
}

}  // namespace mudline
