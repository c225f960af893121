#include "simulation/results/result_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "core/errors.hpp"
#include "simulation/results/result_lines.hpp"

namespace mudline {
namespace {

TEST(ResultTable, KeepsTheOrderAndTakesTheLastValue) {
  ResultTable table;
  table.set("push", "pile", "resistance", "N", 1e3);
  table.set("push", "a, b", "share", "-", 0.1);
  table.set("push", "pile", "resistance", "N", 2500);
  EXPECT_EQ(table.csv(), "stage,of,quantity,value,unit\npush,pile,resistance,2500,N\npush,\"a, b\",share,0.1,-\n");
  table.remove("push", "pile", "resistance");
  table.remove("push", "pile", "resistance");
  EXPECT_EQ(table.csv(), "stage,of,quantity,value,unit\npush,\"a, b\",share,0.1,-\n");
}

TEST(ResultTable, IsTheSameAfterACheckpoint) {
  ResultTable table;
  table.set("", "pile", "height of the mudline", "m", 0.1 + 0.2);
  table.set("set-up", "pile", "resistance", "N", -1.0 / 3.0);
  EXPECT_EQ(ResultTable::from_lines(table.lines()).csv(), table.csv());
  EXPECT_THROW(ResultTable::from_lines("push\tpile\tresistance\tN\tmuch\n"), InputError);
  EXPECT_THROW(ResultTable::from_lines("push\n"), InputError);
}

TEST(ResultTable, RefusesWhatIsNoNumber) {
  ResultTable table;
  EXPECT_THROW(table.set("push", "pile", "resistance", "N", NAN), std::invalid_argument);
  EXPECT_TRUE(table.all().empty());
}

ResultTable pile_that_is_pushed_and_pulled() {
  ResultTable table;
  const auto set = [&](const char* stage, const char* quantity, const char* unit, double value) {
    table.set(stage, "pile", quantity, unit, value);
  };
  table.set("push", "stage", "duration", "s", 7200);
  set("push", "depth of the tip", "m", 2);
  set("push", "resistance", "N", 9000);
  set("push", "highest resistance", "N", 12345);
  set("push", "depth at the highest resistance", "m", 0.05);
  set("push", "lowest resistance", "N", 0);
  set("pull", "resistance", "N", -4000);
  set("pull", "highest resistance", "N", 3900);
  set("pull", "lowest resistance", "N", -5000);
  set("pull", "my own number", "m", 3);
  table.set("push", "soil", "highest excess pore pressure", "Pa", 1e4);
  table.set("", "balance", "error of water", "-", -1.5e-12);
  return table;
}

TEST(ResultLines, TellStagesThenTheRun) {
  const std::vector<std::string> expected{
      "push (2 h), pile: tip 2 m below the mudline; resistance 9 kN, at most 12.35 kN at 50 mm",
      "pull, pile: resistance -4 kN, at least -5 kN; my own number 3 m", "balance: error of water -1.5e-12"};
  EXPECT_EQ(result_lines(pile_that_is_pushed_and_pulled(), 3), expected);
}

TEST(ResultLines, LeaveOutTheFirstWhereTheyAreMany) {
  const std::vector<std::string> expected{"(2 lines of earlier stages are left out)",
                                          "balance: error of water -1.5e-12"};
  EXPECT_EQ(result_lines(pile_that_is_pushed_and_pulled(), 2), expected);
}

TEST(ResultLines, FactorOfSafetyHasItsBracket) {
  ResultTable table;
  table.set("safety", "strength reduction", "factor of safety", "-", 1.3816);
  table.set("safety", "strength reduction", "factor without equilibrium", "-", 1.3847);
  EXPECT_EQ(result_lines(table, 5), std::vector<std::string>{"safety, strength reduction: factor of safety 1.3816; no "
                                                             "equilibrium at 1.3847"});
}

}  // namespace
}  // namespace mudline
