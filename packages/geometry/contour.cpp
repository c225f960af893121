#include "geometry/contour.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tensor/vec.hpp"

namespace mudline {

namespace {

constexpr double same_direction = 1e-10;  // 1 - cos of the angle below which a joint counts as smooth (1.4e-5 rad)

PlanePoint right_of(const PlanePoint& t) { return {t[1], -t[0]}; }

/// The foot lies at a corner or at an open end: the gap is the distance to that point, its sign that of `outward`.
void point_foot(const PlanePoint& from_foot, const PlanePoint& outward, double tolerance, ContourFoot& result) {
  const double distance = std::hypot(from_foot[0], from_foot[1]);
  result.curvature = result.travel = 0;
  if (distance <= tolerance) {
    result.gap = 0;
    result.normal = outward;
    result.turning = 0;
    return;
  }
  result.gap = dot(from_foot, outward) >= 0 ? distance : -distance;
  result.normal = {from_foot[0] / result.gap, from_foot[1] / result.gap};
  result.turning = 1 / result.gap;
}

}  // namespace

Contour::Contour(std::vector<std::shared_ptr<const ContourPiece>> pieces, ContourExtent extent)
    : pieces_(std::move(pieces)), extent_(extent) {
  if (pieces_.empty()) throw std::logic_error("a contour needs a piece");
  start_.assign(1, 0.0);
  for (const auto& piece : pieces_) start_.push_back(start_.back() + piece->length());
  size_ = start_.back();
  const auto apart = [this](const PlanePoint& a, const PlanePoint& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1]) > 1e-9 * size_;
  };
  for (std::size_t i = 1; i < pieces_.size(); ++i)
    if (apart(pieces_[i - 1]->point(pieces_[i - 1]->length()), pieces_[i]->point(0)))
      throw std::logic_error("the pieces of a contour do not join");
  const PlanePoint first = pieces_.front()->point(0), last = pieces_.back()->point(pieces_.back()->length());
  if (extent_ == ContourExtent::half && std::abs(first[0]) > 1e-9 * size_)
    throw std::logic_error("a half contour starts on the axis x = 0");
  closed_ = extent_ == ContourExtent::full && !apart(first, last);
}

bool Contour::neighbour_normal(int piece, int end, PlanePoint& normal) const {
  const int n = static_cast<int>(pieces_.size());
  int other = end == 0 ? piece - 1 : piece + 1;
  if (other < 0 || other >= n) {
    const double s = end == 0 ? 0.0 : pieces_[piece]->length();
    if (extent_ == ContourExtent::half && std::abs(pieces_[piece]->point(s)[0]) <= 1e-9 * size_) {
      const PlanePoint own = right_of(pieces_[piece]->tangent(s));
      normal = {-own[0], own[1]};
      return true;
    }
    if (!closed_) return false;
    other = (other + n) % n;
  }
  normal = right_of(pieces_[other]->tangent(end == 0 ? pieces_[other]->length() : 0.0));
  return true;
}

ContourFoot Contour::closest(const PlanePoint& x) const {
  if (extent_ == ContourExtent::half && x[0] < 0) {  // rounding may put a node of the axis there
    ContourFoot image = closest({-x[0], x[1]});
    image.normal[0] = -image.normal[0];
    image.foot[0] = -image.foot[0];
    image.arc_length = -image.arc_length;
    image.tangent = {-image.normal[1], image.normal[0]};
    return image;
  }
  ContourFoot result{};
  double s = 0, best = 0;
  result.piece = -1;
  for (int i = 0; i < static_cast<int>(pieces_.size()); ++i) {
    const double candidate = pieces_[i]->closest(x);
    const PlanePoint d = x - pieces_[i]->point(candidate);
    const double square = dot(d, d);
    if (result.piece >= 0 && square >= best) continue;
    best = square;
    s = candidate;
    result.piece = i;
  }
  const ContourPiece& piece = *pieces_[result.piece];
  result.foot = piece.point(s);
  result.arc_length = start_[result.piece] + s;
  const PlanePoint d = x - result.foot, own = right_of(piece.tangent(s));
  PlanePoint other = own;
  const bool at_end = s == 0 || s == piece.length();
  const bool open_end = at_end && !neighbour_normal(result.piece, s == 0 ? 0 : 1, other);
  if (at_end && (open_end || 1 - dot(own, other) > same_direction)) {
    PlanePoint mean{own[0] + other[0], own[1] + other[1]};
    const double size = std::hypot(mean[0], mean[1]);
    mean = size > 1e-6 ? PlanePoint{mean[0] / size, mean[1] / size} : own;
    point_foot(d, mean, 1e-14 * size_, result);
  } else {
    result.gap = dot(d, own);
    result.normal = own;
    result.curvature = piece.curvature(s);
    const double stretch = 1 + result.curvature * result.gap;
    const bool centre = std::abs(stretch) <= 1e-9;  // of an arc: everything there has the same foot
    result.turning = centre ? 0.0 : result.curvature / stretch;
    result.travel = centre ? 0.0 : 1 / stretch;
  }
  result.tangent = {-result.normal[1], result.normal[0]};
  return result;
}

double Contour::distance(const ContourFoot& from, const ContourFoot& to) const {
  const double direct = to.arc_length - from.arc_length;
  return closed_ ? std::remainder(direct, length()) : direct;
}

std::vector<PlanePoint> Contour::sample(double chord_error) const {
  if (!(chord_error > 0)) throw std::logic_error("the chord error must be positive");
  std::vector<PlanePoint> result{pieces_.front()->point(0)};
  for (const auto& piece : pieces_) {
    const double length = piece->length();
    const double bend = std::max(
        {std::abs(piece->curvature(0)), std::abs(piece->curvature(length / 2)), std::abs(piece->curvature(length))});
    // a chord over the arc l deviates by kappa l^2 / 8
    const int chords = std::max(1, static_cast<int>(std::ceil(length * std::sqrt(bend / (8 * chord_error)))));
    for (int i = 1; i <= chords; ++i) result.push_back(piece->point(length * i / chords));
  }
  return result;
}

Contour Contour::mirrored() const {
  if (extent_ != ContourExtent::half) throw std::logic_error("only a half contour has a mirror image");
  std::vector<std::shared_ptr<const ContourPiece>> all;
  for (auto piece = pieces_.rbegin(); piece != pieces_.rend(); ++piece) all.push_back((*piece)->mirrored());
  all.insert(all.end(), pieces_.begin(), pieces_.end());
  return Contour(std::move(all), ContourExtent::full);
}

}  // namespace mudline
