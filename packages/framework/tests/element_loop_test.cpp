// The loop over elements with laws whose integrals are known.
#include "framework/element_loop.hpp"

#include <gtest/gtest.h>

#include "framework/tests/loop_model.hpp"

namespace mudline {
namespace {

struct Weight : PointLaw {
  static constexpr int fields = 0;
  static constexpr bool forces = true, motion = false, rates = false;
  double standing = 0;  // share that stood before the step

  template <class C, int S, class T>
  void operator()(int, const PointFields<C, S, T>&, PointBalance<C, S, T>& out) const {
    for (int i = 0; i < C::dim; ++i) {
      out.force[i] = 10.0 * (i + 1);
      out.standing_force[i] = standing * 10.0 * (i + 1);
    }
  }
};

TEST(ElementLoop, IntegratesAForceOverTheVolumeOfEveryShape) {
  const auto check = [](Geometry geometry, const std::string& cell) {
    const LoopModel model(geometry, cell, 2, 1);
    const FieldBlock block(model.space, 0, LoopModel::displacement, {}, 4);
    EXPECT_EQ(add_residual(geometry, block, model.level(), Weight{{}, 0.75}, model.residual()), 0);
    for (int i = 0; i < model.mesh->dimension(); ++i) {
      Point unit{};
      unit[i] = 1;
      const double exact = 10 * (i + 1) * model.volume();
      EXPECT_NEAR(model.work([&](const Point&) { return unit; }), exact, 1e-13 * exact) << cell;
    }
    for (std::size_t i = 0; i < model.sum.extent(0); ++i) {
      EXPECT_NEAR(model.acting(i), 0.25 * model.whole(i), 1e-13 * model.volume()) << cell;
      EXPECT_LE(std::abs(model.sum(i)), model.whole(i) * (1 + 1e-14)) << cell;
    }
  };
  for (const Geometry geometry : {Geometry::plane_strain, Geometry::axisymmetric})
    for (const char* cell : {"tri3", "tri6", "quad4", "quad9"}) check(geometry, cell);
  for (const char* cell : {"tet4", "tet10", "hex8", "hex27", "wedge6", "wedge15", "wedge18"})
    check(Geometry::space, cell);
}

TEST(ElementLoop, CountsFoldedElements) {
  const LoopModel model(Geometry::axisymmetric, "quad4", 3, 1);
  const FieldBlock block(model.space, 0, LoopModel::displacement, {}, 2);
  const auto failures = [&] { return add_residual(Geometry::axisymmetric, block, model.level(), Weight(), model.sum); };
  EXPECT_EQ(failures(), 0);
  for (int node = 0; node < model.mesh->num_nodes(); ++node)
    if (model.mesh->coordinates()(node, 0) == 0) model.x(node, 0) = -0.5;  // beyond the axis, but not folded
  EXPECT_EQ(failures(), 1);
  for (int node = 0; node < model.mesh->num_nodes(); ++node)
    if (model.mesh->coordinates()(node, 0) == 2) model.x(node, 0) = 1;  // folded over its neighbour
  EXPECT_EQ(failures(), 2);
}

struct Stress : PointLaw {
  static constexpr bool stresses = true, rates = false;

