#include "contact/faces/face_point.hpp"

#include <algorithm>
#include <cmath>

#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// Point and unit normal of a face at xi, with their derivatives by xi.
struct FaceMap {
  FaceMap(const MasterFace& face, const double (&xi)[2]) {
    evaluate_shape(face.shape, xi, N, dN);
    Point sum{}, slope[2] = {};
    for (int a = 0; a < face.count; ++a) {
      x += N[a] * face.x[a];
      sum += N[a] * face.normal[a];
      for (int k = 0; k < 2; ++k) {
        along[k] += dN[2 * a + k] * face.x[a];
        slope[k] += dN[2 * a + k] * face.normal[a];
      }
    }
    const double size = length(sum);
    normal = 1 / size * sum;
    for (int k = 0; k < 2; ++k) turning[k] = 1 / size * (slope[k] - dot(normal, slope[k]) * normal);
  }
  /// d(y + gap n) / d(xi, gap): two columns; the third one is the normal.
  Point column(int k, double gap) const { return along[k] + gap * turning[k]; }
  double N[max_side_nodes], dN[2 * max_side_nodes];
  Point x{}, normal{}, along[2] = {}, turning[2] = {};
};

/// Rows of the inverse of the matrix whose columns are a, b and c; false where there is none.
bool inverse(const Point& a, const Point& b, const Point& c, Point (&row)[3]) {
  row[0] = cross(b, c);
  row[1] = cross(c, a);
  row[2] = cross(a, b);
  const double volume = dot(a, row[0]);
  if (!(std::abs(volume) > 1e-12 * length(a) * length(b) * length(c))) return false;
  for (Point& r : row) r = 1 / volume * r;
  return true;
}

bool inside(CellShape shape, const double (&xi)[2]) {
  constexpr double rounding = 1e-9;  // neighbours both see what is on their edge
  if (is_simplex(shape)) return xi[0] >= -rounding && xi[1] >= -rounding && xi[0] + xi[1] <= 1 + rounding;
  return std::max(std::abs(xi[0]), std::abs(xi[1])) <= 1 + rounding;
}

using Direction = Dual<3>;  // derivatives by d

/// Turns derivatives by xi and the gap into derivatives by d.
template <class T>
T number(double value, const Point (&row)[3], double by_first, double by_second, double by_gap = 0) {
  T result(value);
  if constexpr (!std::is_same_v<T, double>)
    for (int i = 0; i < 3; ++i) result.d[i] = by_first * row[0][i] + by_second * row[1][i] + by_gap * row[2][i];
  return result;
}

template <class T>
using Vector = Vec<T, 3>;
template <class T>
Vector<T> vector(const Point& value, const Point (&row)[3], const Point& by_first, const Point& by_second) {
  Vector<T> result;
  for (int i = 0; i < 3; ++i) result[i] = number<T>(value[i], row, by_first[i], by_second[i]);
  return result;
}
template <class T>
Vector<T> constant_vector(const Point& x) {
  return {T(x[0]), T(x[1]), T(x[2])};
}
Point plain(const Vector<Direction>& a) { return {a[0].v, a[1].v, a[2].v}; }
Point plain(const Vector<double>& a) { return {a[0], a[1], a[2]}; }

/// The part of the point's geometry that depends on d.
template <class T>
struct ProjectionPlace {
  T gap, weight[max_side_nodes];
  Vector<T> normal,
      projection_old;  // projection_old: position of the closest point's material at the start of the step
};

template <class T>
ProjectionPlace<T> place(const FacePoint& point, const FaceMap& map) {
  Point row[3] = {}, was{}, was_along[2] = {};
  if constexpr (!std::is_same_v<T, double>)
    inverse(map.column(0, point.projection.gap), map.column(1, point.projection.gap), map.normal, row);
  for (int a = 0; a < point.face.count; ++a) {
    was += map.N[a] * point.x_old[a];
    for (int k = 0; k < 2; ++k) was_along[k] += map.dN[2 * a + k] * point.x_old[a];
  }
  ProjectionPlace<T> g;
  g.gap = number<T>(point.projection.gap, row, 0, 0, 1);
  g.normal = vector<T>(map.normal, row, map.turning[0], map.turning[1]);
  g.projection_old = vector<T>(was, row, was_along[0], was_along[1]);
  for (int a = 0; a < point.face.count; ++a) g.weight[a] = number<T>(map.N[a], row, map.dN[2 * a], map.dN[2 * a + 1]);
  return g;
}

