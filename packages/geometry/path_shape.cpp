#include "geometry/path_shape.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/pi.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

std::vector<PlanePoint> paired(const std::vector<double>& x, const std::vector<double>& y) {
  std::vector<PlanePoint> points;
  for (std::size_t i = 0; i < x.size(); ++i) points.push_back({x[i], y[i]});
  return points;
}

void check_pairs(const Section& section, const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() != y.size())
    section.fail("'y' has " + std::to_string(y.size()) + " values, 'x' has " + std::to_string(x.size()), "y");
}

class PathLine : public PathPiece {
 public:
  void parameters(Parameters& p) { p.required("to", to_, "m", "End of the line"); }
  ContourPieces build(const PlanePoint& from) const override { return {std::make_shared<LinePiece>(from, to_)}; }

 private:
  Vec<double, 2> to_{};
};

class PathArc : public PathPiece {
 public:
  void parameters(Parameters& p) {
    p.required("to", to_, "m", "End of the arc");
    p.required("radius", radius_, "m", any(), "Positive: the body bulges (counter-clockwise); negative: a hollow");
    p.add("large", large_, "The longer one of the two arcs");
  }
  void check(const Section& section) {
    if (radius_ == 0) section.fail("an arc needs a radius that is not 0", "radius");
  }
  ContourPieces build(const PlanePoint& from) const override {
    const double dx = to_[0] - from[0], dy = to_[1] - from[1], chord = std::hypot(dx, dy), radius = std::abs(radius_);
    if (!(chord > 0) || chord > 2 * radius * (1 + 1e-12))
      throw std::logic_error("the arc's ends must be different and at most its diameter apart");
    const double half = std::asin(std::min(1.0, chord / (2 * radius))), sweep = large_ ? 2 * pi - 2 * half : 2 * half;
    // the centre lies on the left of a bulge's short arc
    const double sign = radius_ > 0 ? 1 : -1, away = sign * (large_ ? -1 : 1) * radius * std::cos(half);
    const PlanePoint centre{0.5 * (from[0] + to_[0]) - away * dy / chord, 0.5 * (from[1] + to_[1]) + away * dx / chord};
    return {
        std::make_shared<ArcPiece>(centre, radius, std::atan2(from[1] - centre[1], from[0] - centre[0]), sign * sweep)};
  }

 private:
  Vec<double, 2> to_{};
  double radius_ = 0;
  bool large_ = false;
};

class PathBezier : public PathPiece {
 public:
  void parameters(Parameters& p) {
    p.required("x", x_, "m", any(), "Control points that follow the present point, three for every cubic piece");
    p.required("y", y_, "m", any(), "Their heights");
  }
  void check(const Section& section) {
    check_pairs(section, x_, y_);
    if (x_.empty() || x_.size() % 3 != 0)
      section.fail(
          "cubic pieces take three control points each after the present one, given " + std::to_string(x_.size()), "x");
  }
  ContourPieces build(const PlanePoint& from) const override {
    ContourPieces pieces;
    PlanePoint at = from;
    const auto b = paired(x_, y_);
    for (std::size_t i = 0; i < b.size(); i += 3) {
      pieces.push_back(std::make_shared<CurvePiece>(std::make_shared<CubicBezier>(at, b[i], b[i + 1], b[i + 2])));
      at = b[i + 2];
    }
    return pieces;
  }

 private:
  std::vector<double> x_, y_;
};

class PathHermite : public PathPiece {
 public:
  void parameters(Parameters& p) {
    p.required("x", x_, "m", any(), "Points after the present one that a smooth (C1) curve goes through");
    p.required("y", y_, "m", any(), "Their heights");
    p.add("first direction", first_, "-", "Direction at the present point; left out: from the neighbouring points");
    p.add("last direction", last_, "-", "Direction at the last point; left out: from the neighbouring points");
  }
  void check(const Section& section) {
    check_pairs(section, x_, y_);
    if (x_.empty()) section.fail("a curve needs at least one point after the present one", "x");
  }
  ContourPieces build(const PlanePoint& from) const override {
    auto points = paired(x_, y_);
    points.insert(points.begin(), from);
    return hermite_pieces(points, first_, last_);
  }

 private:
  std::vector<double> x_, y_;
  Vec<double, 2> first_{}, last_{};
};