  template <class C, int S, class T>
  void operator()(int, const PointFields<C, S, T>&, PointBalance<C, S, T>& out) const {
    for (int i = 0; i < C::dim; ++i)
      for (int j = 0; j < C::dim; ++j) out.stress[i][j] = 1.0 + 2 * i + 4 * j;
    out.hoop_stress = 9.0;
  }
};

/// Adds the residual of a law on all elements, with a loop of known shapes.
template <class C, class Shapes, class Law>
int evaluate(const LoopModel& model, const FieldBlock& block, const Law& law) {
  const ElementLoop<C, Shapes> loop{block, model.level()};
  int failures = 0;
  for (int e = 0; e < block.elements; ++e)
    failures += loop.residual(e, law, VectorScatter{model.residual(), block.dofs});
  return failures;
}

TEST(ElementLoop, AStressDoesItsWorkOnALinearDisplacement) {
  const auto stretch = [](const Point& x) { return Point{0.3 * x[0], 0.1 * x[0] - 0.2 * x[1], 0.4 * x[1] + x[2]}; };
  // sigma_ij = 1 + 2 i + 4 j on du_i / dx_j
  const double in_plane = 1 * 0.3 + 3 * 0.1 + 7 * -0.2;
  const LoopModel plane(Geometry::plane_strain, "tri6", 2, 2), ring(Geometry::axisymmetric, "quad9", 2, 2),
      solid(Geometry::space, "tet10", 1, 1);
  EXPECT_EQ((evaluate<PlaneStrain, ElementShapes<6, 3, 1>>(plane, plane.block(), Stress())), 0);
  EXPECT_NEAR(plane.work(stretch), in_plane * 2, 1e-13);
  EXPECT_EQ((evaluate<Axisymmetric, ElementShapes<9, 4, 1>>(ring, ring.block(), Stress())), 0);
  EXPECT_NEAR(ring.work(stretch), (in_plane + 9 * 0.3) * 4 * pi, 1e-12);
  EXPECT_EQ((evaluate<Space3, ElementShapes<10, 4, 1>>(solid, solid.block(), Stress())), 0);
  EXPECT_NEAR(solid.work(stretch), (in_plane + 9 * 0.4 + 13 * 1.0) * 3, 1e-12);
}

struct StoresAndConducts : PointLaw {
  static constexpr int fields = 1;
  static constexpr bool storages = true, fluxes = true, gradients = true, motion = false;

  template <class C, int S, class T>
  void operator()(int, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    out.storage[0] = 3.0 * at.rate[0];
    for (int j = 0; j < C::dim; ++j) out.flux[0][j] = 5.0 * at.gradient[0][j];
  }
};

TEST(ElementLoop, StorageAndFluxOfALinearField) {
  const LoopModel model(Geometry::space, "hex8", 2, 1);
  const auto field = [](const Point& x) { return 1 + 0.5 * x[0] - x[1] + 2 * x[2]; };
  model.set_scalar(model.value, field);
  model.set_scalar(model.rate, [](const Point&) { return 7.0; });
  EXPECT_EQ((evaluate<Space3, ElementShapes<8, 8, 1>>(model, model.block(), StoresAndConducts())), 0);
  const double stored = 3 * 7 * 3, mean = 1 + 0.5 - 0.5 + 1.5, square = 0.25 + 1 + 4;
  EXPECT_NEAR(model.work_on_scalar([](const Point&) { return 1.0; }), stored, 1e-12);
  EXPECT_NEAR(model.work_on_scalar(field), stored * mean + 5 * square * 3, 1e-12);
}

TEST(ElementLoop, FieldsOfALinearMotion) {
  const LoopModel model(Geometry::axisymmetric, "quad9", 2, 2);
  model.set(model.value, [](const Point& x) { return Point{0.25 * x[0], 0.1 * x[1], 0}; });
  model.follow();
  model.set(model.rate, [](const Point& x) { return Point{0.3 * 1.25 * x[0], 0.7 * x[0], 0}; });
  model.set(model.acceleration, [](const Point&) { return Point{0, -3, 0}; });
  model.set_scalar(model.value, [](const Point& x) { return 2 + 1.1 * x[1]; });
  const FieldBlock block = model.block();
  const ElementLoop<Axisymmetric, ElementShapes<9, 4, 1>> loop{block, model.level()};
  int points = 0;
  double volume = 0;
  for (int e = 0; e < block.elements; ++e)
    loop.for_each_point<true, true>(e, [&](int q, const auto& shape, const auto& f) {
      const Point place = block.place(e, q, model.x);
      EXPECT_NEAR(f.moved[0][0], 0.2, 1e-13);  // gradients refer to the place at the end
      EXPECT_NEAR(f.hoop_moved, 0.2, 1e-13);
      EXPECT_NEAR(f.moved[1][1], 0.1 / 1.1, 1e-13);
      EXPECT_NEAR(f.moved[0][1], 0, 1e-13);
      EXPECT_NEAR(f.volume_ratio, 1.25 * 1.25 * 1.1, 1e-12);
      EXPECT_NEAR(f.velocity[0], 0.3 * place[0], 1e-13);
      EXPECT_NEAR(f.velocity_gradient[1][0], 0.7 / 1.25, 1e-12);
      EXPECT_NEAR(f.divergence(), 2 * 0.3, 1e-12);
      EXPECT_NEAR(f.acceleration[1], -3, 1e-13);
      EXPECT_NEAR(f.value[0], 2 + place[1], 1e-13);
      EXPECT_NEAR(f.change[0], f.value[0], 1e-15);
      EXPECT_NEAR(f.gradient[0][1], 1, 1e-12);
      EXPECT_NEAR(block.scalar_at(e, q, 0, model.value), f.value[0], 1e-13);
      ++points;
      volume += shape.dv;
    });
  EXPECT_EQ(points, block.elements * block.points);
  EXPECT_NEAR(volume, 1.25 * 1.25 * 1.1 * model.volume(), 1e-12);
}

/// Uses all that a law may use, so that no derivative vanishes.
struct Everything : PointLaw {
  static constexpr int fields = 1;
  static constexpr bool forces = true, stresses = true, storages = true, fluxes = true, inertia = true,
                        gradients = true;

