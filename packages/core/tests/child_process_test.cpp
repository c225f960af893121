#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <new>
#include <thread>

#include "core/child_process.hpp"
#include "core/confinement.hpp"
#include "core/errors.hpp"

namespace mudline {
namespace {

std::vector<char> bytes(const std::string& text) { return {text.begin(), text.end()}; }

/// What is said of a child that is lost.
std::string lost(const std::function<std::vector<char>()>& work, double limit = 60) {
  try {
    in_child_process(work, {limit});
  } catch (const ChildLost& error) {
    return std::string(error.what()) + (error.timed_out ? ", by the limit" : "");
  }
  return "";
}

TEST(ChildProcess, GivesWhatItReturnsAndChangesNothing) {
  int here = 1;
  const std::vector<char> much(10000000, 'x');
  EXPECT_EQ(in_child_process([&] { return here = 2, much; }, {60}), much);
  EXPECT_EQ(here, 1);
  EXPECT_TRUE(in_child_process([] { return std::vector<char>{}; }, {60}).empty());
}

TEST(ChildProcess, ItsErrorsAreThrown) {
  const auto input_error = [] {
    in_child_process([]() -> std::vector<char> { throw InputError("deck.xml:3"); }, {60});
  };
  try {
    input_error();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "deck.xml:3");
  }
  EXPECT_THROW(in_child_process([]() -> std::vector<char> { throw std::logic_error("no"); }, {60}), std::runtime_error);
  EXPECT_THROW(in_child_process([]() -> std::vector<char> { throw 3; }, {60}), std::runtime_error);
}

TEST(ChildProcess, CrashesAndEndings) {
  EXPECT_EQ(lost([]() -> std::vector<char> { std::abort(); }), "crashed (signal 6)");
  EXPECT_EQ(lost([]() -> std::vector<char> { return std::raise(SIGSEGV), bytes(""); }), "crashed (signal 11)");
  EXPECT_EQ(lost([]() -> std::vector<char> { ::_exit(0); }), "broke off");
}

/// Every signal that someone may send to a run and all that belongs to it.
const int for_the_program[] = {SIGHUP,  SIGINT,  SIGQUIT,   SIGUSR1, SIGUSR2, SIGPIPE, SIGALRM,
                               SIGTERM, SIGPROF, SIGVTALRM, SIGXCPU, SIGXFSZ, SIGRTMIN};

TEST(ChildProcess, SignalsAreForTheProgram) {
  const auto interrupted = [] {
    for (const int signal : for_the_program) {
      ::kill(::getpid(), signal);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return bytes("done");
  };
  EXPECT_EQ(in_child_process(interrupted, {60}), bytes("done"));
  EXPECT_EQ(in_child_process([] { return bytes(::getpgrp() == ::getpid() ? "own" : "of the program"); }, {60}),
            bytes("own"));
}

TEST(ChildProcess, OneThatIsKilledIsTriedOnceMore) {
  const PrivateFolder folder;
  const std::string mark = folder.path() + "/tried";
  const auto killed_at_first = [&mark] {
    if (!std::ofstream(mark, std::ios::in)) {
      std::ofstream{mark};
      std::raise(SIGKILL);
    }
    return bytes("second");
  };
  EXPECT_EQ(in_child_process(killed_at_first, {60, true}), bytes("second"));
  EXPECT_EQ(lost([]() -> std::vector<char> { return std::raise(SIGKILL), bytes(""); }), "was killed (signal 9)");
}

TEST(ChildProcess, ATimeInWhichTheProgramStandsStillDoesNotCount) {
  const pid_t self = ::getpid();
  const pid_t waker = ::fork();
  if (waker == 0) {
    ::kill(self, SIGSTOP);
    ::sleep(4);
    ::kill(self, SIGCONT);
    ::_exit(0);
  }
  const auto work = [] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    return bytes("done");
  };
  EXPECT_EQ(in_child_process(work, {3}), bytes("done"));
  ::waitpid(waker, nullptr, 0);
}

/// Whether a process has ended, at the latest after a while.
bool ends(pid_t process) {
  for (int i = 0; i < 3000; ++i) {
    std::ifstream status("/proc/" + std::to_string(process) + "/stat");
    std::string text, state;
    if (!std::getline(status, text)) return true;
    if (text.substr(text.rfind(')') + 2, 1) == "Z") return true;  // nobody has asked for its end yet
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// Work without an end that has started another process, whose number it writes to a file.
std::vector<char> start_another_and_wait(const std::string& file) {
  const pid_t another = ::fork();
  if (another != 0) {
    std::ofstream(file + ".part") << another << std::endl;
    std::filesystem::rename(file + ".part", file);
  }
  for (;;) ::pause();
}

pid_t number_in(const std::string& file) {
  pid_t number = 0;
  for (int i = 0; i < 3000; ++i) {
    if (std::ifstream(file) >> number) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return number;
}

TEST(ChildProcess, WhatItHasStartedEndsWithIt) {
  const PrivateFolder folder;
  const std::string file = folder.path() + "/another";
  EXPECT_THROW(in_child_process([&] { return start_another_and_wait(file); }, {3, true}), ChildLost);
  ASSERT_GT(number_in(file), 0);
  EXPECT_TRUE(ends(number_in(file)));
}

TEST(ChildProcess, AllEndsWithTheProgram) {
  const PrivateFolder folder;
  const std::string file = folder.path() + "/another";
  const pid_t program = ::fork();
  if (program == 0) {
    in_child_process([&] { return start_another_and_wait(file); }, {600, true});
    ::_exit(0);
  }
  const pid_t another = number_in(file);
  ::kill(program, SIGKILL);
  ::waitpid(program, nullptr, 0);
  ASSERT_GT(another, 0);
  EXPECT_TRUE(ends(another));
}

TEST(ChildProcess, WritesInItsOwnFolderOnly) {
  if (!can_confine_files()) GTEST_SKIP() << "this kernel does not confine files";
  const PrivateFolder folder;
  const std::string kept = folder.path() + "/kept";
  std::ofstream(kept) << "precious";
  const auto harmful = [&] {
    std::string done;
    const auto note = [&](bool succeeded, const char* what) { done += succeeded ? std::string(what) + " " : ""; };
    note(bool(std::ofstream(kept)), "overwrites");
    note(bool(std::ofstream(folder.path() + "/new")), "creates");
    note(::mkdir((folder.path() + "/folder").c_str(), 0700) == 0, "makes-folder");
    note(::unlink(kept.c_str()) == 0, "removes");
    note(::rename(kept.c_str(), "mine") == 0, "moves");
    note(::truncate(kept.c_str(), 0) == 0, "truncates");
    note(std::system("true") == 0, "starts");
    note(::socket(AF_INET, SOCK_STREAM, 0) >= 0, "connects");
    note(bool(std::ofstream("here") << "text"), "writes-here");
    std::string word;
    note(bool(std::ifstream(kept) >> word) && word == "precious", "reads");
    return bytes(done);
  };
  const auto answer = [&](const ChildBounds& bounds) {
    const std::vector<char> text = in_child_process(harmful, bounds);
    return std::string(text.begin(), text.end());
  };
  EXPECT_EQ(answer({60, false, true}), "writes-here reads ");
  EXPECT_EQ(answer({60, false, false}), "reads ");
}

TEST(ChildProcess, ExhaustedMemory) {
  EXPECT_THROW(in_child_process([]() -> std::vector<char> { throw std::bad_alloc(); }, {60}), std::bad_alloc);
}

TEST(ChildProcess, TimeLimit) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(lost([] { return ::sleep(600), bytes(""); }, 0.2),
            "had not finished after 0.2 s and was stopped, by the limit");
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 60);
}

}  // namespace
}  // namespace mudline