/// A vector perpendicular to `from` after the smallest rotation that takes `from` to `to`; both are unit vectors.
template <class T>
Vector<T> transported(const Point& v, const Point& from, const Vector<T>& to) {
  const Vector<T> old = constant_vector<T>(from), shear = constant_vector<T>(v);
  const T both = 1.0 + dot(old, to), part = dot(shear, to);
  constexpr double opposite = 1e-6;
  if (value(both) < opposite) return shear - to * part;
  return shear - (old + to) * (part / both);
}

template <class T>
ContactMotion<T, 3> motion_of(const FacePoint& point, const ProjectionPlace<T>& g) {
  ContactMotion<T, 3> motion;
  motion.gap = g.gap;
  motion.gap_old = T(point.gap_old);
  motion.force_old = T(point.force_old);
  motion.area = T(point.area);
  motion.soil = point.soil;
  motion.pore_pressure = T(point.soil.pore_pressure);
  motion.position = point.slave_old;
  if (!point.law.friction) return motion;
  const Vector<T> apart_old = constant_vector<T>(point.slave_old) - g.projection_old,
                  displacement = g.normal * g.gap - apart_old;
  motion.travel = displacement - g.normal * dot(displacement, g.normal);
  motion.opened = dot(apart_old, g.normal);
  motion.shear_old = transported(point.shear_old, point.normal_old, g.normal);
  motion.slip_old = point.slip_old;
  motion.slid = point.slid;
  return motion;
}

template <class T>
void evaluate(const FacePoint& point, FaceForce& out) {
  const FaceMap map(point.face, point.projection.xi);
  const ProjectionPlace<T> g = place<T>(point, map);
  const ContactResponse<T, 3> now = respond(point.law, motion_of(point, g));
  const double weight = 1 / (1 - point.law.start_weight);
  const T share = now.end_share * weight;
  Vector<T> force = Vector<T>::zero(), damping = force;
  if (now.presses) force = (g.normal * now.pressure + now.shear) * point.area;
  if (point.law.viscous > 0) damping = g.normal * now.damping;
  const Vector<T> acting = force * share + damping * weight;
  out.presses = now.presses;
  out.slides = now.slides;
  out.force = plain(force);
  out.damping = plain(damping);
  out.acting = plain(acting);
  out.start_share = value(now.start_share);
  if (now.presses) out.share = value(share);
  out.pressure = value(now.pressure);
  out.shear = plain(now.shear);
  out.normal = map.normal;
  out.slip = now.slip;
  out.heat = now.heat;
  out.damped = now.damping_heat;
  for (int a = 0; a < point.face.count; ++a) out.weight[a] = value(g.weight[a]);
  if constexpr (!std::is_same_v<T, double>) {
    for (int i = 0; i < 3; ++i) std::copy_n(acting[i].d, 3, out.acting_slope[i]);
    for (int a = 0; a < point.face.count; ++a) std::copy_n(g.weight[a].d, 3, out.weight_slope[a]);
    std::copy_n(now.start_share.d, 3, out.start_share_slope);
  }
}

}  // namespace

bool find_projection(const MasterFace& face, const Point& at, FaceProjection& projection) {
  const double middle = is_simplex(face.shape) ? 1.0 / 3 : 0.0;
  projection = {{middle, middle}, 0};
  constexpr int most = 30;
  constexpr double far = 4, near = 1e-10;  // in reference coordinates; the next step would be its square
  for (int i = 0; i < most; ++i) {
    const FaceMap map(face, projection.xi);
    const Point rest = at - map.x - projection.gap * map.normal;
    Point row[3];
    if (!inverse(map.column(0, projection.gap), map.column(1, projection.gap), map.normal, row)) return false;
    const double step[2] = {dot(row[0], rest), dot(row[1], rest)};
    for (int k = 0; k < 2; ++k) projection.xi[k] += step[k];
    projection.gap += dot(row[2], rest);
    const double moved = std::max(std::abs(step[0]), std::abs(step[1]));
    if (!(std::max(std::abs(projection.xi[0]), std::abs(projection.xi[1])) < far)) return false;
    if (moved < near) return inside(face.shape, projection.xi);
  }
  return false;
}

Point face_normal(const MasterFace& face, const FaceProjection& projection) {
  return FaceMap(face, projection.xi).normal;
}

void face_force(const FacePoint& point, bool want_tangent, FaceForce& out) {
  out = {};
  want_tangent ? evaluate<Direction>(point, out) : evaluate<double>(point, out);
}

}  // namespace mudline