  template <class C, int S, class T>
  void operator()(int, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    for (int i = 0; i < C::dim; ++i) {
      out.force[i] = at.acceleration[i] / at.volume_ratio + at.velocity[i] * at.value[0];
      for (int j = 0; j < C::dim; ++j)
        out.stress[i][j] = at.velocity_gradient[i][j] * at.velocity_gradient[j][i] + at.gradient[0][j] * at.velocity[i];
      out.stress[i][i] -= at.value[0] * at.value[0];
      out.flux[0][i] = at.gradient[0][i] * (1.0 + at.value[0] * at.value[0]) + at.acceleration[i];
    }
    out.hoop_stress = at.hoop_rate * at.volume_ratio;
    out.storage[0] = at.rate[0] * at.value[0] + at.divergence();
  }
};

/// Sees no more of the motion than volume and acceleration.
struct Mass : PointLaw {
  static constexpr int fields = 1;
  static constexpr bool forces = true, storages = true, inertia = true, shape = false;

  template <class C, int S, class T>
  void operator()(int, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    for (int i = 0; i < C::dim; ++i) out.force[i] = at.acceleration[i] * at.value[0] / (1.0 + at.volume_ratio);
    out.storage[0] = at.rate[0] * at.volume_ratio;
  }
};

template <class C, class Shapes, class Law = Everything>
double error_of_tangent(Geometry geometry, const std::string& cell) {
  const LoopModel model(geometry, cell, 1, 1);
  model.set(model.value, [](const Point& x) {
    return Point{0.1 * std::sin(x[0] + x[1]), 0.05 * std::cos(x[0] - x[2]), 0.1 * x[0] * x[1]};
  });
  model.set_scalar(model.value, [](const Point& x) { return 1 + 0.5 * std::sin(2 * x[0] + x[1] - x[2]); });
  const FieldBlock block = model.block(3);
  const ElementLoop<C, Shapes> loop{block, model.level()};
  const auto assemble = [&](const MatrixScatter& to) {
    for (int e = 0; e < block.elements; ++e) loop.tangent(e, Law(), to, 1);
  };
  const auto residual = [&] { EXPECT_EQ((evaluate<C, Shapes>(model, block, Law())), 0); };
  return tangent_error(model, block.dofs, assemble, residual);
}

TEST(ElementLoop, TheTangentIsTheDifferencedResidual) {
  EXPECT_LT((error_of_tangent<PlaneStrain, ElementShapes<6, 3, 1>>(Geometry::plane_strain, "tri6")), 1e-8);
  EXPECT_LT((error_of_tangent<Axisymmetric, ElementShapes<4, 4, 1>>(Geometry::axisymmetric, "quad4")), 1e-8);
  EXPECT_LT((error_of_tangent<Space3, ElementShapes<8, 8, 1>>(Geometry::space, "hex8")), 1e-8);
}

TEST(ElementLoop, TheTangentOfALawThatSeesOnlyTheVolumeIsTheDifferencedResidual) {
  EXPECT_LT((error_of_tangent<PlaneStrain, ElementShapes<6, 3, 1>, Mass>(Geometry::plane_strain, "tri6")), 1e-8);
  EXPECT_LT((error_of_tangent<Axisymmetric, ElementShapes<4, 4, 1>, Mass>(Geometry::axisymmetric, "quad4")), 1e-8);
  EXPECT_LT((error_of_tangent<Space3, ElementShapes<8, 8, 1>, Mass>(Geometry::space, "hex8")), 1e-8);
}

/// A stress by the motion in the step, whose derivatives are written by hand as those of soil are.
struct Compressible : PointLaw {
  static constexpr bool stresses = true, rates = false;

