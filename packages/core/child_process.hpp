#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mudline {

/// A child process that gave no answer; what() goes on after its name: "crashed (signal 11)".
class ChildLost : public std::runtime_error {
 public:
  ChildLost(const std::string& what, bool after_limit) : std::runtime_error(what), timed_out(after_limit) {}
  const bool timed_out;
};

/// Runs `work` in a copy of this process (fork) and gives the bytes that it returns, so that a library that crashes or
/// does not return leaves the program alone. The child changes nothing here, prints nothing and must not communicate by
/// MPI. What it throws is thrown here, an InputError as such, anything else as std::runtime_error. Throws ChildLost
/// when it ends without an answer or takes longer than `limit` seconds; it is killed then, and also when this process
/// ends.
std::vector<char> in_child_process(const std::function<std::vector<char>()>& work, double limit);

}  // namespace mudline
