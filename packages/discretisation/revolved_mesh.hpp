#pragma once

#include "discretisation/sweep.hpp"

namespace mudline {

/// A plane mesh revolved about its y axis, which becomes the z axis of space; x is the distance from the axis. It
/// starts in the x-z plane and turns from x to y. Mid-side nodes lie on circles.
class RevolvedMesh : public MeshSource {
 public:
  void parameters(Parameters& p);
  void check(const Section& section);
  GlobalMesh generate() const override;
  std::vector<std::string> files() const override { return plane_.files(); }

 private:
  Geometry geometry_ = Geometry::space;
  double angle_ = 90;  // [deg]
  int layers_ = 1;
  PlaneMesh plane_;
};

}  // namespace mudline