  template <class C, int S, class T>
  void operator()(int row, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    constexpr int D = C::dim;
    Mat<double, D> back;
    for (int i = 0; i < D; ++i)
      for (int j = 0; j < D; ++j) {
        back[i][j] = (i == j ? 1.0 : 0.0) - at.moved[i][j];
        out.stress[i][j] = 0.3 * (row % 5) * (i + 1) - 0.2 * j;
      }
    const double start = determinant(back) * (1 - at.hoop_moved);
    for (int i = 0; i < D; ++i) out.stress[i][i] += T(10 * start * start);
    out.hoop_stress = 0.7 + 20 * start * start;
    if constexpr (!std::is_same_v<T, double>)
      for (int j = 0; j < D + (C::hoop ? 1 : 0); ++j) {
        const int way = j < D ? D * j + j : D * D;
        for (int i = 0; i < D; ++i) out.stress[i][i].d[way] -= 20 * start * start;
        out.hoop_stress.d[way] = -40 * start * start;
      }
  }
};

/// A block without scalar fields whose stresses see a fitted volume strain.
FieldBlock fitted_block(const LoopModel& model, int terms) {
  FieldBlock block(model.space, 0, LoopModel::displacement, {}, 3);
  block.dilatation_terms = terms;
  return block;
}

template <class C, class Shapes>
double error_of_fitted_tangent(Geometry geometry, const std::string& cell, int terms) {
  const LoopModel model(geometry, cell, 1, 1);
  model.set(model.value, [](const Point& x) {
    return Point{0.1 * std::sin(x[0] + x[1]), 0.05 * std::cos(x[0] - x[2]), 0.1 * x[0] * x[1]};
  });
  const FieldBlock block = fitted_block(model, terms);
  const ElementLoop<C, Shapes> loop{block, model.level()};
  const auto assemble = [&](const MatrixScatter& to) {
    for (int e = 0; e < block.elements; ++e) loop.tangent(e, Compressible(), to, 1);
  };
  return tangent_error(model, block.dofs, assemble,
                       [&] { EXPECT_EQ((evaluate<C, Shapes>(model, block, Compressible())), 0); });
}

TEST(ElementLoop, TheTangentIsTheDifferencedResidualWithAFittedVolumeStrain) {
  for (const int terms : {0, 1}) {
    EXPECT_LT((error_of_fitted_tangent<PlaneStrain, ElementShapes<4, 0, 0>>(Geometry::plane_strain, "quad4", terms)),
              1e-8);
    EXPECT_LT((error_of_fitted_tangent<Axisymmetric, ElementShapes<4, 0, 0>>(Geometry::axisymmetric, "quad4", terms)),
              1e-8);
    EXPECT_LT((error_of_fitted_tangent<Space3, ElementShapes<8, 0, 0>>(Geometry::space, "hex8", terms)), 1e-8);
    EXPECT_LT((error_of_fitted_tangent<Space3, ElementShapes<10, 0, 0>>(Geometry::space, "tet10", terms)), 1e-8);
  }
  EXPECT_LT((error_of_fitted_tangent<Axisymmetric, ElementShapes<9, 0, 0>>(Geometry::axisymmetric, "quad9", 3)), 1e-8);
}

TEST(ElementLoop, AFittedVolumeStrainIsThatOfTheElement) {
  const LoopModel model(Geometry::plane_strain, "quad4", 1, 1);
  // bends: u_x = 0.1 x y about the middle, which changes the volume of every point, but not that of the element
  model.set(model.value, [](const Point& x) { return Point{0.1 * (x[0] - 1) * (x[1] - 0.5), 0, 0}; });
  model.follow();
  model.set(model.rate, [](const Point& x) { return Point{0.3 * (x[0] - 1) * (x[1] - 0.5) + 0.2 * x[0], 0, 0}; });
  const FieldBlock block = fitted_block(model, 1);
  const ElementLoop<PlaneStrain, ElementShapes<4, 0, 0>> loop{block, model.level()};
  double spread = 0;
  loop.for_each_point<true, false, true>(0, [&](int, const auto&, const auto& f) {
    const double start = (1 - f.moved[0][0]) * (1 - f.moved[1][1]) - f.moved[0][1] * f.moved[1][0];
    EXPECT_NEAR(start, 1, 1e-13);
    EXPECT_NEAR(f.divergence(), 0.2, 1e-13);
    spread = std::max(spread, std::abs(f.volume_ratio - 1));
  });
  EXPECT_GT(spread, 0.02);  // the volume ratio stays that of the point
  loop.for_each_point<true, false>(0, [&](int, const auto&, const auto& f) {
    EXPECT_NEAR((1 - f.moved[0][0]) * f.volume_ratio, 1, 1e-13);  // without the fit
  });
}

/// A force on the displacement that asks for no scalar fields.
struct Drag : PointLaw {
  static constexpr bool forces = true, motion = false, scalars = false;

