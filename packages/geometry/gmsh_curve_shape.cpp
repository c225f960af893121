#include "geometry/gmsh_curve_shape.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/text.hpp"
#include "discretisation/gmsh_library.hpp"
#include "geometry/curve_chain.hpp"
#include "geometry/path_shape.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

class PolynomialCurve : public ParametricCurve {
 public:
  explicit PolynomialCurve(PolynomialRun run) : run_(std::move(run)) {}
  CurvePoint<2> at(double t) const override { return run_.at(t); }

 private:
  PolynomialRun run_;
};

/// An arc through four points at equal angles from each other.
std::shared_ptr<const ContourPiece> arc(const std::vector<PlanePoint>& x) {
  const PlanePoint a = x[1] - x[0], b = x[2] - x[0];
  const double area = 2 * cross(a, b), aa = a[0] * a[0] + a[1] * a[1], bb = b[0] * b[0] + b[1] * b[1];
  const PlanePoint centre{x[0][0] + (b[1] * aa - a[1] * bb) / area, x[0][1] + (a[0] * bb - b[0] * aa) / area};
  const PlanePoint from = x[0] - centre, third = x[1] - centre;
  const double step = std::atan2(cross(from, third), from[0] * third[0] + from[1] * third[1]);
  return std::make_shared<ArcPiece>(centre, std::hypot(from[0], from[1]), std::atan2(from[1], from[0]), 3 * step);
}

/// Twice the area on the left of the chain, which a straight line closes.
double signed_area(const std::vector<CadCurve>& chain) {
  std::vector<PlanePoint> outline;
  for (const CadCurve& curve : chain) {
    outline.insert(outline.end(), curve.points.begin(), curve.points.end());
    for (const PolynomialRun& run : curve.runs)
      for (int i = 0; i <= 8; ++i) outline.push_back(run.at(i / 8.0).x);
  }
  double area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) area += cross(outline[i], outline[(i + 1) % outline.size()]);
  return area;
}

double size_of(const std::vector<CadCurve>& curves) {
  double size = 0;
  const PlanePoint origin = curves.front().start();
  for (const CadCurve& curve : curves)
    for (const PlanePoint& x :
         {curve.start(), curve.end(), curve.kind == CadCurve::Kind::circle ? curve.points[1] : curve.start()})
      size = std::max(size, std::hypot(x[0] - origin[0], x[1] - origin[1]));
  return size;
}

}  // namespace

void GmshCurveShape::parameters(Parameters& p) {
  refuse_without_gmsh(p);
  position_.remember(p);
  common_parameters(p);
  file_.parameters(p, "Geometry (.geo) or CAD model (.step, .stp, .brep) in the x-y plane");
  p.add("physical curve", group_, "Name (or number) of the physical curve that is the contour");
  p.add("curves", curves_, "-", positive(), "Instead of that: numbers of the curves, in any order");
  p.add("origin", origin_, "-", "Point of the model, in its own unit, that becomes the body's reference point");
  p.add("scale", scale_, "m", positive(), "One unit of the model in metres: 0.001 for a model in millimetres");
}

CurveSelection GmshCurveShape::selection(const Section& section) const {
  if (group_.empty() == curves_.empty())
    section.fail(group_.empty() ? "which curves are the contour? give a 'physical curve' or 'curves'"
                                : "give either 'physical curve' or 'curves', not both",
                 group_.empty() ? "physical curve" : "curves");
  CurveSelection result{group_, {}};
  for (double value : curves_) {
    const int tag = static_cast<int>(std::lround(value));
    if (value != tag) section.fail("numbers of curves are whole, given " + number_text(value), "curves");
    if (std::find(result.tags.begin(), result.tags.end(), tag) != result.tags.end())
      section.fail("curve " + std::to_string(tag) + " is there twice", "curves");
    result.tags.push_back(tag);
  }
  return result;
}

ContourPieces GmshCurveShape::pieces_of(const CadCurve& curve) const {
  std::vector<PlanePoint> points;
  for (const PlanePoint& x : curve.points) points.push_back(placed(x));
  if (curve.kind == CadCurve::Kind::line) return {std::make_shared<LinePiece>(points[0], points[1])};
  if (curve.kind == CadCurve::Kind::circle) return {arc(points)};
  ContourPieces pieces;
  for (PolynomialRun run : curve.runs) {
    run.coefficients[0] = placed(run.coefficients[0]);
    for (std::size_t k = 1; k < run.coefficients.size(); ++k)
      for (double& c : run.coefficients[k]) c *= scale_;
    pieces.push_back(std::make_shared<CurvePiece>(std::make_shared<PolynomialCurve>(std::move(run))));
  }
  return pieces;
}

void GmshCurveShape::check(const Section& section) {
  const std::string extension = std::filesystem::path(file_.name).extension().string();
  if (extension != ".geo" && extension != ".step" && extension != ".stp" && extension != ".brep")
    section.fail("expected a .geo, .step, .stp or .brep file, given '" + short_name(file_.name) + "'", "file");
  const std::string entry = group_.empty() ? "curves" : "physical curve";
  file_.overrides = gmsh_overrides(section, file_.name);
  const auto curves = gmsh_library(position_).read_curves(file_, selection(section), position_);
  const double size = size_of(curves), tolerance = 1e-9 * size;
  std::vector<CadCurve> chain = chained(curves, tolerance, section, entry);
  const PlanePoint first = chain.front().start(), last = chain.back().end();
  const auto on_axis = [&](const PlanePoint& x) { return std::abs(x[0] - origin_[0]) <= tolerance; };
  if (extent_ == ContourExtent::half) {
    if (!on_axis(first) && !on_axis(last))
      section.fail("a half contour starts on its axis, x = " + number_text(origin_[0]) +
                       " of the model; the curves end at (" + number_text(first[0]) + ", " + number_text(first[1]) +
                       ") and (" + number_text(last[0]) + ", " + number_text(last[1]) + ")",
                   entry);
    if (!on_axis(first) || (on_axis(last) && last[1] < first[1])) chain = backwards(chain);
  } else if (signed_area(chain) < 0) {
    chain = backwards(chain);
  }
  for (const CadCurve& curve : chain)
    for (auto& piece : pieces_of(curve)) pieces_.push_back(std::move(piece));
  for (const auto& piece : pieces_)
    if (extent_ == ContourExtent::half)
      for (int i = 0; i <= 8; ++i)
        if (piece->point(piece->length() * i / 8)[0] < -tolerance * scale_)
          section.fail("a half contour has no points left of its axis", entry);
  continue_open_end(pieces_, extent_);
}

}  // namespace mudline
