#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace mudline {

/// The user's input is wrong. what() is one line: "<file>:<line>: <path>: <what was given>; <what is allowed>".
/// Thrown alike on every rank (every rank reads the same deck); the program prints it once and exits with code 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The candidate nearest to `given` by edit distance, or "" when none is near enough to be a likely typo.
std::string nearest(const std::string& given, const std::vector<std::string>& candidates);

/// " (did you mean 'x'?)" or, when nothing is near, "; allowed: a, b, c".
std::string suggestion(const std::string& given, const std::vector<std::string>& candidates);

/// "a, b, c"
std::string join(const std::vector<std::string>& items, const std::string& separator = ", ");

}  // namespace mudline
