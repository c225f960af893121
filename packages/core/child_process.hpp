#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mudline {

/// A child process that gave no answer; what() goes on after its name: "crashed (signal 11)". That says nothing of the
/// work's input: somebody may have killed it, or the memory was short.
class ChildLost : public std::runtime_error {
 public:
  ChildLost(const std::string& what, bool after_limit) : std::runtime_error(what), timed_out(after_limit) {}
  const bool timed_out;
};

/// What a child process may do.
struct ChildBounds {
  double limit = 0;               // [s] time for its work; a time in which this process stands still does not count
  bool may_change_files = false;  // and start programs; otherwise see confine_to() in core/confinement.hpp
  bool own_folder = false;        // it works in a folder of its own, where it may write and which goes with it
};

/// Runs `work` in a copy of this process (fork) and gives the bytes that it returns, so that a library that crashes or
/// does not return leaves the program alone. The child changes nothing here, prints nothing and must not communicate by
/// MPI. It ignores signals that are meant for the program, which decides itself what they mean. A child that ends
/// without an answer is tried once more. What it throws is thrown here, an InputError as such, anything else as
/// std::runtime_error, and exhausted memory as std::bad_alloc. Throws ChildLost when it ends without an answer again or
/// takes longer than its time; it is killed then with all that it has started, and also when this process ends.
std::vector<char> in_child_process(const std::function<std::vector<char>()>& work, const ChildBounds& bounds);

}  // namespace mudline
