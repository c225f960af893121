#pragma once

#include <Teuchos_Time.hpp>

namespace mudline {

/// Adds the wall-clock seconds until it goes out of scope.
class Stopwatch {
 public:
  explicit Stopwatch(double& total) : total_(total), start_(Teuchos::Time::wallTime()) {}
  ~Stopwatch() { total_ += Teuchos::Time::wallTime() - start_; }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& total_;
  double start_;
};

}  // namespace mudline
