#include "core/log.hpp"

#include <iostream>

#include "core/text.hpp"

namespace mudline::log {

namespace {

struct Settings {
  int rank = 0;
  Level level = Level::normal;
};

/// The one process-wide setting of the program: a log passed through every call would hide the arguments that matter.
Settings& settings() {
  static Settings instance;
  return instance;
}

void print(const std::string& line, Level from) {
  if (settings().rank == 0 && settings().level >= from) std::cout << printable(line) << std::endl;
}

void complain(const char* kind, const std::string& line) {
  if (settings().rank == 0) std::cerr << kind << printable(line) << std::endl;
}

}  // namespace

void configure(int rank, Level level) { settings() = {rank, level}; }

Level level() { return settings().level; }

void info(const std::string& line) { print(line, Level::normal); }

void detail(const std::string& line) { print(line, Level::verbose); }

void warn(const std::string& line) { complain("warning: ", line); }

void error(const std::string& line) { complain("error: ", line); }

}  // namespace mudline::log
