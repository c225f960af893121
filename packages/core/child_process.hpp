#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mudline {

/// Thrown for a child process that gave no answer; what() completes a sentence that begins with its name: "crashed
/// (signal 11)". This says nothing about the work's input: somebody may have killed the child, or memory was short.
class ChildLost : public std::runtime_error {
 public:
  ChildLost(const std::string& what, bool after_limit) : std::runtime_error(what), timed_out(after_limit) {}
  const bool timed_out;
};

/// The limits and permissions of a child process.
struct ChildBounds {
  double limit = 0;               // [s] time for its work, without the time in which this process is stopped
  bool may_change_files = false;  // also start programs; otherwise confine_to() applies (core/confinement.hpp)
  bool own_folder = false;        // it works in a folder of its own, where it may write and which is removed with it
};

/// Runs `work` in a copy of this process (fork) and returns its bytes, so that a library that crashes or does not
/// return cannot harm the program. The child changes nothing here, prints nothing and must not communicate by MPI. It
/// ignores signals that are meant for the program, which handles them itself. A child that ends without an answer is
/// tried once more. An exception in the child is thrown here: an InputError as such, anything else as
/// std::runtime_error, and exhausted memory as std::bad_alloc. Throws ChildLost when it ends without an answer again or
/// takes longer than its time; it is killed then with all that it has started, and also when this process ends.
std::vector<char> in_child_process(const std::function<std::vector<char>()>& work, const ChildBounds& bounds);

}  // namespace mudline
