#include "algebra/assembler.hpp"

#include <gtest/gtest.h>
#include <Tpetra_Core.hpp>

#include "algebra/tests/distributed_cases.hpp"

namespace mudline {
namespace {

TEST(AssemblerTwoRanks, EqualsDenseSummation) { cases::check_assembly(); }

TEST(AssemblerTwoRanks, ARankWithoutElementsTakesPart) {
  model::Settings settings;
  settings.cells = 1;  // a single row of cells: rank 0 has nothing
  model::Problem problem(settings, Tpetra::getDefaultComm());
  EXPECT_EQ(problem.num_elements(), problem.dofs()->comm()->getRank() == 1 ? 2 : 0);
  for (int repeat = 0; repeat < 3; ++repeat) {
    const RCP<const CrsMatrix> matrix = problem.assemble();
    EXPECT_EQ(matrix->getGlobalNumRows(), 22u);
    EXPECT_GT(matrix->getFrobeniusNorm(), 0);
  }
}

TEST(AssemblerTwoRanks, AConstrainedDofThatOnlyTheOtherRankSeesGetsItsOne) {
  const auto comm = Tpetra::getDefaultComm();
  const bool first = comm->getRank() == 0;
  // Rank 0 owns nodes 0 and 1; the only element lies on rank 1 and touches 1 and 2; node 1 is constrained.
  const FieldLayout field =
      first ? FieldLayout{"displacement", 1, {0, 1}, 2} : FieldLayout{"displacement", 1, {2, 1}, 1};
  const auto dofs = rcp(new DofMap(comm, {field}));
  Kokkos::View<int**, Kokkos::LayoutRight> elements("elements", first ? 0 : 1, 2);
  if (!first) elements(0, 0) = 1;
  Assembler assembler(dofs);
  const int group = assembler.add_group(elements);
  assembler.finalise();
  Kokkos::View<char*> constrained("constrained", 2);
  constrained(1) = 1;
  for (const double stiffness : {0.0, 3.0, 0.0}) {
    assembler.begin(constrained);
    if (!first) {
      const MatrixScatter scatter = assembler.scatter(group);
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b) scatter.add(0, a, b, a == b ? stiffness : 7);
    }
    assembler.end();
    Vector ones(dofs->owned()), sums(dofs->owned());
    ones.putScalar(1);
    assembler.matrix()->apply(ones, sums);
    if (first)
      EXPECT_EQ(sums.getData()[1], stiffness == 0 ? 1 : stiffness);
    else
      EXPECT_EQ(sums.getData()[0], stiffness);
  }
}

}  // namespace
}  // namespace mudline
