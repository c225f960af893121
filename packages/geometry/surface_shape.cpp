#include "geometry/surface_shape.hpp"

#include <algorithm>
#include <cmath>

#include "core/log.hpp"
#include "core/pi.hpp"
#include "core/text.hpp"
#include "core/told.hpp"
#include "geometry/revolved_surface.hpp"
#include "geometry/rounded_box.hpp"
#include "geometry/stl_file.hpp"
#include "geometry/triangulated_surface.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

constexpr double smooth_angle = 10;  // [deg] between facets that may still be samples of a smooth surface

Point to_point(const std::vector<double>& values) { return {values[0], values[1], values[2]}; }

void check_three(const Section& section, const std::string& entry, const std::vector<double>& values) {
  if (values.size() != 3) section.fail("expected 3 numbers (x, y, z), given " + std::to_string(values.size()), entry);
}

}  // namespace

void SurfaceShape::common_parameters(Parameters& p) {
  p.add("position", position_, "m", any(),
        "x, y, z of the shape's origin in the frame of the body, or of the union that it is a part of");
  p.add("rotation", rotation_, "deg", any(),
        "Rotation vector x, y, z: the shape is turned about this direction through its origin, right-handed, by the "
        "length of the vector in degrees");
}

void SurfaceShape::check_placement(const Section& section) const {
  check_three(section, "position", position_);
  check_three(section, "rotation", rotation_);
}

PlacedSurface SurfaceShape::placed() const {
  return {build(), to_point(position_), Rotation::by(pi / 180 * to_point(rotation_))};
}

std::shared_ptr<const Surface> SurfaceShape::surface() const {
  if (length(to_point(position_)) == 0 && length(to_point(rotation_)) == 0) return build();
  return std::make_shared<SurfaceUnion>(std::vector<PlacedSurface>{placed()});
}

void RevolvedShape::parameters(Parameters& p) {
  common_parameters(p);
  p.passes_on("contour", "Half contour (r, z) that is turned around the z axis; 'type' names a contour");
}

void RevolvedShape::check(const Section& section) {
  check_placement(section);
  const Section entry = section.section("contour");
  const auto shape = registries_->contours.create(entry);
  if (shape->named() == ContourShape::Named::across_plane)
    entry.fail("'" + entry.text("type") + "' lies across the plane, and turned around an axis it is another body; a " +
                   "sphere is called so, a disc is a 'flat pile' or a 'polyline', a bar a 'box'",
               "type");
  Contour contour = shape->contour(entry);
  if (contour.extent() != ContourExtent::half)
    entry.fail("the contour of a surface of revolution is a half one, not a full one", "extent");
  surface_ = std::make_shared<RevolvedSurface>(std::move(contour));
  tip_height_ = shape->tip_height();
}

void BoxShape::parameters(Parameters& p) {
  common_parameters(p);
  p.required("length x", lengths_[0], "m", positive(), "Length of the box, whose centre is the shape's origin");
  p.required("length y", lengths_[1], "m", positive(), "Length of the box");
  p.required("length z", lengths_[2], "m", positive(), "Height of the box");
  p.add("fillet radius", fillet_radius_, "m", non_negative(), "Of all edges and corners; 0 is sharp");
}

void BoxShape::check(const Section& section) {
  check_placement(section);
  const double largest = 0.5 * *std::min_element(lengths_.begin(), lengths_.end());
  if (fillet_radius_ > largest)
    section.fail("'fillet radius' = " + number_text(fillet_radius_) + " must not exceed half the shortest length, " +
                     number_text(largest),
                 "fillet radius");
}

std::shared_ptr<const Surface> BoxShape::build() const {
  return std::make_shared<RoundedBox>(lengths_, fillet_radius_);
}

void UnionShape::parameters(Parameters& p) {
  common_parameters(p);
  p.passes_on("parts", "Surfaces by name, which may overlap; each one's 'type' names a surface");
}

void UnionShape::check(const Section& section) {
  check_placement(section);
  const Section entries = section.section("parts");
  entries.allow_parameters({});
  if (entries.section_names().empty()) section.fail("a union needs at least one part", "parts");
  std::vector<PlacedSurface> parts;
  for (const std::string& name : entries.section_names())
    parts.push_back(registries_->surfaces.create(entries.section(name), *registries_)->placed());
  surface_ = std::make_shared<SurfaceUnion>(std::move(parts));
}

void TriangulationShape::parameters(Parameters& p) {
  common_parameters(p);
  p.required_file("file", file_, "STL file (binary or ASCII) of a closed surface");
  p.add("origin", origin_, "-", any(), "Point of the file, in its own unit, that becomes the shape's origin");
  p.add("scale", scale_, "m", positive(), "One unit of the file in metres: 0.001 for a file in millimetres");
}

void TriangulationShape::check(const Section& section) {
  check_placement(section);
  check_three(section, "origin", origin_);
  try {
    SurfaceTriangles triangles = read_stl(file_);
    for (Point& x : triangles.points) x = scale_ * (x - to_point(origin_));
    const auto smooth = std::make_shared<TriangulatedSurface>(triangles);
    const double angle = smooth->largest_angle() * 180 / pi;
    if (angle > smooth_angle)
      log::warn(section.source("file") + ": " + section.path() + "/file: neighbouring facets are at up to " +
                std::to_string(std::lround(angle)) + " degrees to each other, and the smoothed surface is up to " +
                told(smooth->largest_bulge(), "%.2g") + " m away from them: above " + number_text(smooth_angle) +
                " degrees it should have finer facets, and no sharp edges");
    surface_ = smooth;
  } catch (const InputError& error) {
    section.fail(error.what(), "file");
  }
}

void register_surfaces(SurfaceRegistry& registry) {
  registry.add<RevolvedShape>("revolved", "Contour turned around the vertical axis: cone, pile, sphere, torpedo");
  registry.add<BoxShape>("box", "Box with rounded edges: plate, fin, wing");
  registry.add<UnionShape>("union", "Several surfaces that may overlap: a hull with fins");
  registry.add<TriangulationShape>("triangulation", "Closed surface of triangles from an STL file, smoothed");
}

}  // namespace mudline
