#include "contact/faces/face_point.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/target_point.hpp"
#include "contact/tests/slope_friction.hpp"
#include "tensor/vec.hpp"

namespace mudline {
namespace {

/// A bowl of one face: its nodes on z = bend (x^2 + y^2), with the normals of that surface.
MasterFace bowl(CellShape shape, double bend) {
  MasterFace face{shape, num_nodes(shape), {}, {}};
  for (int a = 0; a < face.count; ++a) {
    const auto xi = reference_node(shape, a);
    const double x = xi[0], y = xi[1] + 0.1 * xi[0];
    face.x[a] = {x, y, bend * (x * x + y * y)};
    const Point normal{-2 * bend * x, -2 * bend * y, 1};
    face.normal[a] = 1 / length(normal) * normal;
  }
  return face;
}

TEST(FacePoint, ClosestPointLiesBelowThePointAlongTheNormal) {
  for (CellShape shape : {CellShape::tri3, CellShape::tri6, CellShape::quad4, CellShape::quad9}) {
    const MasterFace face = bowl(shape, 0.2);
    TargetPlace projection;
    const double xi[2] = {0.21, 0.17};
    double N[max_side_nodes], dN[2 * max_side_nodes];
    evaluate_shape(shape, xi, N, dN);
    Point y{}, n{};
    for (int a = 0; a < face.count; ++a) {
      y += N[a] * face.x[a];
      n += N[a] * face.normal[a];
    }
    ASSERT_TRUE(find_projection(face, y - 0.07 / length(n) * n, projection));
    EXPECT_NEAR(projection.gap, -0.07, 1e-12);
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(projection.at[k], xi[k], 1e-12);
    EXPECT_FALSE(find_projection(face, {1.9, 1.9, 0.3}, projection));
  }
}

/// One evaluation of a point that penetrated a face in the step before and moves along and into it.
struct Case {
  explicit Case(CellShape shape) : face(bowl(shape, 0.2)), x_old(face.x) {
    law.penalty = 1e4;
    for (int a = 0; a < face.count; ++a)
      for (int i = 0; i < 3; ++i) face.x[a][i] += 0.01 * std::sin(3.0 * a + i);
    slave = {0.23, 0.15, -0.02};
  }
  ClosestPoint closest() const {
    TargetPlace place;
    EXPECT_TRUE(find_projection(face, slave, place));
    return closest_on_face(face, place);
  }
  TargetForce force(bool tangent) const {
    const ClosestPoint at = closest();
    TargetPoint point{law, at, x_old.data(), {0.2, 0.16, -0.01}, 0.3};
    point.gap_old = -0.01;
    point.old.normal_force = 30;
    point.old.shear.shear = {40, -20, 0};
    point.normal_old = {0, 0, 1};
    return target_force<3>(point, tangent);
  }
  /// Position of a node: the face's nodes come first, then the point itself.
  Point& place(int node) { return node < face.count ? face.x[node] : slave; }
  /// Weight of a node in d.
  double weight(const ClosestPoint& at, int node) const { return node < face.count ? -at.weight[node] : 1.0; }

  ContactPointLaw law;
  MasterFace face;
  SideCoordinates x_old;
  Point slave;
};

void expect_tangent(Case at, double tolerance) {
  const TargetForce exact = at.force(true), plain = at.force(false);
  const ClosestPoint closest = at.closest();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(exact.acting[i], plain.acting[i]);
  ASSERT_TRUE(exact.point.active);
  const double step = 1e-6;
  for (int node = 0; node <= at.face.count; ++node)
    for (int j = 0; j < 3; ++j) {
      Case ahead = at, behind = at;
      ahead.place(node)[j] += step;
      behind.place(node)[j] -= step;
      const TargetForce up = ahead.force(false), down = behind.force(false);
      const ClosestPoint above = ahead.closest(), below = behind.closest();
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(exact.acting_slope[i][j] * at.weight(closest, node), (up.acting[i] - down.acting[i]) / (2 * step),
                    tolerance * at.law.penalty)
            << node << ' ' << i << ' ' << j;
      for (int a = 0; a < at.face.count; ++a)
        EXPECT_NEAR(closest.weight_slope[a][j] * at.weight(closest, node),
                    (above.weight[a] - below.weight[a]) / (2 * step), tolerance);
      EXPECT_NEAR(exact.start_share_slope[j] * at.weight(closest, node),
                  (up.start_share - down.start_share) / (2 * step), 1e-5);
    }
}

constexpr CellShape shapes[] = {CellShape::tri3, CellShape::tri6, CellShape::quad4, CellShape::quad9};

TEST(FacePoint, TangentOfPressure) {
  for (CellShape shape : shapes) expect_tangent(Case(shape), 1e-7);
}

TEST(FacePoint, TangentOfStickAndSlip) {
  const Slope sticks(10.0), slides(0.02);
  for (const Slope* friction : {&sticks, &slides})
    for (CellShape shape : shapes) {
      Case at(shape);
      at.law.friction = friction;
      EXPECT_EQ(at.force(false).point.shear.slides, friction == &slides);
      expect_tangent(at, 1e-7);
    }
}

TEST(FacePoint, TangentOfSharesAndDamping) {
  for (CellShape shape : shapes) {
    Case at(shape);
    at.law.start_weight = 0.4;
    at.law.conserves = true;
    at.law.viscous = 0.3;
    at.law.dt = 0.01;
    expect_tangent(at, 1e-6);
  }
}

TEST(FacePoint, SlidingShearIsTheStrengthAlongTheWay) {
  const Slope friction(0.2);
  MasterFace face = bowl(CellShape::quad4, 0.0);
  ContactPointLaw law;
  law.penalty = 1e4;
  law.dt = 1e12;  // so slow that the speed has no effect
  law.friction = &friction;
  const SideCoordinates was = face.x;
  TargetPlace place;
  ASSERT_TRUE(find_projection(face, {0.4, 0.5, -0.01}, place));
  const ClosestPoint at = closest_on_face(face, place);
  TargetPoint point{law, at, was.data(), {0.1, 0.1, -0.01}, 0.5};
  point.normal_old = {0, 0, 1};
  point.gap_old = -0.01;
  const ContactPoint out = target_force<3>(point, false).point;
  EXPECT_NEAR(out.pressure, 100, 1e-10);
  EXPECT_NEAR(out.total.force[2], 50, 1e-10);
  EXPECT_NEAR(out.total.force[0], -0.2 * 50 * 0.6, 1e-10);
  EXPECT_NEAR(out.total.force[1], -0.2 * 50 * 0.8, 1e-10);
  double sum = 0;
  for (int a = 0; a < face.count; ++a) sum += at.weight[a];
  EXPECT_NEAR(sum, 1, 1e-14);
}

}  // namespace
}  // namespace mudline
