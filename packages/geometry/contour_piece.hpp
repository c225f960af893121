#pragma once

#include <memory>

#include "tensor/vec.hpp"

namespace mudline {

/// The first two coordinates of a point.
template <class Place>
PlanePoint in_plane(const Place& x) {
  return {x[0], x[1]};
}

/// One smooth piece of a contour, parametrised by its arc length s [m]. The body lies on the left of the direction of
/// travel, so the normal into the soil is the tangent turned clockwise.
class ContourPiece {
 public:
  virtual ~ContourPiece() = default;
  virtual double length() const = 0;
  virtual PlanePoint point(double s) const = 0;
  /// Unit vector in the direction of travel.
  virtual PlanePoint tangent(double s) const = 0;
  /// kappa [1/m] with dn/ds = kappa t: positive where the body is convex.
  virtual double curvature(double s) const = 0;
  /// Arc length of the point of the piece nearest to x; exactly 0 or length() when that is an end.
  virtual double closest(const PlanePoint& x) const = 0;
  /// The mirror image about x = 0, traversed backwards so that the body stays on the left.
  virtual std::shared_ptr<const ContourPiece> mirrored() const = 0;
};

/// The place s between `below` and `above` at which a piece reaches a height [m]; the piece is lower at `below`.
double place_at_height(const ContourPiece& piece, double below, double above, double height);

/// A straight line. An end that continues has no end point for closest(): the line runs on for ever there, although
/// length() (and so every picture) stops.
class LinePiece : public ContourPiece {
 public:
  LinePiece(PlanePoint from, PlanePoint to, bool continues_before = false, bool continues_after = false);
  double length() const override { return length_; }
  PlanePoint point(double s) const override { return {from_[0] + s * tangent_[0], from_[1] + s * tangent_[1]}; }
  PlanePoint tangent(double) const override { return tangent_; }
  double curvature(double) const override { return 0; }
  double closest(const PlanePoint& x) const override;
  std::shared_ptr<const ContourPiece> mirrored() const override;

 private:
  PlanePoint from_, to_, tangent_;
  double length_;
  bool continues_before_, continues_after_;
};

/// A circular arc around `centre` from the angle `start` [rad] through `sweep` [rad]; a positive sweep
/// (counter-clockwise) makes a convex body, a negative one a hollow. At most a full turn.
class ArcPiece : public ContourPiece {
 public:
  ArcPiece(PlanePoint centre, double radius, double start, double sweep);
  double length() const override { return radius_ * (sweep_ < 0 ? -sweep_ : sweep_); }
  PlanePoint point(double s) const override;
  PlanePoint tangent(double s) const override;
  double curvature(double) const override { return (sweep_ < 0 ? -1 : 1) / radius_; }
  double closest(const PlanePoint& x) const override;
  std::shared_ptr<const ContourPiece> mirrored() const override;

 private:
  double angle(double s) const { return start_ + (sweep_ < 0 ? -s : s) / radius_; }
  PlanePoint centre_;
  double radius_, start_, sweep_;
};

}  // namespace mudline
