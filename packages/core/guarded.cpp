#include "core/guarded.hpp"

#include <sys/resource.h>

#include <fstream>
#include <new>

#include "core/text.hpp"
#include "core/told.hpp"

namespace mudline {

std::string last_line(const std::string& text) {
  const std::string kept = trim(text);
  return kept.substr(kept.find_last_of('\n') + 1);
}

namespace {

/// Reads a value in kilobytes from a file of /proc and returns it in GiB; 0 where there is none.
double gibibytes(const char* file, const std::string& name) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
    if (line.compare(0, name.size() + 1, name + ":") == 0) return std::stod(line.substr(name.size() + 1)) / (1 << 20);
  return 0;
}

std::string gibibytes_text(double value) { return told(value, "%.3g GiB"); }

/// Whether a line of a message reports exhausted memory, in the words of the standard library, Kokkos or others.
bool tells_of_memory(const std::string& line) {
  for (const char* words : {"std::bad_alloc", "bad_array_new_length", "cannot create std::vector larger than max_size",
                            "failed to allocate", "_M_default_append", "out of memory", "Cannot allocate memory"})
    if (line.find(words) != std::string::npos) return true;
  return false;
}

/// Message that memory is exhausted: how much this process held at most, and what limits it.
std::string memory_exhausted() {
  std::string text = "not enough memory for this model";
  const double held = gibibytes("/proc/self/status", "VmHWM"), all = gibibytes("/proc/meminfo", "MemTotal");
  if (held > 0) text += ": this process held up to " + gibibytes_text(held) + " and asked for more";
  if (all > 0) text += "; the machine has " + gibibytes_text(all);
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    text += ", and `ulimit -v` allows " + gibibytes_text(static_cast<double>(limit.rlim_cur) / (1 << 30));
  return text + "; a coarser mesh or more ranks on more machines need less of each";
}

}  // namespace

std::string what_was_thrown() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return memory_exhausted();
  } catch (const std::exception& error) {
    const std::string line = last_line(error.what());
    if (tells_of_memory(error.what())) return memory_exhausted();  // the error may come from another rank
    return line.empty() ? "an exception without a message" : line;
  } catch (...) {
    return "something that is no std::exception";
  }
}

std::string fault_thrown() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    if (tells_of_memory(error.what())) throw;
    return what_was_thrown();
  } catch (...) {
    return what_was_thrown();
  }
}

}  // namespace mudline
