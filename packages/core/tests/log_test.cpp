#include "core/log.hpp"

#include <gtest/gtest.h>

namespace mudline {
namespace {

std::string output_of(int rank, log::Level level) {
  log::configure(rank, level);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  log::info("info");
  log::detail("detail");
  log::warn("careful");
  const std::string text = testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr();
  log::configure(0, log::Level::normal);
  return text;
}

TEST(Log, LevelsSelectWhatIsPrinted) {
  EXPECT_EQ(output_of(0, log::Level::quiet), "warning: careful\n");
  EXPECT_EQ(output_of(0, log::Level::normal), "info\nwarning: careful\n");
  EXPECT_EQ(output_of(0, log::Level::verbose), "info\ndetail\nwarning: careful\n");
  EXPECT_EQ(output_of(0, log::Level::debug), "info\ndetail\nwarning: careful\n");
}

TEST(Log, OtherRanksAreSilent) { EXPECT_EQ(output_of(1, log::Level::debug), ""); }

TEST(Log, EveryRankTellsWhatOnlyItKnows) {
  log::configure(1, log::Level::normal);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  log::info_here("here");
  log::warn_here("careful");
  log::configure(0, log::Level::normal);
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(),
            "here\nwarning: careful\n");
}

}  // namespace
}  // namespace mudline
