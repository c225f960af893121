#pragma once

#include <string>
#include <vector>

#include "discretisation/gmsh_session.hpp"
#include "discretisation/piecewise_polynomial.hpp"

namespace mudline {

/// One curve of a CAD model in the x-y plane, in the model's direction and the file's unit of length.
struct CadCurve {
  enum class Kind { line, circle, general };
  int tag;
  Kind kind;
  std::vector<CurvePoint> points;   // line: its ends; circle: start, a third and two thirds of its length, end
  std::vector<PolynomialRun> runs;  // general: accurate to 1e-11 of the curve's extent
  CurvePoint start() const;
  CurvePoint end() const;
  CadCurve reversed() const;
  void transfer(ByteStream& s) { s(tag)(kind)(points)(runs); }
};

/// The curves of a model to read: a physical group, or tags.
struct CurveSelection {
  std::string group;
  std::vector<int> tags;
};

/// Reads curves of a geometry (.geo) or CAD model (.step, .stp, .brep) by Gmsh. Lines and circles are recognised; for
/// all others, the model's own parametrisation is approximated by polynomial_runs(). Throws InputError for a model that
/// cannot be read, for unknown groups and tags, and for curves off the x-y plane, at the entries "file", "physical
/// curve" and "curves".
std::vector<CadCurve> read_gmsh_curves(const GmshFile& file, const CurveSelection& selection,
                                       const SourcePosition& position);

}  // namespace mudline
