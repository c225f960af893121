#include "simulation/output/history_file.hpp"

#include "core/errors.hpp"
#include "core/run_error.hpp"
#include "simulation/tests/output_fixture.hpp"

namespace mudline {
namespace {

using output_test::content;
using output_test::Folder;
using output_test::world;

TEST(HistoryFile, RankZeroWritesOnceAndErrorsReachEveryRank) {
  Folder folder;
  const auto comm = world();
  const double value = comm->getRank() == 0 ? 1.5 : -7.0;
  HistoryMark mark;
  {
    HistoryFile history(comm, folder / "h.csv");
    history.write(0.0, {{"x", "m", value}});
    mark = history.mark();
    history.write(1.0, {{"x", "m", value}});
  }
  {
    HistoryFile continued(comm, folder / "h.csv", HistoryRestart{mark, 0.5});
    continued.write(2.0, {{"x", "m", value}});
    comm->barrier();
    EXPECT_EQ(content(folder / "h.csv"), "time [s],x [m]\n0,1.5\n2,1.5\n");
  }
  EXPECT_THROW(HistoryFile(comm, folder / "missing/h.csv").write(0.0, {{"x", "m", 1}}), RunError);
  HistoryFile other(comm, folder / "h.csv", HistoryRestart{mark, 0.5});
  EXPECT_THROW(other.write(3.0, {{"y", "m", 1}}), InputError);
}

}  // namespace
}  // namespace mudline
