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

TEST(HistoryFile, TwoColumnsOfOneNameAreRefused) {
  Folder folder;
  HistoryFile history(world(), folder / "h.csv");
  EXPECT_EQ(message_of<InputError>([&] {
              history.write(0.0, {{"alarm/steps", "-", 1}, {"alarm/steps", "s", 2}});
            }),
            (folder / "h.csv") +
                ": two columns of the history would be called 'alarm/steps'; an observer or a state "
                "array of a plugin needs another name");
  EXPECT_FALSE(std::filesystem::exists(folder / "h.csv"));
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
  HistoryMark at_checkpoint;
  {
    HistoryFile whole(world(), folder / "whole.csv");
    run(whole, 0, 10);
    HistoryFile begun(world(), folder / "parts.csv");
    run(begun, 0, 5);
    at_checkpoint = begun.mark();
    run(begun, 6, 8);
  }
  std::ofstream(folder / "parts.csv", std::ios::app) << "3.0000,12";  // cut short by a crash
  HistoryFile continued(world(), folder / "parts.csv", HistoryRestart{at_checkpoint, 5 / 3.0});
  run(continued, 6, 10);
  EXPECT_EQ(content(folder / "parts.csv"), content(folder / "whole.csv"));
}

TEST(HistoryFile, ARestartFromBeforeTheFirstRowStartsAnew) {
  Folder folder;
  HistoryFile history(world(), folder / "h.csv", HistoryRestart{HistoryFile(world(), folder / "h.csv").mark(), 1.0});
  history.write(2.0, {{"x", "m", 1}});
  EXPECT_EQ(content(folder / "h.csv"), "time [s],x [m]\n2,1\n");
}

/// A history of three rows and its mark after two of them.
HistoryMark three_rows(const std::string& path) {
  HistoryFile history(world(), path);
  history.write(0.0, row(1));
  history.write(1.0, row(2));
  const HistoryMark mark = history.mark();
  history.write(2.0, row(3));
  return mark;
}

TEST(HistoryFile, RefusesToGoOnWithRowsLost) {
  Folder folder;
  const std::string path = folder / "h.csv";
  const HistoryMark mark = three_rows(path);
  EXPECT_EQ(mark.rows, 3);  // the header counts as a row
  const std::string good = content(path);
  std::string changed = good;
  changed[good.find("0,1,")] = '5';
  const auto refusal = [&] {
    return message_of<InputError>([&] { HistoryFile(world(), path, HistoryRestart{mark, 1.0}); });
  };
  for (const auto& [text, said] : std::vector<std::pair<std::string, std::string>>{
           {"", "the file is empty"}, {good.substr(0, 70), "was shortened"}, {changed, "was changed"}}) {
    std::ofstream(path, std::ios::binary) << text;
    EXPECT_NE(refusal().find(said), std::string::npos) << refusal();
    EXPECT_EQ(content(path), text);  // it is left as it is
  }
  std::filesystem::remove(path);
  EXPECT_NE(refusal().find("the file is missing, which should hold the 3 lines"), std::string::npos) << refusal();

  std::ofstream(path, std::ios::binary) << good.substr(0, good.find("1,2,"));  // the user accepts the loss
  HistoryFile continued(world(), path, HistoryRestart{mark, 1.0, true});
  continued.write(2.0, row(3));
  EXPECT_EQ(content(path), good.substr(0, good.find("1,2,")) + good.substr(good.find("2,3,")));
}

TEST(HistoryFile, RefusesWhatIsNoHistoryOrHasOtherColumns) {
  Folder folder;
  const HistoryRestart any{{5, 1000, 0}, 1.0, true};
  std::ofstream(folder / "a.csv") << "x,y\n1,2\n";
  EXPECT_EQ(
      message_of<InputError>([&] { HistoryFile(world(), folder / "a.csv", any); }),
      (folder / "a.csv") + ":1: not a history of mudline (the first column is not 'time [s]'); move the file away");
  std::ofstream(folder / "b.csv") << "time [s],x [m]\n1,2\nhello\n";
  EXPECT_EQ(message_of<InputError>([&] { HistoryFile(world(), folder / "b.csv", any); }),
            (folder / "b.csv") + ":3: the row does not begin with a time; move the file away");
  HistoryMark mark = three_rows(folder / "c.csv");
  HistoryFile continued(world(), folder / "c.csv", HistoryRestart{mark, 1.0});
  const std::string message = message_of<InputError>([&] { continued.write(2.0, {{"x", "m", 1}}); });
  EXPECT_NE(message.find("other columns than this run"), std::string::npos) << message;
  HistoryFile accepted(world(), folder / "c.csv", HistoryRestart{mark, 1.0, true});
  accepted.write(2.0, {{"x", "m", 1}});
  EXPECT_EQ(content(folder / "c.csv"), "time [s],x [m]\n2,1\n");
  EXPECT_NE(content(folder / "c.1.csv").find("1,2,1e-17"), std::string::npos);
  HistoryFile fresh(world(), folder / "d.csv");
  fresh.write(0.0, row(1));
  EXPECT_THROW(fresh.write(1.0, {{"x", "m", 1}}), std::logic_error);
}

}  // namespace
}  // namespace mudline
