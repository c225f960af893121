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

// Lines are written in one piece, so that those of several ranks do not mix.

bool first_rank() { return settings().rank == 0; }

void print(const std::string& line, Level from) {
  if (settings().level >= from) std::cout << printable(line) + '\n' << std::flush;
}

void complain(const char* kind, const std::string& line) { std::cerr << kind + printable(line) + '\n' << std::flush; }

}  // namespace

void configure(int rank, Level level) { settings() = {rank, level}; }

Level level() { return settings().level; }

void info(const std::string& line) {
  if (first_rank()) info_here(line);
}

void detail(const std::string& line) {
  if (first_rank()) print(line, Level::verbose);
}

void warn(const std::string& line) {
  if (first_rank()) warn_here(line);
}

void error(const std::string& line) {
  if (first_rank()) complain("error: ", line);
}

void info_here(const std::string& line) { print(line, Level::normal); }

void warn_here(const std::string& line) { complain("warning: ", line); }

}  // namespace mudline::log
