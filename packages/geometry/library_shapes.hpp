#pragma once

#include "geometry/contour_shape.hpp"

namespace mudline {

/// Torpedo anchor or free-falling penetrometer: tip, cylindrical shaft, tapered tail. The tip is a cone or a tangent
/// ogive, whose point may be rounded; the top is flat and closed, or continues for ever as a follower.
class TorpedoShape : public ContourShape {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  Contour build() const override;
  double tip_height() const override { return tip_length_; }
  Named named() const override { return Named::of_revolution; }

 private:
  enum class Tip { ogive, cone };
  enum class Top { closed, continuing };
  double diameter_ = 0, length_ = 0, tip_length_ = 0, tip_radius_ = 0, shoulder_radius_ = 0;
  double tail_length_ = 0, tail_diameter_ = 0, top_radius_ = 0;
  Tip tip_ = Tip::ogive;
  Top top_ = Top::closed;
};

/// Rigid strip or plate of some thickness with rounded edges.
class StripShape : public ContourShape {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  Contour build() const override;
  Named named() const override { return Named::across_plane; }

 private:
  double width_ = 0, thickness_ = 0, corner_radius_ = 0;
};

}  // namespace mudline
