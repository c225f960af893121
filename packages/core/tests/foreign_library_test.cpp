// Tests of foreign ways to end the program, each in a child process.
#include "core/foreign_library.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>

namespace mudline {
namespace {

using ::testing::ExitedWithCode;

template <class Action>
void under_guard(Action&& action) {
  const ExitGuard guard(0, 1);
  action();
  std::_Exit(77);  // not reached
}

template <class Error, class Value>
void fail(Value value) {
  throw Error(value);
}

TEST(ExitGuardDeathTest, ExitEndsWithOneLineAndCodeOne) {
  EXPECT_EXIT(under_guard([] { std::exit(0); }), ExitedWithCode(1),
              "^error: the program was ended from inside[^\n]*\n$");
}

TEST(ExitGuardDeathTest, ExitAfterTheGuardIsTheProgramsOwn) {
  EXPECT_EXIT(
      {
        { const ExitGuard guard(0, 1); }
        std::exit(3);
      },
      ExitedWithCode(3), "^(==[^\n]*\n)*$");  // only messages of the leak checker about a forked process
}

TEST(ExitGuardDeathTest, SignalsEndWithOneLineAndCodeOne) {
  for (const auto& [number, name] : {std::pair{SIGSEGV, "SIGSEGV"},
                                     {SIGFPE, "SIGFPE"},
                                     {SIGABRT, "SIGABRT"},
                                     {SIGILL, "SIGILL"},
                                     {SIGBUS, "SIGBUS"}})
    EXPECT_EXIT(under_guard([n = number] { raise(n); }), ExitedWithCode(1),
                std::string("^error: the program crashed \\([^\n]*") + name + "\\)[^\n]*\n$");
}

TEST(ExitGuardDeathTest, UncaughtExceptionsEndWithOneLineAndCodeOne) {
  EXPECT_EXIT(under_guard([]() noexcept { fail<std::runtime_error>("first\nlast"); }), ExitedWithCode(1),
              "^error: the program ended by an exception that could not be caught: last\n$");
  EXPECT_EXIT(under_guard([]() noexcept { fail<int>(1); }), ExitedWithCode(1),
              "could not be caught: something that is no");
}

TEST(ExitGuardDeathTest, LongMessagesAreOneLine) {
  EXPECT_EXIT(end_with_error("one\ntwo " + std::string(5000, 'x'), 2), ExitedWithCode(2), "^error: one two x+\n$");
}

TEST(ForeignLibrary, SaysWhyAFileCannotBeLoaded) {
  try {
    ForeignLibrary("/nowhere/none.so");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/none.so"), std::string::npos);
  }
}

}  // namespace
}  // namespace mudline
