#pragma once

#include "contact/body/penalty_side.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// A contact point as numbers of type T, with their derivatives by the point's own unknowns: its position, the area
/// that it stands for, the pore pressure there, and the unknowns of the body.
template <class T, int D>
struct PointNumbers {
  static constexpr int rotations = D == 2 ? 1 : 3;
  static constexpr int of_area = D, of_pressure = D + 1, of_body = D + 2, unknowns = of_body + D + rotations;

  PointNumbers(const BodyInStep& body, const Point& x, double area_, double pore_pressure_)
      : area(unknown<T>(area_, of_area)), pore_pressure(unknown<T>(pore_pressure_, of_pressure)) {
    for (int i = 0; i < D; ++i) from_centre[i] = unknown<T>(x[i] - body.now.centre[i], i);
    for (T& angle : turn) angle = T(0.0);
    const BodyUnknowns& unknowns_of_body = body.unknowns;
    for (int k = 0; k < unknowns_of_body.count; ++k) {
      const T moved = unknowns_of_body.scale[k] * unknown<T>(0.0, of_body + k);
      const int direction = unknowns_of_body.direction[k];
      if (direction < D)
        from_centre[direction] -= moved;
      else
        add_rotation(body, direction - D, moved);
    }
  }
  /// In space the unknowns turn the body about its own axes.
  void add_rotation(const BodyInStep& body, int component, const T& angle) {
    if constexpr (D == 2) {
      turn[0] += angle;
    } else {
      const Point& about = body.turning[component];
      for (int i = 0; i < 3; ++i) turn[i] += angle * about[i];
    }
  }
  Vec<T, D> from_centre;  // [m] from the body's centre
  T turn[rotations];      // [rad] rotation of the body beyond its placement: 0, with derivatives
  T area, pore_pressure;  // [m2], [Pa]
};

template <class T>
Vec<T, 3> numbers(const Point& x) {
  return {T(x[0]), T(x[1]), T(x[2])};
}

/// Position of a point relative to the body, and its motion along the body's surface in a step.
template <class T, int D>
struct BodyProjection;

template <class T>
struct BodyProjection<T, 2> {
  BodyProjection(const BodyPlace& at, const PointNumbers<T, 2>& x) {
    // displacement of the point relative to the material of the body: 0, with derivatives
    const Vec<T, 2> displacement{x.from_centre[0] - value(x.from_centre[0]) + x.turn[0] * value(x.from_centre[1]),
                                 x.from_centre[1] - value(x.from_centre[1]) - x.turn[0] * value(x.from_centre[0])};
    const Vec<T, 2> n = constant<T>(at.normal), m{T(-at.normal[1]), T(at.normal[0])};
    const T along = dot(m, displacement), turned = at.turning[0][0] * along + x.turn[0];
    gap = at.gap + dot(n, displacement);
    advance = at.travel * along;
    normal = n + m * turned;
    tangent = m - n * turned;
  }

  /// Sets the travel since the closest point at the start of the step, and the old shear stress along the surface.
  void start(const BodyInStep&, const ContactStart& start, ContactMotion<T, 2>& motion) const {
    motion.travel = advance + start.contour_distance;
    motion.shear_old = T(start.shear.shear[0]);
  }
  /// Displacement of the point relative to the body along its surface: 0, with derivatives.
  const T& sliding() const { return advance; }
  Vec<T, 2> traction(const T& shear) const { return tangent * shear; }
  /// Moment conjugate to the body's rotation; old_body_moment(): that of the start of the step.
  static const T& body_moment(const T& moment, const BodyPlacement&) { return moment; }
  static T old_body_moment(const Point& moment, const BodyPlacement&) { return T(moment[2]); }
  static Point plain_shear(const T& shear) { return {value(shear), 0, 0}; }

  T gap, advance;  // [m]; advance: of the closest point along the contour, 0 with derivatives
  Vec<T, 2> normal, tangent;
};

template <class T>
struct BodyProjection<T, 3> {
  using Vector = Vec<T, 3>;

  BodyProjection(const BodyPlace& at, const PointNumbers<T, 3>& x) : turn{x.turn[0], x.turn[1], x.turn[2]} {
    const Point plain{value(x.from_centre[0]), value(x.from_centre[1]), value(x.from_centre[2])};
    const Vector n = numbers<T>(at.normal);
    displacement = x.from_centre - rotated(plain);
    gap = at.gap + dot(n, displacement);
    normal = rotated(at.normal);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) normal[i] += at.turning[i][j] * displacement[j];
    projection = x.from_centre - normal * gap;
  }

  /// The travel is the path of the closest point over the body, as a vector in the tangent plane at its end. The old
  /// shear stress rotates with the body and then with the normal.
  void start(const BodyInStep& body, const ContactStart& start, ContactMotion<T, 3>& motion) const {
    const Rotation turned = body.now.turn * body.old.turn.inverse();
    const Vector from = rotated(turned(start.before.normal));
    const Vector displacement = projection - rotated(turned(start.before.point - body.old.centre));
    const Vector sum = from + normal, middle = sum / length(sum);
    motion.travel = transported(displacement - middle * dot(displacement, middle), middle);
    motion.shear_old = transported(rotated(turned(start.shear.shear)), from);
  }
  Vector sliding() const { return displacement - normal * dot(normal, displacement); }
  const Vector& traction(const Vector& shear) const { return shear; }
  /// Moment in the body frame, about whose axes the body's unknowns rotate it; old_body_moment(): that of the start of
  /// the step.
  Vector body_moment(const Vector& moment, const BodyPlacement& placement) const {
    Vector result;
    for (int i = 0; i < 3; ++i) {
      Point axis;
      for (int j = 0; j < 3; ++j) axis[j] = placement.turn.matrix[j][i];
      result[i] = dot(rotated(axis), moment);
    }
    return result;
  }
  static Vector old_body_moment(const Point& moment, const BodyPlacement& placement) {
    return numbers<T>(placement.turn.back(moment));
  }
  static Point plain_shear(const Vector& shear) { return {value(shear[0]), value(shear[1]), value(shear[2])}; }

  T gap;                      // [m]
  Vector normal, projection;  // [-]; [m] from the body's centre

 private:
  /// A vector fixed to the body, with its derivatives by the body's rotation.
  Vector rotated(const Point& x) const { return numbers<T>(x) + cross(turn, numbers<T>(x)); }
  /// A vector perpendicular to `from` after the smallest rotation that takes `from` to the normal.
  Vector transported(const Vector& v, const Vector& from) const {
    const T both = 1.0 + dot(from, normal);
    constexpr double opposite = 1e-6;  // the point has gone round the body: the rotation is not unique
    if (value(both) < opposite) return v - normal * dot(v, normal);
    return v - (from + normal) * (dot(v, normal) / both);
  }
  Vector turn;          // [rad] 0, with derivatives
  Vector displacement;  // [m] of the point relative to the material of the body: 0, with derivatives
};

}  // namespace mudline
