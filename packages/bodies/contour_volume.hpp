#pragma once

#include <memory>
#include <vector>

#include "discretisation/mesh.hpp"
#include "geometry/contour.hpp"

namespace mudline {

/// Volume enclosed by a contour below a height in the body's frame: of the whole circumference in axisymmetry, per
/// metre of depth in plane strain (of the half that a half contour models).
class ContourVolume {
 public:
  ContourVolume(const Contour& contour, Geometry geometry);

  /// [m3] below the height h [m]; of an open contour as far as it is drawn.
  double below(double h) const;
  /// d below / dh [m2]: the area of the section.
  double section(double h) const;
  /// [m3] of a closed contour; 0 of an open one, which has no end.
  double total() const { return total_; }
  /// [m2] largest area across the vertical: what the water meets.
  double frontal_area() const { return frontal_area_; }

 private:
  /// A short run of a piece; heights at its ends and the volume between it and the axis.
  struct Run {
    std::shared_ptr<const ContourPiece> piece;
    double from, to, low, high, volume;
    bool crosses(double h) const { return (low < h) != (high < h); }
  };
  /// pi x^2 or x, the measure summed from 0 to x: the section's share of one flank.
  double flank(double x) const;
  /// int flank dy between two arc lengths of a piece.
  double integrate(const ContourPiece& piece, double from, double to) const;
  /// Where a run crosses the height.
  static double crossing(const Run& run, double h);
  std::vector<Run> runs_;
  Geometry geometry_;
  double total_ = 0, frontal_area_ = 0;
};

}  // namespace mudline
