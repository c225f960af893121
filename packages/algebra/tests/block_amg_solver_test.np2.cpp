#include "algebra/block_amg_solver.hpp"

#include <gtest/gtest.h>

#include "algebra/tests/solver_cases.hpp"

namespace mudline {
namespace {

using cases::at;

TEST(BlockAmgTwoRanks, CountsOnTheModelProblem) {
  EXPECT_LE(cases::check_block_amg(at(1e-1)), 33);
  EXPECT_LE(cases::check_block_amg(at(1e-3)), 18);
}

TEST(BlockAmgTwoRanks, UndrainedAndImpermeable) {
  EXPECT_LE(cases::check_block_amg(at(1e2, 1e-12)), 35);
  model::Settings settings = at(1e-2);
  settings.drained_top = false;
  EXPECT_LE(cases::check_block_amg(settings), 33);
}

TEST(BlockAmgTwoRanks, FieldsThatArePrescribedThroughout) {
  cases::check_prescribed_fields<model::Problem>(at(1e-2));
  model::Settings space = cases::in_space_at(1e-2);
  space.layers = 28;  // slender, with more pressures than multigrid's coarsest level takes
  cases::check_prescribed_fields<model::ProblemInSpace>(space);
}

TEST(BlockAmgTwoRanks, DrySoil) {
  model::Settings settings = at(1e-2);
  settings.fluid = false;
  EXPECT_LE(cases::check_block_amg(settings), 22);
}

TEST(BlockAmgTwoRanks, InSpace) {
  EXPECT_LE(cases::check_in_space(cases::in_space_at(1e-1)), 25);
  EXPECT_LE(cases::check_in_space(cases::in_space_at(1e2, 1e-12)), 25);
}

}  // namespace
}  // namespace mudline
