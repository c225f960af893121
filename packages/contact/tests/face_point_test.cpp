#include "contact/faces/face_point.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

/// One face as a target. Its nodes are the first of the coordinates; their normals are constant.
class OneFace : public DeformableTarget {
 public:
  explicit OneFace(const MasterFace& face) : DeformableTarget(3), face_(face) {
    side_.count = face.count;
    side_.shape = face.shape;
    for (int a = 0; a < face.count; ++a) side_.node[a] = a;
    sides_ = {side_};
  }
  int pieces() const override { return 1; }
  TargetNodes nodes(int) const override { return {side_.count, side_.node}; }
  const std::vector<MasterSurface::MasterSide>& sides() const override { return sides_; }
  void update(const ConstCoordinateView&) override {}
  std::vector<int> near(const Bounds&, double) const override { return {0}; }
  bool find(const std::vector<int>&, const Point& at, const Point&, double, const ConstCoordinateView& x,
            TargetPlace& place) const override {
    place.piece = 0;
    return find_projection(face_at(x), at, place);
  }
  ClosestPoint closest(const TargetPlace& place, const Point&, const ConstCoordinateView& x) const override {
    return closest_on_face(face_at(x), place);
  }
  void weights(int, const double* at, double* weight) const override {
    double slope[2 * max_side_nodes];
    evaluate_shape(face_.shape, at, weight, slope);
  }

 private:
  MasterFace face_at(const ConstCoordinateView& x) const {
    return {face_.shape, face_.count, side_coordinates(side_, x), face_.normal};
  }
  MasterFace face_;
  MasterSurface::MasterSide side_{};
  std::vector<MasterSurface::MasterSide> sides_;
};

using Coordinates = Kokkos::View<double**, Kokkos::LayoutRight>;

/// One evaluation of a point that penetrated a face in the step before and moves along and into it. Its place is the
/// last of the coordinates.
struct Case {
  explicit Case(const MasterFace& face)
      : target(face), nodes(face.count), x("x", nodes + 1, 3), x_old("x_old", nodes + 1, 3) {
    law.penalty = 1e4;
    for (int a = 0; a < nodes; ++a) put(x_old, a, face.x[a]);
    Kokkos::deep_copy(x, x_old);
    put(x_old, nodes, {0.2, 0.16, -0.01});
    put(x, nodes, {0.23, 0.15, -0.02});
    old.gap = -0.01;
    old.normal_force = 30;
    old.force = {1, -2, 30};
    old.shear.shear = {40, -20, 0};
  }
  explicit Case(CellShape shape) : Case(bowl(shape, 0.2)) {
    for (int a = 0; a < nodes; ++a)
      for (int i = 0; i < 3; ++i) x(a, i) += 0.01 * std::sin(3.0 * a + i);
  }
  static void put(const Coordinates& to, int node, const Point& at) { std::copy_n(at.data(), 3, &to(node, 0)); }

  /// Forces on the point, then on the nodes of the face.
  ContactPoint evaluate(SideAction& out) const {
    const SideFilm dry;
    const std::vector<int> all{0};
    const double shape = 1, columns[] = {0, 0.1, 0.2, 0, 0, 1};
    PointInStep point{law, dry, all, 1, x_old, x, place_of(x_old, nodes), place_of(x, nodes), {0, 0, -1}, old};
    point.area = area;
    point.nodes = 1;
    point.shape = &shape;
    point.old_columns = columns;
    double leaving[SideAction::most];
    target.old_forces(columns, old.force, leaving);
    if (law.conserves) point.leaving = leaving;
    TargetPlace place;
    EXPECT_TRUE(target.find(all, point.place, point.outward, 1, x, place));
    out.open(3, target.num_dofs(0), 0);
    return target.act(point, place, out);
  }

  ContactPointLaw law;
  OneFace target;
  int nodes;
  Coordinates x, x_old;
  PointHistory old;
  double area = 0.3;
};

void expect_tangent(const Case& at, double tolerance) {
  SideAction exact, up, down;
  exact.tangent = true;
  ASSERT_TRUE(at.evaluate(exact).active);
  const double step = 1e-6, weight = 1 / (1 - at.law.start_weight);
  const int dofs = exact.dofs();
  at.evaluate(up);
  for (int a = 0; a < dofs; ++a) {
    EXPECT_EQ(exact.f[a], up.f[a]);
    EXPECT_EQ(exact.later[a], up.later[a]);
  }
  for (int b = 0; b < dofs; ++b) {
    double& moved = b < 3 ? at.x(at.nodes, b) : at.x(b / 3 - 1, b % 3);
    moved += step;
    at.evaluate(up);
    moved -= 2 * step;
    at.evaluate(down);
    moved += step;
    for (int a = 0; a < dofs; ++a) {
      const double slope = (up.f[a] - down.f[a] + weight * (up.later[a] - down.later[a])) / (2 * step);
      EXPECT_NEAR(exact.k[a * dofs + b], slope, tolerance * at.law.penalty) << a << ' ' << b;
    }
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
      SideAction action;
      EXPECT_EQ(at.evaluate(action).shear.slides, friction == &slides);
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
  Case at(bowl(CellShape::quad4, 0.0));
  at.law.dt = 1e12;  // so slow that the speed has no effect
  at.law.friction = &friction;
  at.old = {};
  at.old.gap = -0.01;
  at.area = 0.5;
  Case::put(at.x_old, at.nodes, {0.1, 0.1, -0.01});
  Case::put(at.x, at.nodes, {0.4, 0.5, -0.01});
  SideAction action;
  const ContactPoint out = at.evaluate(action);
  EXPECT_NEAR(out.pressure, 100, 1e-10);
  EXPECT_NEAR(out.force[2], 50, 1e-10);
  EXPECT_NEAR(out.force[0], -0.2 * 50 * 0.6, 1e-10);
  EXPECT_NEAR(out.force[1], -0.2 * 50 * 0.8, 1e-10);
  for (int i = 0; i < 3; ++i) {
    double sum = 0;
    for (int a = 0; a <= at.nodes; ++a) sum += action.f[3 * a + i];
    EXPECT_NEAR(sum, 0, 1e-12);
  }
}

}  // namespace
}  // namespace mudline
