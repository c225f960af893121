#pragma once

#include <memory>

#include "core/registry.hpp"
#include "geometry/contour_shape.hpp"
#include "geometry/surface_union.hpp"

namespace mudline {

class SurfaceShape;
struct SurfaceRegistries;
using SurfaceRegistry = Registry<SurfaceShape, const SurfaceRegistries&>;

/// Registries of the shapes that a surface may name in its own section.
struct SurfaceRegistries {
  const SurfaceRegistry& surfaces;
  const Registry<ContourShape>& contours;
};

/// A shape that a body's "surface" may name: reads its sizes and makes the surface, in a frame whose z axis points up.
/// "position" and "rotation" place that frame in another one, the body's or that of a union. The origin of the
/// outermost frame is the body's reference point.
class SurfaceShape {
 public:
  virtual ~SurfaceShape() = default;
  /// The surface, placed in the other frame.
  std::shared_ptr<const Surface> surface() const;
  PlacedSurface placed() const;
  /// Height [m] in the shape's own frame that separates tip from shaft; 0: all is shaft.
  virtual double tip_height() const { return 0; }

 protected:
  /// Declare and check the parameters that all shapes share.
  void common_parameters(Parameters& p);
  void check_placement(const Section& section) const;
  virtual std::shared_ptr<const Surface> build() const = 0;

 private:
  std::vector<double> position_{0, 0, 0}, rotation_{0, 0, 0};  // [m], [deg]
};

/// A contour turned around the z axis.
class RevolvedShape : public SurfaceShape {
 public:
  RevolvedShape() = default;
  explicit RevolvedShape(const SurfaceRegistries& registries) : registries_(&registries) {}
  void parameters(Parameters& p);
  void check(const Section& section);
  double tip_height() const override { return tip_height_; }

 protected:
  std::shared_ptr<const Surface> build() const override { return surface_; }

 private:
  const SurfaceRegistries* registries_ = nullptr;  // documenting: none
  std::shared_ptr<const Surface> surface_;
  double tip_height_ = 0;
};

/// A box with rounded edges, its centre at the origin.
class BoxShape : public SurfaceShape {
 public:
  BoxShape() = default;
  explicit BoxShape(const SurfaceRegistries&) {}
  void parameters(Parameters& p);
  void check(const Section& section);

 protected:
  std::shared_ptr<const Surface> build() const override;

 private:
  Point lengths_{};
  double fillet_radius_ = 0;
};

/// Several surfaces that together make the body.
class UnionShape : public SurfaceShape {
 public:
  UnionShape() = default;
  explicit UnionShape(const SurfaceRegistries& registries) : registries_(&registries) {}
  void parameters(Parameters& p);
  void check(const Section& section);

 protected:
  std::shared_ptr<const Surface> build() const override { return surface_; }

 private:
  const SurfaceRegistries* registries_ = nullptr;  // documenting: none
  std::shared_ptr<const Surface> surface_;
};

/// A closed surface of triangles from a file, smoothed. Warns of angles between facets that are too large for that.
class TriangulationShape : public SurfaceShape {
 public:
  TriangulationShape() = default;
  explicit TriangulationShape(const SurfaceRegistries&) {}
  void parameters(Parameters& p);
  /// Reads the file.
  void check(const Section& section);

 protected:
  std::shared_ptr<const Surface> build() const override { return surface_; }

 private:
  std::string file_;
  std::vector<double> origin_{0, 0, 0};  // in the file's unit
  double scale_ = 1;                     // [m] per unit of the file
  std::shared_ptr<const Surface> surface_;
};

void register_surfaces(SurfaceRegistry& registry);

}  // namespace mudline
