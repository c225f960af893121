#pragma once

#include <stdexcept>

namespace mudline {

/// The run cannot go on, through no fault of the input: the disk is full, results may not be written. what() is one
/// line. Thrown alike on every rank; the program prints it once and exits with code 1.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace mudline
