#pragma once

#include <iosfwd>
#include <string>

namespace mudline::log {

enum class Level { quiet, normal, verbose, debug };

/// Set once by the program: which rank this is (only rank 0 writes) and how much is printed.
void configure(int rank, Level level);
Level level();

/// One line on standard output of rank 0 (normal and above).
void info(const std::string& line);
/// One line on standard output of rank 0 (verbose and above).
void detail(const std::string& line);
/// "warning: ..." on standard error of rank 0, at every level.
void warn(const std::string& line);
/// "error: ..." likewise: what ends the run.
void error(const std::string& line);

}  // namespace mudline::log
