#include "algebra/assembler.hpp"

#include <gtest/gtest.h>
#include <Tpetra_Core.hpp>

#include "algebra/tests/distributed_cases.hpp"

namespace mudline {
namespace {

TEST(Assembler, EqualsDenseSummation) { cases::check_assembly(); }

TEST(Assembler, ConstrainedDofsWithoutStiffnessGetAOne) {
  const auto dofs = rcp(new DofMap(Tpetra::getDefaultComm(), {{"displacement", 1, {0, 1, 2, 3}, 4}}));
  Kokkos::View<int**, Kokkos::LayoutRight> elements("elements", 1, 2);
  elements(0, 0) = 0;
  elements(0, 1) = 1;
  Assembler assembler(dofs);
  const int group = assembler.add_group(elements);
  assembler.finalise();
  Kokkos::View<char*> constrained("constrained", 4);
  constrained(1) = constrained(3) = 1;  // one dof with stiffness, and one that no element touches
  for (int repeat = 0; repeat < 2; ++repeat) {
    assembler.begin(constrained);
    {
      const MatrixScatter scatter = assembler.scatter(group);
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) scatter.add(0, a, b, a == b ? 5 : -2);
    }
    assembler.end();
    const auto local = assembler.matrix()->getLocalMatrixHost();
    const double diagonal[4] = {5, 5, 0, 1};
    for (int row = 0; row < 4; ++row)
      for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k)
        EXPECT_EQ(local.values(k), local.graph.entries(k) == row ? diagonal[row] : 0);
  }
}

TEST(Assembler, GroupsShareEntries) {
  const auto dofs = rcp(new DofMap(Tpetra::getDefaultComm(), {{"displacement", 1, {0, 1, 2}, 3}}));
  Kokkos::View<int**, Kokkos::LayoutRight> bars("bars", 2, 2), point("point", 1, 1);
  bars(0, 1) = bars(1, 0) = 1;
  bars(1, 1) = 2;
  point(0, 0) = 1;
  Assembler assembler(dofs);
  const int bar_group = assembler.add_group(bars), point_group = assembler.add_group(point);
  assembler.finalise();
  EXPECT_THROW(assembler.add_group(point), std::logic_error);
  assembler.begin(Kokkos::View<char*>("constrained", 3));
  {
    const MatrixScatter scatter = assembler.scatter(bar_group);
    for (int e = 0; e < 2; ++e)
      for (int a = 0; a < 2; ++a) scatter.add(e, a, a, 1);
    assembler.scatter(point_group).add(0, 0, 0, 10);
  }
  assembler.end();
  Vector ones(dofs->owned()), sums(dofs->owned());
  ones.putScalar(1);
  assembler.matrix()->apply(ones, sums);
  EXPECT_EQ(sums.getData()[0], 1);
  EXPECT_EQ(sums.getData()[1], 12);
  EXPECT_EQ(sums.getData()[2], 1);
}

}  // namespace
}  // namespace mudline
