#include "geometry/library_shapes.hpp"

#include <algorithm>
#include <cmath>

#include "core/pi.hpp"
#include "geometry/curve_piece.hpp"

namespace mudline {

void TorpedoShape::parameters(Parameters& p) {
  common_parameters(p);
  p.required("diameter", diameter_, "m", positive(), "Diameter of the shaft");
  p.required("length", length_, "m", positive(), "From the tip to the top");
  p.required("tip length", tip_length_, "m", positive(), "Height of the tip, from its point to the shaft");
  p.choice("tip", tip_, {{"ogive", Tip::ogive}, {"cone", Tip::cone}},
           "ogive: an arc tangent to the shaft; cone: a straight flank");
  p.add("tip radius", tip_radius_, "m", non_negative(), "Cone: fillet of the apex; 0 is sharp");
  p.add("shoulder radius", shoulder_radius_, "m", non_negative(), "Cone: fillet between flank and shaft; 0 is sharp");
  p.add("tail length", tail_length_, "m", non_negative(),
        "Height over which the shaft tapers to the tail's diameter; 0: no taper");
  p.add("tail diameter", tail_diameter_, "m", non_negative(), "Diameter of the top; 0: that of the shaft");
  p.add("top radius", top_radius_, "m", non_negative(), "Fillet of the closed top's edge; 0 is sharp");
  p.choice("top", top_, {{"closed", Top::closed}, {"continuing", Top::continuing}},
           "closed: a flat top; continuing: a follower of the tail's diameter");
}

void TorpedoShape::check(const Section& section) {
  const double radius = 0.5 * diameter_;
  if (tail_diameter_ == 0) tail_diameter_ = diameter_;
  if (tip_length_ + tail_length_ > length_) section.fail("tip and tail are longer than the body", "length");
  if (tip_ == Tip::ogive && tip_length_ < radius)
    section.fail("an ogive that is tangent to the shaft is at least as high as half its diameter", "tip length");
  if (tip_ == Tip::ogive && (tip_radius_ > 0 || shoulder_radius_ > 0))
    section.fail("only a cone has a fillet at its apex and shoulder",
                 tip_radius_ > 0 ? "tip radius" : "shoulder radius");
  if (tail_length_ == 0 && tail_diameter_ != diameter_) section.fail("a taper needs a 'tail length'", "tail diameter");
  if (tail_length_ > 0 && tip_length_ + tail_length_ == length_)
    section.fail("there is no shaft between tip and tail", "length");
  if (top_ == Top::continuing && top_radius_ > 0) section.fail("a continuing top has no edge", "top radius");
  if (top_radius_ > 0.5 * tail_diameter_) section.fail("the fillet is larger than the top", "top radius");
}

Contour TorpedoShape::build() const {
  const double radius = 0.5 * diameter_, tail = 0.5 * tail_diameter_;
  std::vector<PlanePoint> points;
  std::vector<double> fillets;
  const bool cone = tip_ == Tip::cone;
  if (cone) {
    // the rounded tip stands on the reference point
    const double half = std::atan2(radius, tip_length_);
    points = {{0, -tip_radius_ * (1 / std::sin(half) - 1)}};
    fillets = {tip_radius_};
  }
  points.push_back({radius, tip_length_});
  fillets.push_back(cone ? shoulder_radius_ : 0.0);
  if (tail_length_ > 0) {
    points.push_back({radius, length_ - tail_length_});
    fillets.push_back(0);
  }
  points.push_back({tail, length_});
  fillets.push_back(top_ == Top::closed ? top_radius_ : 0.0);
  if (top_ == Top::closed)
    points.push_back({0, length_});
  else
    points.push_back({tail, length_ + diameter_});
  fillets.push_back(0);
  if (cone) return complete(rounded_polygon(points, fillets, ContourExtent::half));
  // rounded_polygon() starts on the axis: the ogive is put before the polygon of the rest, which begins at a sharp
  // corner
  const double ogive = (radius * radius + tip_length_ * tip_length_) / (2 * radius);
  const PlanePoint centre{radius - ogive, tip_length_};
  const double from = std::atan2(-tip_length_, ogive - radius);
  ContourPieces pieces{std::make_shared<ArcPiece>(centre, ogive, from, -from)};
  points.insert(points.begin(), PlanePoint{0, tip_length_});
  fillets.insert(fillets.begin(), 0.0);
  const Contour rest = rounded_polygon(points, fillets, ContourExtent::half);
  pieces.insert(pieces.end(), rest.pieces().begin() + 1, rest.pieces().end());
  return complete(Contour(std::move(pieces), ContourExtent::half));
}

void StripShape::parameters(Parameters& p) {
  common_parameters(p);
  p.required("width", width_, "m", positive(), "Width of the base");
  p.required("thickness", thickness_, "m", positive(), "Height of the strip");
  p.add("corner radius", corner_radius_, "m", non_negative(), "Fillet of the edges; 0 is sharp");
}

void StripShape::check(const Section& section) {
  if (corner_radius_ > 0.5 * std::min(width_, thickness_))
    section.fail("the fillet must not exceed half the width and half the thickness", "corner radius");
}

Contour StripShape::build() const {
  const double half = 0.5 * width_;
  return complete(rounded_polygon({{0, 0}, {half, 0}, {half, thickness_}, {0, thickness_}},
                                  {0, corner_radius_, corner_radius_, 0}, ContourExtent::half));
}

}  // namespace mudline
