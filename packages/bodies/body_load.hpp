#pragma once

#include "bodies/body_numbers.hpp"
#include "bodies/contour_volume.hpp"
#include "core/parameters.hpp"
#include "tensor/mat.hpp"

namespace mudline {

/// Directions of a body's freedom: the axes, then the rotations. In the plane x, y, rotation (counter-clockwise); in
/// space x, y, z, and the rotations about the body's own axes, which are those of the model at the start of a body that
/// has no 'rotation'.
inline int num_directions(Geometry geometry) { return dimension(geometry) == 2 ? 3 : 6; }
/// As decks name it.
const char* direction_name(int dimension, int direction);
/// The axis about which it turns: z in the plane.
inline int axis_of_rotation(int dimension, int direction) { return dimension == 2 ? 2 : direction - dimension; }
/// Whether a body may move so at all: a body of revolution only along its axis.
inline bool may_move(Geometry geometry, int direction) { return geometry != Geometry::axisymmetric || direction == 1; }

/// What the loads on a body depend on, besides its motion. Axisymmetric: of the whole body; plane strain: per metre of
/// depth, and of the modelled half where the contour is a half one.
struct BodyProperties {
  double mass = 0;               // [kg]
  double moment_of_inertia = 0;  // [kg m2] in the plane, about the centre of mass
  Mat<double, 3> inertia = {};   // [kg m2] in space, about the centre of mass, along the body's axes
  double volume = 0;             // [m3]; 0: unknown
  Geometry geometry = Geometry::plane_strain;
  const ContourVolume* enclosed = nullptr;  // in the plane
  Point centre{};                           // [m] of mass, in the body's frame
  Point middle{};                           // [m] of the volume, from the centre of mass; the same where it is unknown
  double frontal_area = 0;                  // [m2] in the plane: largest section across the vertical, at the start
  bool turned = false;                      // it has a rotation at the start
  Point frontal_areas{};                    // [m2] in space: of the surface seen along the body's axes; 0: unknown
};

/// Where a body is and how it moves when its loads are asked.
struct BodyInstant {
  double time = 0;
  BodyVector position = BodyVector::zero();  // [m] of the reference point
  BodyVector velocity = BodyVector::zero();  // [m/s] of the centre of mass
  BodyVector spin = BodyVector::zero();      // [rad/s] about the body's axes
  BodyAxes axes;
};

/// Force [N] and moment about the centre of mass [N m] on a body, along the axes of the model.
struct BodyLoad {
  BodyVector force = BodyVector::zero(), moment = BodyVector::zero();
  /// At a point of the body, given from its centre of mass along the axes of the model.
  void add(const BodyVector& more, const BodyVector& arm) {
    force = force + more;
    moment = moment + cross(arm, more);
  }
};

/// The part that acts in a direction of the model's axes.
inline const BodyNumber& along(const BodyLoad& load, int dimension, int direction) {
  return direction < dimension ? load.force[direction] : load.moment[axis_of_rotation(dimension, direction)];
}

/// f at a time and a place.
BodyNumber at(const Function& f, double time, const BodyVector& x, int dimension);

/// The water that a body moves along, along the body's axes.
struct AddedMass {
  Point mass{}, inertia{};  // [kg]; [kg m2], in space
};

/// A force that acts at a point of the body: an eye, a line.
struct PointLoad {
  void parameters(Parameters& p);
  Point point{};  // [m] in the body's frame
  Function force[3], moment[3];
  bool turns = false;  // with the body
};

}  // namespace mudline
