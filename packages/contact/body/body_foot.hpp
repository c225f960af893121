#pragma once

#include "contact/body/penalty_side.hpp"
#include "tensor/vec.hpp"

namespace mudline {

/// A contact point as numbers of kind T, with their derivatives by the point's own unknowns: its place, the area that
/// it stands for, the pore pressure there, and those of the body.
template <class T, int D>
struct PointNumbers {
  static constexpr int rotations = D == 2 ? 1 : 3;
  static constexpr int of_area = D, of_pressure = D + 1, of_body = D + 2, unknowns = of_body + D + rotations;

  PointNumbers(const BodyInStep& body, const Point& x, double area_, double pore_pressure_)
      : area(unknown<T>(area_, of_area)), pore_pressure(unknown<T>(pore_pressure_, of_pressure)) {
    for (int i = 0; i < D; ++i) arm[i] = unknown<T>(x[i] - body.now.centre[i], i);
    for (T& angle : turn) angle = T(0.0);
    const BodyUnknowns& unknowns_of_body = body.unknowns;
    for (int k = 0; k < unknowns_of_body.count; ++k) {
      const T moved = unknowns_of_body.scale[k] * unknown<T>(0.0, of_body + k);
      const int direction = unknowns_of_body.direction[k];
      if (direction < D)
        arm[direction] -= moved;
      else
        turn_by(body, direction - D, moved);
    }
  }
  /// In space the unknowns turn the body about its own axes.
  void turn_by(const BodyInStep& body, int component, const T& angle) {
    if constexpr (D == 2) {
      turn[0] += angle;
    } else {
      const Point& about = body.turning[component];
      for (int i = 0; i < 3; ++i) turn[i] += angle * about[i];
    }
  }
  Vec<T, D> arm;          // [m] from the body's centre
  T turn[rotations];      // [rad] of the body beyond its placement: 0, with derivatives
  T area, pore_pressure;  // [m2], [Pa]
};

template <class T>
Vec<T, 3> numbers(const Point& x) {
  return {T(x[0]), T(x[1]), T(x[2])};
}

/// Where a point is beside the body, and what the motion over a step means along its surface.
template <class T, int D>
struct BodyFoot;

template <class T>
struct BodyFoot<T, 2> {
  BodyFoot(const BodyPlace& at, const PointNumbers<T, 2>& x) {
    // how the point moves past the material of the body: 0, with derivatives
    const Vec<T, 2> way{x.arm[0] - value(x.arm[0]) + x.turn[0] * value(x.arm[1]),
                        x.arm[1] - value(x.arm[1]) - x.turn[0] * value(x.arm[0])};
    const Vec<T, 2> n = constant<T>(at.normal), m{T(-at.normal[1]), T(at.normal[0])};
    const T along = dot(m, way), turned = at.turning[0][0] * along + x.turn[0];
    gap = at.gap + dot(n, way);
    advance = at.travel * along;
    normal = n + m * turned;
    tangent = m - n * turned;
  }

  /// Travel and old shear stress along the surface, from the foot at the start of the step.
  void start(const BodyInStep&, const ContactStart& start, ContactMotion<T, 2>& motion) const {
    motion.travel = advance + start.travelled;
    motion.shear_old = T(start.shear.shear[0]);
  }
  /// The point's way past the body along its surface: 0, with derivatives.
  const T& sliding() const { return advance; }
  Vec<T, 2> traction(const T& shear) const { return tangent * shear; }
  /// A moment as the body's rotation feels it, and one of the start of the step.
  static const T& felt(const T& moment, const BodyPlacement&) { return moment; }
  static T felt_before(const Point& moment, const BodyPlacement&) { return T(moment[2]); }
  static Point plain_shear(const T& shear) { return {value(shear), 0, 0}; }

  T gap, advance;  // [m]; of the foot along the contour: 0, with derivatives
  Vec<T, 2> normal, tangent;
};

template <class T>
struct BodyFoot<T, 3> {
  using Vector = Vec<T, 3>;

  BodyFoot(const BodyPlace& at, const PointNumbers<T, 3>& x) : turn{x.turn[0], x.turn[1], x.turn[2]} {
    const Point plain{value(x.arm[0]), value(x.arm[1]), value(x.arm[2])};
    const Vector n = numbers<T>(at.normal);
    way = x.arm - turned_on(plain);
    gap = at.gap + dot(n, way);
    normal = turned_on(at.normal);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) normal[i] += at.turning[i][j] * way[j];
    foot = x.arm - normal * gap;
  }

  /// The travel is the way of the foot over the body, as a vector of the tangent plane at its end; the old shear stress
  /// turns with the body and then with the normal.
  void start(const BodyInStep& body, const ContactStart& start, ContactMotion<T, 3>& motion) const {
    const Rotation turned = body.now.turn * body.old.turn.inverse();
    const Vector from = turned_on(turned(start.before.normal));
    const Vector way = foot - turned_on(turned(start.before.foot - body.old.centre));
    const Vector sum = from + normal, middle = sum / length(sum);
    motion.travel = transported(way - middle * dot(way, middle), middle);
    motion.shear_old = transported(turned_on(turned(start.shear.shear)), from);
  }
  Vector sliding() const { return way - normal * dot(normal, way); }
  const Vector& traction(const Vector& shear) const { return shear; }
  /// A moment along the body's axes, which its rotations are about, and one of the start of the step.
  Vector felt(const Vector& moment, const BodyPlacement& placement) const {
    Vector result;
    for (int i = 0; i < 3; ++i) {
      Point axis;
      for (int j = 0; j < 3; ++j) axis[j] = placement.turn.matrix[j][i];
      result[i] = dot(turned_on(axis), moment);
    }
    return result;
  }
  static Vector felt_before(const Point& moment, const BodyPlacement& placement) {
    return numbers<T>(placement.turn.back(moment));
  }
  static Point plain_shear(const Vector& shear) { return {value(shear[0]), value(shear[1]), value(shear[2])}; }

  T gap;                // [m]
  Vector normal, foot;  // [-]; [m] from the body's centre

 private:
  /// A vector fixed to the body, with the derivatives of its turning.
  Vector turned_on(const Point& x) const { return numbers<T>(x) + cross(turn, numbers<T>(x)); }
  /// A vector of the plane across `from` after the rotation that takes `from` to the normal.
  Vector transported(const Vector& v, const Vector& from) const {
    const T both = 1.0 + dot(from, normal);
    constexpr double opposite = 1e-6;  // the point has gone round the body: there is no such rotation
    if (value(both) < opposite) return v - normal * dot(v, normal);
    return v - (from + normal) * (dot(v, normal) / both);
  }
  Vector turn;  // [rad] 0, with derivatives
  Vector way;   // [m] of the point past the material of the body: 0, with derivatives
};

}  // namespace mudline
