#include "geometry/contour_shape.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/pi.hpp"
#include "core/told.hpp"
#include "discretisation/gmsh_library.hpp"
#include "geometry/gmsh_curve_shape.hpp"
#include "geometry/library_shapes.hpp"
#include "geometry/path_shape.hpp"

namespace mudline {

namespace {

constexpr double default_shaft = 10;  // diameters; the contour continues anyway, this is only what pictures show

std::string number(double value) { return told(value, "%.6g"); }

}  // namespace

void ContourShape::common_parameters(Parameters& p) {
  p.choice(
      "extent", extent_, {{"half", ContourExtent::half}, {"full", ContourExtent::full}},
      "half: the body is symmetric about its axis and only x >= 0 exists (axisymmetry, or plane strain with a plane of "
      "symmetry); full: both sides, plane strain only");
  p.choice("approximation", approximation_,
           {{"exact", Approximation::exact}, {"facets", Approximation::facets}, {"bezier", Approximation::bezier}},
           "facets: chords instead of the curved parts; bezier: smooth cubic curves through the chords' ends");
  p.add("chord length", chord_length_, "m", non_negative(), "Longest chord of an approximation");
}

Contour ContourShape::contour(const Section& section) const {
  Contour exact = build();
  const std::string fault = contour_fault(exact);
  if (!fault.empty()) section.fail(fault);
  if (approximation_ == Approximation::exact) {
    if (chord_length_ > 0) section.fail("the exact contour has no chords: it takes no 'chord length'", "chord length");
    return exact;
  }
  if (chord_length_ == 0) section.fail("an approximation needs a 'chord length' greater than 0", "approximation");
  return approximated(exact, approximation_, chord_length_);
}

Contour ContourShape::complete(Contour half) const { return extent_ == ContourExtent::half ? half : half.mirrored(); }

void ConeShape::parameters(Parameters& p) {
  common_parameters(p);
  p.required("diameter", diameter_, "m", positive(), "Diameter of the shaft");
  fillet_parameters(p);
}

ConePenetrometerShape::ConePenetrometerShape() { diameter_ = 0.0357; }

void ConePenetrometerShape::parameters(Parameters& p) {
  common_parameters(p);
  p.add("diameter", diameter_, "m", positive(), "Diameter of the rod");
  fillet_parameters(p);
}

void ConeShape::fillet_parameters(Parameters& p) {
  p.add("apex angle [deg]", apex_angle_, "deg", Range{0, 180, true, false},
        "Full opening angle of the cone; 180 is flat");
  p.add("tip radius", tip_radius_, "m", non_negative(), "Fillet of the apex, tangent to both flanks; 0 is sharp");
  p.add("shoulder radius", shoulder_radius_, "m", non_negative(), "Fillet between flank and shaft; 0 is sharp");
  p.add("shaft length", shaft_length_, "m", non_negative(),
        "Drawn length of the shaft above the shoulder, 0: ten diameters; contact takes the shaft as endless");
}

std::vector<PlanePoint> ConeShape::corners() const {
  const double radius = 0.5 * diameter_;
  const double shoulder = apex_angle_ < 180 ? radius / std::tan(apex_angle_ * pi / 360) : 0.0;
  const double shaft = shaft_length_ > 0 ? shaft_length_ : default_shaft * diameter_;
  return {{0, 0}, {radius, shoulder}, {radius, shoulder + shaft}};
}

void ConeShape::check(const Section& section) {
  const auto points = corners();
  const double flank = std::hypot(points[1][0], points[1][1]);
  const double half = apex_angle_ * pi / 360;
  const double at_tip = apex_angle_ < 180 ? tip_radius_ / std::tan(half) : 0.0;
  const double at_shoulder = shoulder_radius_ * std::tan(0.5 * half);
  if (at_tip > flank)
    section.fail("'tip radius' = " + number(tip_radius_) + " is too large: its fillet takes " + number(at_tip) +
                     " m of the " + number(flank) + " m long flank",
                 "tip radius");
  if (at_tip + at_shoulder > flank)
    section.fail("'shoulder radius' = " + number(shoulder_radius_) + " is too large: its fillet takes " +
                     number(at_shoulder) + " m of the " + number(flank - at_tip) + " m of flank that are left",
                 "shoulder radius");
  if (overfull_line(points, {tip_radius_, shoulder_radius_, 0}, ContourExtent::half) >= 0)
    section.fail("'shaft length' = " + number(shaft_length_) + " is too short: the shoulder's fillet takes " +
                     number(at_shoulder) + " m of it",
                 "shaft length");
}

double ConeShape::tip_height() const {
  // where the shoulder's fillet meets the shaft
  const double half = apex_angle_ * pi / 360, at_shoulder = shoulder_radius_ * std::tan(0.5 * half);
  const double tip = apex_angle_ < 180 ? tip_radius_ * (1 / std::sin(half) - 1) : 0.0;
  return std::max(corners()[1][1] - tip + at_shoulder, 1e-9 * diameter_);
}

Contour ConeShape::build() const {
  auto points = corners();
  const double half = apex_angle_ * pi / 360;
  const double tip = apex_angle_ < 180 ? tip_radius_ * (1 / std::sin(half) - 1) : 0.0;
  for (auto& point : points) point[1] -= tip;
  return complete(rounded_polygon(points, {tip_radius_, shoulder_radius_, 0}, ContourExtent::half));
}

void FlatPileShape::parameters(Parameters& p) {
  common_parameters(p);
  p.required("diameter", diameter_, "m", positive(), "Diameter of the pile, width of the wall");
  p.add("corner radius", corner_radius_, "m", non_negative(), "Fillet between base and shaft; 0 is sharp");
  p.add("shaft length", shaft_length_, "m", non_negative(),
        "Drawn length of the shaft above the base, 0: ten diameters; contact takes the shaft as endless");
}

std::vector<PlanePoint> FlatPileShape::corners() const {
  const double shaft = shaft_length_ > 0 ? shaft_length_ : default_shaft * diameter_;
  return {{0, 0}, {0.5 * diameter_, 0}, {0.5 * diameter_, shaft}};
}

void FlatPileShape::check(const Section& section) {
  const int line = overfull_line(corners(), {0, corner_radius_, 0}, ContourExtent::half);
  if (line == 0)
    section.fail("'corner radius' = " + number(corner_radius_) + " must not exceed half the diameter, " +
                     number(0.5 * diameter_),
                 "corner radius");
  if (line == 1)
    section.fail("'shaft length' = " + number(shaft_length_) + " must not be less than the corner radius, " +
                     number(corner_radius_),
                 "shaft length");
}

Contour FlatPileShape::build() const {
  return complete(rounded_polygon(corners(), {0, corner_radius_, 0}, ContourExtent::half));
}

void SphereShape::parameters(Parameters& p) {
  common_parameters(p);
  p.required("diameter", diameter_, "m", positive(),
             "Diameter of the sphere, or of the cylinder that lies in plane strain");
}

Contour SphereShape::build() const {
  const double radius = 0.5 * diameter_;
  std::vector<std::shared_ptr<const ContourPiece>> arc{
      std::make_shared<ArcPiece>(PlanePoint{0, radius}, radius, -0.5 * pi, pi)};
  return complete(Contour(std::move(arc), ContourExtent::half));
}

void PolylineShape::parameters(Parameters& p) {
  common_parameters(p);
  p.required("x", x_, "m", any(), "Horizontal coordinates of the corners, relative to the body's position");
  p.required("y", y_, "m", any(), "Vertical coordinates of the corners, the body on the left of the path");
  p.add("fillet radii", fillet_radii_, "m", non_negative(), "Radius at every corner, 0 is sharp; left out: all sharp");
}

std::vector<PlanePoint> PolylineShape::points() const {
  std::vector<PlanePoint> result;
  for (std::size_t i = 0; i < x_.size(); ++i) result.push_back({x_[i], y_[i]});
  return result;
}

std::vector<double> PolylineShape::radii() const {
  return fillet_radii_.empty() ? std::vector<double>(x_.size(), 0.0) : fillet_radii_;
}

void PolylineShape::check(const Section& section) {
  const std::size_t n = x_.size();
  const bool half = extent_ == ContourExtent::half;
  if (n < 2) section.fail("a contour needs at least 2 points", "x");
  if (y_.size() != n)
    section.fail("'y' has " + std::to_string(y_.size()) + " values, 'x' has " + std::to_string(n), "y");
  if (!fillet_radii_.empty() && fillet_radii_.size() != n)
    section.fail(
        "'fillet radii' has " + std::to_string(fillet_radii_.size()) + " values for " + std::to_string(n) + " points",
        "fillet radii");
  for (std::size_t i = 1; i < n; ++i)
    if (x_[i] == x_[i - 1] && y_[i] == y_[i - 1])
      section.fail("points " + std::to_string(i) + " and " + std::to_string(i + 1) + " are the same", "x");
  if (half && x_[0] != 0)
    section.fail("a half contour starts on its axis: the first x must be 0, given " + number(x_[0]), "x");
  if (half && *std::min_element(x_.begin(), x_.end()) < 0) section.fail("a half contour has no x < 0", "x");
  if (half && n > 1 && x_[1] == 0)
    section.fail("the first line of a half contour must leave the axis: the second x must be > 0", "x");
  if (!fillet_radii_.empty() && (fillet_radii_.back() != 0 || (!half && fillet_radii_.front() != 0)))
    section.fail(
        std::string("the ") + (half ? "last point" : "first and the last point") + " of the contour cannot be rounded",
        "fillet radii");
  const int line = overfull_line(points(), radii(), extent_);
  if (line >= 0)
    section.fail("the 'fillet radii' at points " + std::to_string(line + 1) + " and " + std::to_string(line + 2) +
                     " are too large for the " + number(std::hypot(x_[line + 1] - x_[line], y_[line + 1] - y_[line])) +
                     " m between them",
                 "fillet radii");
}

Contour PolylineShape::build() const { return rounded_polygon(points(), radii(), extent_); }

void register_contours(Registry<ContourShape>& registry) {
  registry.add<ConeShape>("cone", "Cone on a cylindrical shaft, apex and shoulder rounded on demand");
  registry.add<FlatPileShape>("flat pile", "Flat-ended cylinder or wall with a rounded edge");
  registry.add<SphereShape>("sphere", "Sphere; in plane strain a cylinder lying across the plane");
  registry.add<ConePenetrometerShape>("cone penetrometer", "60-degree cone of 10 cm2 on its rod");
  registry.add<TorpedoShape>("torpedo", "Torpedo anchor: conical or ogival tip, shaft, tapered tail");
  registry.add<CylinderShape>("cylinder", "Cylinder lying across the plane: T-bar, pipeline; in axisymmetry a sphere");
  registry.add<StripShape>("strip", "Rigid strip or plate with rounded edges");
  registry.add<PathShape>("path", "Lines, arcs, Bezier, Hermite and NURBS curves, piece after piece");
  registry.add<GmshCurveShape>("gmsh curve", std::string("Curves of a Gmsh geometry or a CAD model") +
                                                 (has_gmsh() ? "" : "; not in this build"));
  registry.add<PolylineShape>("polyline", "Straight lines through given points with rounded corners");
}

}  // namespace mudline
