#pragma once

#include <string>
#include <vector>

#include "discretisation/byte_stream.hpp"
#include "discretisation/piecewise_polynomial.hpp"

namespace mudline {

/// One curve of a CAD model in the x-y plane, in the model's direction and the file's unit of length.
struct CadCurve {
  enum class Kind { line, circle, general };
  int tag;
  Kind kind;
  std::vector<PlanePoint> points;   // line: its ends; circle: start, a third and two thirds of its length, end
  std::vector<PolynomialRun> runs;  // general: accurate to 1e-11 of the curve's extent
  PlanePoint start() const;
  PlanePoint end() const;
  CadCurve reversed() const;
  void transfer(ByteStream& s) { s(tag)(kind)(points)(runs); }
};

/// The curves of a model to read: a physical group, or tags.
struct CurveSelection {
  std::string group;
  std::vector<int> tags;
};

}  // namespace mudline
