#include "discretisation/extruded_mesh.hpp"

#include <cmath>

namespace mudline {

void ExtrudedMesh::parameters(Parameters& p) {
  geometry_ = declare_geometry(p);
  plane_.parameters(p);
  p.choice("along", along_, {{"z", Along::z}, {"y", Along::y}},
           "z: the plane mesh is a plan, drawn upwards; y: it is an upright section, whose y becomes z, drawn across");
  p.required("length", length_, "m", positive(), "How far it is drawn");
  p.add("from", from_, "m", any(), "Coordinate at which it starts");
  p.required("layers", layers_, "-", closed(1, 1e5), "Layers of cells along the way");
  p.add("grading", grading_, "-", positive(), "Size of the last layer over that of the first");
}

void ExtrudedMesh::check(const Section& section) {
  require_space(section, geometry_, "an extruded mesh");
  plane_.read(section);
}

GlobalMesh ExtrudedMesh::generate() const {
  const GlobalMesh plane = plane_.generate(Geometry::plane_strain);
  const double ratio = layers_ > 1 ? std::pow(grading_, 1.0 / (layers_ - 1)) : 1.0;
  std::vector<double> ends{0};
  double size = 1;
  for (int layer = 0; layer < layers_; ++layer, size *= ratio) ends.push_back(ends.back() + size);
  const auto distance = [&](double layers) {
    const int whole = std::min(static_cast<int>(layers), layers_ - 1);
    const double share = layers - whole;
    return from_ + length_ * ((1 - share) * ends[whole] + share * ends[whole + 1]) / ends[layers_];
  };
  Sweep sweep;
  sweep.layers = layers_;
  sweep.turned = along_ == Along::y;
  sweep.fixed.assign(plane.coordinates.size(), 0);
  sweep.wedges = plane_.makes_wedges(plane, sweep.fixed);
  sweep.place = [&](const Point& x, double layers) {
    return along_ == Along::z ? Point{x[0], x[1], distance(layers)} : Point{x[0], distance(layers), x[1]};
  };
  return plane_.at_section([&] { return swept(plane, sweep); });
}

}  // namespace mudline