  template <class C, int S, class T>
  void operator()(int, const PointFields<C, S, T>& at, PointBalance<C, S, T>& out) const {
    for (int i = 0; i < C::dim; ++i) out.force[i] = at.velocity[i];
  }
};

TEST(ElementLoop, RefusesALawThatDoesNotFitTheFields) {
  const LoopModel model(Geometry::plane_strain, "tri3", 1, 1);
  const FieldBlock dry(model.space, 0, LoopModel::displacement, {}, 2);
  EXPECT_THROW(with_loop<StoresAndConducts>(Geometry::plane_strain, dry, model.level(), [](const auto&) {}),
               std::logic_error);
  EXPECT_THROW(with_loop<Weight>(Geometry::plane_strain, model.block(), model.level(), [](const auto&) {}),
               std::logic_error);
  const FieldBlock still(model.space, 0, -1, {LoopModel::scalar}, 2);
  EXPECT_THROW(with_loop<Drag>(Geometry::plane_strain, still, model.level(), [](const auto&) {}), std::logic_error);
}

TEST(FieldBlock, KnowsItsUnknowns) {
  const LoopModel model(Geometry::plane_strain, "tri6", 1, 1);
  const FieldBlock both = model.block(2), scalar(model.space, 0, -1, {LoopModel::scalar}, 2);
  EXPECT_EQ(both.dofs.extent(1), 2u * 6 + 3);
  EXPECT_EQ(scalar.dofs.extent(1), 3u);
  EXPECT_TRUE(both.moves());
  EXPECT_FALSE(scalar.moves());
  for (int e = 0; e < both.elements; ++e)
    for (int a = 0; a < 6; ++a) {
      EXPECT_EQ(both.dofs(e, 2 * a + 1), model.dof(LoopModel::displacement, both.nodes(e, a), 1));
      if (a >= 3) continue;
      EXPECT_EQ(both.dofs(e, 12 + a), model.dof(LoopModel::scalar, both.nodes(e, a)));
      EXPECT_EQ(scalar.dofs(e, a), both.dofs(e, 12 + a));
    }
  EXPECT_GT(both.with_quadrature(6).points, both.points);
  EXPECT_EQ(both.with_quadrature(6).u.points, both.with_quadrature(6).p.points);
  EXPECT_THROW(FieldBlock(model.space, 0, 0, {1, 1, 1}, 2), std::logic_error);
}

}  // namespace
}  // namespace mudline
