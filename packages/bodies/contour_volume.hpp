#pragma once

#include <memory>
#include <vector>

#include "discretisation/mesh.hpp"
#include "geometry/contour.hpp"

namespace mudline {

/// Volume enclosed by a contour below a height in the body frame: over the whole circumference in axisymmetry, per
/// metre of depth in plane strain (of the modelled half where the contour is a half one).
class ContourVolume {
 public:
  ContourVolume(const Contour& contour, Geometry geometry);

  /// Volume below the height h [m]; of an open contour up to its end [m3].
  double below(double h) const;
  /// Area of the section at the height h, the derivative of below() [m2].
  double section(double h) const;
  /// Volume of a closed contour [m3]; 0 for an open one.
  double total() const { return total_; }
  /// Largest section across the vertical, for drag [m2].
  double frontal_area() const { return frontal_area_; }

 private:
  /// A short run of a piece; heights at its ends and the volume between it and the axis.
  struct Run {
    std::shared_ptr<const ContourPiece> piece;
    double from, to, low, high, volume;
    bool crosses(double h) const { return (low < h) != (high < h); }
  };
  /// Area of the section between the axis and x: pi x^2 in axisymmetry, x in plane strain.
  double flank(double x) const;
  /// int flank dy between two arc lengths of a piece.
  double integrate(const ContourPiece& piece, double from, double to) const;
  /// Arc length at which a run crosses the height [m].
  static double crossing(const Run& run, double h);
  std::vector<Run> runs_;
  Geometry geometry_;
  double total_ = 0, frontal_area_ = 0;
};

}  // namespace mudline
