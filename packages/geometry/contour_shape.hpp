#pragma once

#include "core/registry.hpp"
#include "geometry/contour_approximation.hpp"

namespace mudline {

/// A shape that a body's "contour" may name: reads its sizes and makes the contour. The origin of the contour is the
/// body's reference point (the body's "position"): for cone, flat pile and sphere the lowest point of the real, rounded
/// contour on the axis.
class ContourShape {
 public:
  virtual ~ContourShape() = default;
  virtual Contour build() const = 0;
  /// The contour as contact shall see it, by the deck's "approximation". InputError when it cannot bound a body.
  Contour contour(const Section& section) const;
  /// Height [m] above the reference point that separates tip from shaft; 0: all is shaft.
  virtual double tip_height() const { return 0; }

  /// Kind of body that the shape's name implies: a body of revolution, which in plane strain would be a wedge or a
  /// wall; one that lies across the plane, which would be another body if it were revolved; or nothing.
  enum class Named { nothing, of_revolution, across_plane };
  virtual Named named() const { return Named::nothing; }

 protected:
  /// Declares the parameters that all shapes share.
  void common_parameters(Parameters& p);
  /// The half contour itself, or with its mirror image, as the extent says.
  Contour complete(Contour half) const;
  ContourExtent extent_ = ContourExtent::half;

 private:
  Approximation approximation_ = Approximation::exact;
  double chord_length_ = 0;
};

/// Cone with a cylindrical shaft. A tip radius r moves the tip: the sharp apex would lie r (1 / sin(apex / 2) - 1)
/// below the reference point.
class ConeShape : public ContourShape {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  Contour build() const override;
  double tip_height() const override;
  Named named() const override { return Named::of_revolution; }

 protected:
  void fillet_parameters(Parameters& p);
  double diameter_ = 0;

 private:
  /// Corners of the half contour, the sharp apex at the origin.
  std::vector<PlanePoint> corners() const;
  double apex_angle_ = 60, tip_radius_ = 0, shoulder_radius_ = 0, shaft_length_ = 0;
};

/// The cone of the standard cone penetration test, unless the deck gives other sizes.
class ConePenetrometerShape : public ConeShape {
 public:
  ConePenetrometerShape();
  void parameters(Parameters& p);
};

/// Flat-ended cylinder (axisymmetric) or wall (plane strain) with a rounded edge.
class FlatPileShape : public ContourShape {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  Contour build() const override;
  double tip_height() const override { return corner_radius_ > 0 ? corner_radius_ : 1e-9 * diameter_; }

 private:
  std::vector<PlanePoint> corners() const;
  double diameter_ = 0, corner_radius_ = 0, shaft_length_ = 0;
};

class SphereShape : public ContourShape {
 public:
  void parameters(Parameters& p);
  Contour build() const override;
  double tip_height() const override { return diameter_; }
  Named named() const override { return Named::of_revolution; }

 private:
  double diameter_ = 0;
};

/// Circle that is the section of a cylinder across the plane.
class CylinderShape : public SphereShape {
 public:
  Named named() const override { return Named::across_plane; }
};

/// Straight lines through given points with rounded corners, in the body's own frame.
class PolylineShape : public ContourShape {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  Contour build() const override;

 private:
  std::vector<PlanePoint> points() const;
  std::vector<double> radii() const;
  std::vector<double> x_, y_, fillet_radii_;
};

void register_contours(Registry<ContourShape>& registry);

}  // namespace mudline
