#pragma once

#include <string>
#include <vector>

#include "discretisation/cad_curve.hpp"
#include "discretisation/gmsh_file.hpp"
#include "discretisation/source_position.hpp"
#include "geometry/contour_shape.hpp"
#include "geometry/curve_piece.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// A contour of curves of a Gmsh geometry or a CAD model. They are joined end to end whatever their order and
/// direction, and traversed so that the body lies on the left: a half contour from its lower end on the axis.
class GmshCurveShape : public ContourShape {
 public:
  void parameters(Parameters& p);
  /// InputError for models and curves that cannot be read, and for curves that are no contour.
  void check(const Section& section);
  Contour build() const override { return Contour(pieces_, extent_); }

 private:
  CurveSelection selection(const Section& section) const;
  ContourPieces pieces_of(const CadCurve& curve) const;
  PlanePoint placed(const PlanePoint& x) const { return {scale_ * (x[0] - origin_[0]), scale_ * (x[1] - origin_[1])}; }

  GmshFile file_;
  std::string group_;
  std::vector<double> curves_;
  Vec<double, 2> origin_{};  // in the file's unit
  double scale_ = 1;         // [m] per unit of the file
  SourcePosition position_;
  ContourPieces pieces_;
};

}  // namespace mudline