class PathNurbs : public PathPiece {
 public:
  void parameters(Parameters& p) {
    p.required("x", x_, "m", any(), "Control points after the present one, which is the first");
    p.required("y", y_, "m", any(), "Their heights");
    p.add("degree", degree_, "-", closed(1, 9), "Of the spline");
    p.add("weights", weights_, "-", positive(), "Of all control points, the present one's first; left out: all 1");
    p.add("knots", knots_, "-", any(),
          "Non-decreasing, as many as control points + degree + 1, clamped at both ends; left out: uniform");
  }
  void check(const Section& section) {
    check_pairs(section, x_, y_);
    const std::size_t n = x_.size() + 1, degree = static_cast<std::size_t>(degree_);
    if (n < degree + 1)
      section.fail("a spline of degree " + std::to_string(degree) + " needs at least " + std::to_string(degree) +
                       " points after the present one",
                   "x");
    if (weights_.empty()) weights_.assign(n, 1.0);
    if (weights_.size() != n)
      section.fail(
          "'weights' has " + std::to_string(weights_.size()) + " values for " + std::to_string(n) + " control points",
          "weights");
    if (knots_.empty())
      for (std::size_t i = 0; i < n + degree + 1; ++i)
        knots_.push_back(i <= degree ? 0.0
                         : i >= n    ? static_cast<double>(n - degree)
                                     : static_cast<double>(i - degree));
    if (knots_.size() != n + degree + 1)
      section.fail(
          "'knots' has " + std::to_string(knots_.size()) + " values, needed are " + std::to_string(n + degree + 1),
          "knots");
    if (!std::is_sorted(knots_.begin(), knots_.end())) section.fail("the knots must not decrease", "knots");
    if (knots_[0] != knots_[degree] || knots_[n] != knots_[n + degree] || !(knots_[degree] < knots_[n]))
      section.fail(
          "the spline must start and end at its first and last control point: the first and the last knot are there "
          "degree + 1 times",
          "knots");
    for (std::size_t i = degree + 1; i + degree < n; ++i)
      if (knots_[i] == knots_[i + degree])
        section.fail("a knot inside is there more than degree times: the curve would break", "knots");
  }
  ContourPieces build(const PlanePoint& from) const override {
    auto points = paired(x_, y_);
    points.insert(points.begin(), from);
    return nurbs_pieces(degree_, knots_, points, weights_);
  }

 private:
  std::vector<double> x_, y_, weights_, knots_;
  int degree_ = 3;
};

}  // namespace

void register_path_pieces(Registry<PathPiece>& registry) {
  registry.add<PathLine>("line", "Straight line");
  registry.add<PathArc>("arc", "Circular arc");
  registry.add<PathBezier>("bezier", "Cubic Bezier curves");
  registry.add<PathHermite>("hermite", "Smooth cubic curve through points");
  registry.add<PathNurbs>("nurbs", "Non-uniform rational B-spline");
}

void continue_open_end(ContourPieces& pieces, ContourExtent extent) {
  const PlanePoint first = pieces.front()->point(0), at = pieces.back()->point(pieces.back()->length());
  double length = 0;
  for (const auto& piece : pieces) length += piece->length();
  const bool half = extent == ContourExtent::half;
  const bool ended =
      half ? std::abs(at[0]) <= 1e-9 * length : std::hypot(at[0] - first[0], at[1] - first[1]) <= 1e-9 * length;
  const auto* last = dynamic_cast<const LinePiece*>(pieces.back().get());
  if (!ended && last)
    pieces.back() = std::make_shared<LinePiece>(last->point(0), last->point(last->length()), false, true);
}

void PathShape::parameters(Parameters& p) {
  common_parameters(p);
  p.required("start", start_, "m", "Where the path begins, in the body's frame");
  p.passes_on("pieces", "Pieces in order, the body on their left; each one's 'type' names a piece of a path");
}

void PathShape::check(const Section& section) {
  Registry<PathPiece> registry("contour piece");
  register_path_pieces(registry);
  const Section pieces = section.section("pieces");
  pieces.allow_parameters({});
  if (pieces.section_names().empty()) section.fail("a path needs at least one piece", "pieces");
  if (extent_ == ContourExtent::half && start_[0] != 0)
    section.fail("a half contour starts on its axis: the first value must be 0", "start");
  PlanePoint at = start_;
  for (const std::string& name : pieces.section_names()) {
    const Section entry = pieces.section(name);
    const auto piece = registry.create(entry);
    try {
      for (auto& built : piece->build(at)) pieces_.push_back(std::move(built));
    } catch (const std::logic_error& error) {
      entry.fail(error.what());
    }
    at = pieces_.back()->point(pieces_.back()->length());
  }
  continue_open_end(pieces_, extent_);
}

}  // namespace mudline
