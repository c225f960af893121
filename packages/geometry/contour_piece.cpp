#include "geometry/contour_piece.hpp"

#include <cmath>
#include <stdexcept>

#include "core/pi.hpp"

namespace mudline {

namespace {

double distance(const PlanePoint& a, const PlanePoint& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

}  // namespace

double place_at_height(const ContourPiece& piece, double below, double above, double height) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (below + above);
    (piece.point(middle)[1] < height ? below : above) = middle;
  }
  return 0.5 * (below + above);
}

LinePiece::LinePiece(PlanePoint from, PlanePoint to, bool continues_before, bool continues_after)
    : from_(from),
      to_(to),
      length_(distance(from, to)),
      continues_before_(continues_before),
      continues_after_(continues_after) {
  if (!(length_ > 0)) throw std::logic_error("a contour line has no length");
  tangent_ = {(to[0] - from[0]) / length_, (to[1] - from[1]) / length_};
}

double LinePiece::closest(const PlanePoint& x) const {
  const double s = (x[0] - from_[0]) * tangent_[0] + (x[1] - from_[1]) * tangent_[1];
  if (s < 0 && !continues_before_) return 0;
  if (s > length_ && !continues_after_) return length_;
  return s;
}

std::shared_ptr<const ContourPiece> LinePiece::mirrored() const {
  return std::make_shared<LinePiece>(PlanePoint{-to_[0], to_[1]}, PlanePoint{-from_[0], from_[1]}, continues_after_,
                                     continues_before_);
}

ArcPiece::ArcPiece(PlanePoint centre, double radius, double start, double sweep)
    : centre_(centre), radius_(radius), start_(start), sweep_(sweep) {
  if (!(radius > 0) || sweep == 0 || std::abs(sweep) > 2 * pi * (1 + 1e-12))
    throw std::logic_error("a contour arc needs a positive radius and a sweep of at most a full turn");
}

PlanePoint ArcPiece::point(double s) const {
  const double a = angle(s);
  return {centre_[0] + radius_ * std::cos(a), centre_[1] + radius_ * std::sin(a)};
}

PlanePoint ArcPiece::tangent(double s) const {
  const double a = angle(s), sign = sweep_ < 0 ? -1 : 1;
  return {-sign * std::sin(a), sign * std::cos(a)};
}

double ArcPiece::closest(const PlanePoint& x) const {
  const double dx = x[0] - centre_[0], dy = x[1] - centre_[1];
  if (dx == 0 && dy == 0) return 0.5 * length();  // every point is equally near: the middle keeps the symmetry
  // angle from the start in the direction of travel, in [0, 2 pi)
  double turned = (std::atan2(dy, dx) - start_) * (sweep_ < 0 ? -1 : 1);
  turned -= 2 * pi * std::floor(turned / (2 * pi));
  if (turned <= std::abs(sweep_)) return radius_ * turned;
  return distance(x, point(0)) <= distance(x, point(length())) ? 0 : length();
}

std::shared_ptr<const ContourPiece> ArcPiece::mirrored() const {
  return std::make_shared<ArcPiece>(PlanePoint{-centre_[0], centre_[1]}, radius_, pi - (start_ + sweep_), sweep_);
}

}  // namespace mudline
