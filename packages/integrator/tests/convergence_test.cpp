#include "integrator/convergence.hpp"

#include <gtest/gtest.h>

#include "modal_fixture.hpp"

namespace mudline {

namespace {

/// A displacement with one component on the three nodes of a triangle.
class ConvergenceTest : public ::testing::Test {
 protected:
  ConvergenceTest() { convergence.declare_state(); }

  Vector vector(double a, double b, double c) const {
    Vector result(space.dofs()->owned());
    const double values[3] = {a, b, c};
    for (int i = 0; i < 3; ++i) result.replaceLocalValue(i, values[i]);
    return result;
  }
  /// Forces of the given size act, with a hundred times that in parts that cancel.
  void act(double size) {
    const NodalView acting("acting", 3), whole("whole", 3);
    acting(0) = size;
    whole(0) = 100 * size;
    convergence.measure(acting, whole);
  }

  Mesh mesh{Tpetra::getDefaultComm(), Geometry::plane_strain, testing::triangle()};
  Space space{mesh, {{"displacement", "m", "N", 1, Support::all_nodes, 2}}};
  StateStore store{space};
  Convergence convergence{space, store};
};

}  // namespace

TEST_F(ConvergenceTest, AResidualIsComparedWithWhatActsAndItsRounding) {
  convergence.begin_step({1e-6, 1e-4, 1e-8});
  act(5);
  convergence.residual_ratios(vector(0, 0, 0));  // the first one acts as well
  const Vector f = vector(3e-6, 0, 4e-6);        // norm 5e-6
  EXPECT_NEAR(convergence.residual_ratios(f)[0], 5e-6 / (5e-6 + 1e-14 * 500), 1e-12);
  EXPECT_FALSE(convergence.at_rounding());
  convergence.residual_ratios(vector(4e-13, 0, 0));
  EXPECT_TRUE(convergence.at_rounding());  // below a tenth of 5e-12
}

TEST_F(ConvergenceTest, TheFirstResidualActs) {
  convergence.begin_step({1e-6, 1e-4, 1e-8});
  act(0);
  EXPECT_NEAR(convergence.residual_ratios(vector(0, 7, 0))[0], 1e6, 1e-3);
}

TEST_F(ConvergenceTest, AnUpdateIsComparedWithTheIncrement) {
  convergence.begin_step({1e-6, 1e-4, 1e-8});
  store.committed().value(0) = 2;
  const double rounding = 1e-14 * std::sqrt(2.3 * 2.3);  // of the unknown, which is larger than the mesh
  EXPECT_NEAR(convergence.update_ratios(vector(6e-5, 0, 0), vector(2.3, 0, 0))[0], 6e-5 / (3e-5 + rounding), 1e-10);
}

TEST_F(ConvergenceTest, AStageHasAFloorOfItsLargestStep) {
  convergence.begin_step({1e-6, 1e-4, 1e-8});
  act(5);
  convergence.accept(vector(0, 0, 3));
  store.accept();
  EXPECT_EQ(store.committed().arrays[0](0, 1), 3);
  convergence.begin_step({1e-6, 1e-4, 1e-8});
  act(0);
  convergence.residual_ratios(vector(0, 0, 0));
  EXPECT_NEAR(convergence.residual_ratios(vector(5e-12, 0, 0))[0], 1, 1e-9);  // 1e-6 of a millionth of 5
  convergence.begin_stage();
  EXPECT_GT(convergence.residual_ratios(vector(5e-12, 0, 0))[0], 1e6);
}

TEST_F(ConvergenceTest, TheContractionIsThatOfTheResidual) {
  convergence.begin_step({1e-6, 1e-4, 1e-8});
  act(5);
  convergence.residual_ratios(vector(1, 0, 0));
  EXPECT_EQ(convergence.observe(), 0);
  act(50);
  const double now = convergence.residual_ratios(vector(0.1, 0, 0))[0];
  EXPECT_NEAR(convergence.observe() / now, 10, 1e-9);
}

}  // namespace mudline
