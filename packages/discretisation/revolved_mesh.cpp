#include "discretisation/revolved_mesh.hpp"

#include <cmath>

#include "core/pi.hpp"

namespace mudline {

void RevolvedMesh::parameters(Parameters& p) {
  geometry_ = declare_geometry(p);
  plane_.parameters(p);
  p.required("angle", angle_, "deg", {0, 360, true, false},
             "How far it is turned from the x-z plane towards y; 360 joins the ends");
  p.required("layers", layers_, "-", closed(1, 1e5), "Layers of cells around; none may turn by more than 90 degrees");
}

void RevolvedMesh::check(const Section& section) {
  require_space(section, geometry_, "a revolved mesh");
  const int least = static_cast<int>(std::ceil(angle_ / 90 - 1e-9));
  const int needed = angle_ == 360 ? std::max(least, 4) : least;
  if (layers_ < needed)
    section.fail("expected at least " + std::to_string(needed) + ", given " + std::to_string(layers_) +
                     ": a layer that turns by more than 90 degrees has cells that fold",
                 "layers");
  plane_.read(section);
}

GlobalMesh RevolvedMesh::generate() const {
  GlobalMesh plane = plane_.generate(Geometry::axisymmetric);
  double largest = 0;
  for (const Point& x : plane.coordinates) largest = std::max(largest, x[0]);
  Sweep sweep;
  sweep.layers = layers_;
  sweep.closed = angle_ == 360;
  sweep.turned = true;
  for (Point& x : plane.coordinates) {
    sweep.fixed.push_back(x[0] <= 1e-9 * largest);
    if (sweep.fixed.back()) x[0] = 0;
  }
  sweep.wedges = plane_.makes_wedges(plane, sweep.fixed);
  const double step = angle_ / 180 * pi / layers_;
  sweep.place = [&](const Point& x, double layers) {
    const double turn = layers * step;
    return Point{x[0] * std::cos(turn), x[0] * std::sin(turn), x[1]};
  };
  return plane_.at_section([&] { return swept(plane, sweep); });
}

}  // namespace mudline
