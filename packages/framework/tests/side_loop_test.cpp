// The loop over sides with loads whose resultants are known.
#include "framework/side_loop.hpp"

#include <gtest/gtest.h>

#include "framework/tests/loop_model.hpp"

namespace mudline {
namespace {

struct Pressure : SideLaw {
  double pressure = 5;

  template <class C, class T>
  void operator()(int, const SidePoint<C, T>& at, SideBalance<C, T>& out) const {
    for (int i = 0; i < C::dim; ++i) {
      out.force[i] = -pressure * at.normal[i];
      out.standing[i] = 0.5 * value(out.force[i]);
    }
  }
};

SideLevel level(const LoopModel& model) { return {model.x, model.rate, model.value, 1, LoopModel::per_step, 1}; }

Point resultant(const LoopModel& model) {
  Point total{};
  for (int i = 0; i < model.mesh->dimension(); ++i) {
    Point unit{};
    unit[i] = 1;
    total[i] = model.work([&](const Point&) { return unit; });
  }
  return total;
}

TEST(SideLoop, APressureOnOneSideIsItsArea) {
  const auto check = [](Geometry geometry, const std::string& cell, double area) {
    const LoopModel model(geometry, cell, 2, 1);
    const SideBlock top = model.sides("top", LoopModel::displacement);
    add_side_residual(geometry, top, level(model), Pressure(), model.residual());
    const Point force = resultant(model);
    for (int i = 0; i < model.mesh->dimension(); ++i)
      EXPECT_NEAR(force[i], i + 1 == model.mesh->dimension() ? -5 * area : 0, 1e-12 * area) << cell;
    for (std::size_t i = 0; i < model.sum.extent(0); ++i)
      EXPECT_NEAR(model.acting(i), 0.5 * model.whole(i), 1e-14 * area) << cell;
  };
  for (const char* cell : {"tri3", "quad9"}) {
    check(Geometry::plane_strain, cell, 2);
    check(Geometry::axisymmetric, cell, 4 * pi);
  }
  for (const char* cell : {"tet4", "tet10", "hex8", "hex27", "wedge6", "wedge15", "wedge18"})
    check(Geometry::space, cell, 2);
}

TEST(SideLoop, APressureAllAroundIsInBalance) {
  for (const char* cell : {"tri6", "tet10", "wedge15"}) {
    const bool space = cell[0] != 't' || cell[1] == 'e';
    const Geometry geometry = space ? Geometry::space : Geometry::plane_strain;
    const LoopModel model(geometry, cell, 2, 2);
    model.set(model.value, [](const Point& x) {
      return Point{0.1 * x[0] * x[1] + 0.05 * x[2], 0.1 * std::sin(x[0]), 0.1 * x[2] * x[0]};
    });
    model.follow();
    for (const auto& [set, sides] : model.mesh->side_sets())
      add_side_residual(geometry, model.sides(set, LoopModel::displacement), level(model), Pressure(),
                        model.residual());
    const Point force = resultant(model);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(force[i], 0, 1e-13);
    // On a displacement that grows with the place the work is -p div(u) V, of the deformed volume.
    double volume = 0, work = 0;
    const FieldBlock block = model.block(5);
    for (int node = 0; node < model.mesh->num_nodes(); ++node)
      for (int i = 0; i < model.mesh->dimension(); ++i)
        work += model.sum(model.dof(LoopModel::displacement, node, i)) * model.x(node, i);
    with_loop<PointLaw>(geometry, block, model.level(), [&](const auto& loop) {
      for (int e = 0; e < block.elements; ++e)
        loop.template for_each_point<false, false>(e, [&](int, const auto& shape, const auto&) { volume += shape.dv; });
    });
    EXPECT_NEAR(work, -5 * model.mesh->dimension() * volume, 1e-12);
  }
}

struct Inflow : SideLaw {
  static constexpr bool flows = true, drains = true;

  template <class C, class T>
  void operator()(int, const SidePoint<C, T>& at, SideBalance<C, T>& out) const {
    out.flow = (3.0 * at.value * at.value - 1.0) * at.area;
  }
};

TEST(SideLoop, AFlowActsOnTheScalar) {
  const LoopModel model(Geometry::axisymmetric, "quad9", 3, 1);
  model.set_scalar(model.value, [](const Point& x) { return x[0]; });
  add_side_residual(Geometry::axisymmetric, model.sides("top", LoopModel::scalar), level(model), Inflow(),
                    model.residual());
  // int (3 r^2 - 1) 2 pi r dr over [0, 2], and the same with r as test function
  EXPECT_NEAR(model.work_on_scalar([](const Point&) { return 1.0; }), 2 * pi * (12 - 2), 1e-12);
  EXPECT_NEAR(model.work_on_scalar([](const Point& x) { return x[0]; }), 2 * pi * (3 * 32 / 5.0 - 8 / 3.0), 1e-12);
}

/// A load that depends on place, normal, area and velocity.
struct Everything : SideLaw {
  static constexpr bool moves = true, damps = true;

  template <class C, class T>
  void operator()(int, const SidePoint<C, T>& at, SideBalance<C, T>& out) const {
    for (int i = 0; i < C::dim; ++i)
      out.force[i] = (1.0 + at.x[0] * at.x[1]) * at.normal[i] - at.velocity[i] * at.velocity[1] * at.area;
  }
};

double error_of_tangent(Geometry geometry, const std::string& cell) {
  const LoopModel model(geometry, cell, 1, 1);
  model.set(model.value, [](const Point& x) {
    return Point{0.1 * std::sin(x[0] + x[1]), 0.05 * std::cos(x[0] - x[2]), 0.1 * x[0] * x[1]};
  });
  const SideBlock sides = model.sides("right", LoopModel::displacement);
  const auto assemble = [&](const MatrixScatter& to) {
    add_side_tangent(geometry, sides, level(model), Everything(), to, 1);
  };
  const auto evaluate = [&] { add_side_residual(geometry, sides, level(model), Everything(), model.residual()); };
  return tangent_error(model, sides.dofs, assemble, evaluate);
}

TEST(SideLoop, TheTangentIsTheDifferencedResidual) {
  EXPECT_LT(error_of_tangent(Geometry::plane_strain, "quad4"), 1e-8);
  EXPECT_LT(error_of_tangent(Geometry::axisymmetric, "tri6"), 1e-8);
  EXPECT_LT(error_of_tangent(Geometry::space, "tet10"), 1e-8);
  EXPECT_LT(error_of_tangent(Geometry::space, "wedge15"), 1e-8);
}

TEST(SideLoop, TheTangentOfAFlow) {
  const LoopModel model(Geometry::plane_strain, "tri6", 1, 1);
  model.set_scalar(model.value, [](const Point& x) { return 1 + x[0] + x[1]; });
  const SideBlock sides = model.sides("right", LoopModel::scalar);
  SideLevel start = level(model);  // a flow is one per area of a surface that does not move
  start.x = model.mesh->coordinates();
  const auto assemble = [&](const MatrixScatter& to) {
    add_side_tangent(Geometry::plane_strain, sides, start, Inflow(), to, 1);
  };
  const auto evaluate = [&] { add_side_residual(Geometry::plane_strain, sides, start, Inflow(), model.residual()); };
  EXPECT_LT(tangent_error(model, sides.dofs, assemble, evaluate), 1e-8);
}

}  // namespace
}  // namespace mudline
