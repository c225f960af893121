#include "simulation/output/history_file.hpp"

#include "core/errors.hpp"
#include "simulation/tests/output_fixture.hpp"

namespace mudline {
namespace {

using output_test::content;
using output_test::Folder;
using output_test::message_of;
using output_test::world;

std::vector<HistoryValue> row(double force) {
  return {{"body/cone/force y", "N", force}, {"balance/water/error", "-", 1e-17}};
}

TEST(HistoryFile, WritesHeaderWithUnitsAndRowsAtOnce) {
  Folder folder;
  HistoryFile history(world(), folder / "h.csv");
  EXPECT_FALSE(std::filesystem::exists(folder / "h.csv"));
  history.write(0.0, row(0.1));
  EXPECT_EQ(content(folder / "h.csv"), "time [s],body/cone/force y [N],balance/water/error [-]\n0,0.1,1e-17\n");
  history.write(0.1 + 0.2, row(-2.5));
  EXPECT_EQ(content(folder / "h.csv").substr(67), "0.30000000000000004,-2.5,1e-17\n");
}

TEST(HistoryFile, QuotesNamesThatWouldBreakTheLine) {
  Folder folder;
  HistoryFile history(world(), folder / "h.csv");
  history.write(0.0, {{"probe, \"left\"", "Pa", 1.0}});
  EXPECT_EQ(content(folder / "h.csv"), "time [s],\"probe, \"\"left\"\" [Pa]\"\n0,1\n");
}

TEST(HistoryFile, NewRunReplacesTheOldFile) {
  Folder folder;
  HistoryFile(world(), folder / "h.csv").write(0.0, row(1));
  HistoryFile(world(), folder / "h.csv").write(5.0, {{"other", "m", 2}});
  EXPECT_EQ(content(folder / "h.csv"), "time [s],other [m]\n5,2\n");
}

TEST(HistoryFile, RestartLeavesTheBytesOfAnUnbrokenRun) {
  Folder folder;
  const auto run = [&](HistoryFile& history, int first, int last) {
    for (int i = first; i <= last; ++i) history.write(i / 3.0, row(1.0 / (1 + i)));
  };
  {
    HistoryFile whole(world(), folder / "whole.csv");
    run(whole, 0, 10);
    HistoryFile begun(world(), folder / "parts.csv");
    run(begun, 0, 8);
  }
  std::ofstream(folder / "parts.csv", std::ios::app) << "3.0000,12";  // cut short by a crash
  HistoryFile continued(world(), folder / "parts.csv", 5 / 3.0);
  run(continued, 6, 10);
  EXPECT_EQ(content(folder / "parts.csv"), content(folder / "whole.csv"));
}

TEST(HistoryFile, RestartWithoutFileStartsANewOne) {
  Folder folder;
  HistoryFile history(world(), folder / "h.csv", 1.0);
  history.write(2.0, {{"x", "m", 1}});
  EXPECT_EQ(content(folder / "h.csv"), "time [s],x [m]\n2,1\n");
}

TEST(HistoryFile, RefusesWhatIsNoHistoryOrHasOtherColumns) {
  Folder folder;
  std::ofstream(folder / "a.csv") << "x,y\n1,2\n";
  EXPECT_EQ(
      message_of<InputError>([&] { HistoryFile(world(), folder / "a.csv", 1.0); }),
      (folder / "a.csv") + ":1: not a history of mudline (the first column is not 'time [s]'); move the file away");
  std::ofstream(folder / "b.csv") << "time [s],x [m]\n1,2\nhello\n";
  EXPECT_EQ(message_of<InputError>([&] { HistoryFile(world(), folder / "b.csv", 1.0); }),
            (folder / "b.csv") + ":3: the row does not begin with a time; move the file away");
  std::ofstream(folder / "c.csv") << "time [s],x [m]\n1,2\n";
  HistoryFile continued(world(), folder / "c.csv", 1.0);
  const std::string message = message_of<InputError>([&] { continued.write(2.0, row(1)); });
  EXPECT_NE(message.find("other columns than this run"), std::string::npos) << message;
  HistoryFile fresh(world(), folder / "d.csv");
  fresh.write(0.0, row(1));
  EXPECT_THROW(fresh.write(1.0, {{"x", "m", 1}}), std::logic_error);
}

}  // namespace
}  // namespace mudline
