#pragma once

#include <iosfwd>
#include <string>

namespace mudline::log {

enum class Level { quiet, normal, verbose, debug };

/// Sets this process' rank (only rank 0 writes) and how much is printed; the program calls it once.
void configure(int rank, Level level);
Level level();

/// Writes one line on standard output of rank 0 (normal and above).
void info(const std::string& line);
/// Writes one line on standard output of rank 0 (verbose and above).
void detail(const std::string& line);
/// Writes "warning: ..." on standard error of rank 0, at every level.
void warn(const std::string& line);
/// Writes "error: ..." in the same way, for an error that ends the run.
void error(const std::string& line);

/// The same as info() and warn(), of whichever rank calls: for what only this rank knows.
void info_here(const std::string& line);
void warn_here(const std::string& line);

}  // namespace mudline::log
