#pragma once

#include "discretisation/cad_curve.hpp"
#include "discretisation/gmsh_file.hpp"
#include "discretisation/source_position.hpp"

namespace mudline {

/// Reads curves of a geometry (.geo) or CAD model (.step, .stp, .brep) by Gmsh. Lines and circles are recognised; for
/// all others, the model's own parametrisation is approximated by polynomial_runs(). Throws InputError for a model that
/// cannot be read, for unknown groups and tags, and for curves off the x-y plane, at the entries "file", "physical
/// curve" and "curves".
std::vector<CadCurve> read_gmsh_curves(const GmshFile& file, const CurveSelection& selection,
                                       const SourcePosition& position);

}  // namespace mudline
