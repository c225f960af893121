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

}  // namespace

bool find_projection(const MasterFace& face, const Point& at, TargetPlace& place) {
  const double middle = is_simplex(face.shape) ? 1.0 / 3 : 0.0;
  for (double& xi : place.at) xi = middle;
  place.gap = 0;
  constexpr int most = 30;
  constexpr double far = 4, near = 1e-10;  // in reference coordinates; the next step would be its square
  for (int i = 0; i < most; ++i) {
    const FaceMap map(face, place.at);
    const Point rest = at - map.x - place.gap * map.normal;
    Point row[3];
    if (!inverse(map.column(0, place.gap), map.column(1, place.gap), map.normal, row)) return false;
    const double step[2] = {dot(row[0], rest), dot(row[1], rest)};
    for (int k = 0; k < 2; ++k) place.at[k] += step[k];
    place.gap += dot(row[2], rest);
    const double moved = std::max(std::abs(step[0]), std::abs(step[1]));
    if (!(std::max(std::abs(place.at[0]), std::abs(place.at[1])) < far)) return false;
    if (moved < near) return inside(face.shape, place.at);
  }
  return false;
}

Point face_normal(const MasterFace& face, const TargetPlace& place) { return FaceMap(face, place.at).normal; }

ClosestPoint closest_on_face(const MasterFace& face, const TargetPlace& place) {
  const FaceMap map(face, place.at);
  ClosestPoint result;
  result.gap = place.gap;
  result.normal = map.normal;
  result.nodes = face.count;
  std::copy_n(map.N, face.count, result.weight);
  Point row[3] = {};  // derivatives of the coordinates on the face, and of the gap, by the displacement
  inverse(map.column(0, place.gap), map.column(1, place.gap), map.normal, row);
  for (int k = 0; k < ClosestPoint::motions; ++k) {
    result.gap_slope[k] = row[2][k];
    for (int i = 0; i < 3; ++i)
      result.normal_slope[i][k] = map.turning[0][i] * row[0][k] + map.turning[1][i] * row[1][k];
    for (int a = 0; a < face.count; ++a)
      result.weight_slope[a][k] = map.dN[2 * a] * row[0][k] + map.dN[2 * a + 1] * row[1][k];
  }
  return result;
}

}  // namespace mudline
