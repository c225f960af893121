#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>

#include "core/child_process.hpp"
#include "core/errors.hpp"

namespace mudline {
namespace {

std::vector<char> bytes(const std::string& text) { return {text.begin(), text.end()}; }

/// What is said of a child that is lost.
std::string lost(const std::function<std::vector<char>()>& work, double limit = 60) {
  try {
    in_child_process(work, limit);
  } catch (const ChildLost& error) {
    return std::string(error.what()) + (error.timed_out ? ", by the limit" : "");
  }
  return "";
}

TEST(ChildProcess, GivesWhatItReturnsAndChangesNothing) {
  int here = 1;
  const std::vector<char> much(10000000, 'x');
  EXPECT_EQ(in_child_process([&] { return here = 2, much; }, 60), much);
  EXPECT_EQ(here, 1);
  EXPECT_TRUE(in_child_process([] { return std::vector<char>{}; }, 60).empty());
}

TEST(ChildProcess, ItsErrorsAreThrown) {
  const auto input_error = [] { in_child_process([]() -> std::vector<char> { throw InputError("deck.xml:3"); }, 60); };
  try {
    input_error();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "deck.xml:3");
  }
  EXPECT_THROW(in_child_process([]() -> std::vector<char> { throw std::logic_error("no"); }, 60), std::runtime_error);
  EXPECT_THROW(in_child_process([]() -> std::vector<char> { throw 3; }, 60), std::runtime_error);
}

TEST(ChildProcess, CrashesAndEndings) {
  EXPECT_EQ(lost([]() -> std::vector<char> { std::abort(); }), "crashed (signal 6)");
  EXPECT_EQ(lost([]() -> std::vector<char> { return std::raise(SIGSEGV), bytes(""); }), "crashed (signal 11)");
  EXPECT_EQ(lost([]() -> std::vector<char> { ::_exit(0); }), "broke off");
}

TEST(ChildProcess, TimeLimit) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(lost([] { return ::sleep(600), bytes(""); }, 0.2),
            "had not finished after 0.2 s and was stopped, by the limit");
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 60);
}

}  // namespace
}  // namespace mudline
