#include "algebra/mumps_solver.hpp"

#include <gtest/gtest.h>

#include "algebra/tests/solver_cases.hpp"

namespace mudline {
namespace {

TEST(MumpsSolverTwoRanks, SolvesASequenceOnOneGraph) { cases::check_direct(); }
TEST(MumpsSolverTwoRanks, SolvesOnBothRanks) { cases::check_direct(false); }
TEST(MumpsSolverTwoRanks, ReusesFactorsWithinTheTolerance) { cases::check_reuse(); }
TEST(MumpsSolverTwoRanks, NamesASingularMatrixWithARankWithoutRows) {
  cases::check_singular();
  cases::check_singular(false);
}

}  // namespace
}  // namespace mudline
