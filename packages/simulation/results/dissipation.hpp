#pragma once

#include <string>

#include "simulation/results/result_table.hpp"

namespace mudline {

/// Name of the mean excess pore pressure on the wall of a body that rests.
constexpr const char* wall_pressure = "excess pore pressure on the wall";

/// Whether a body rested through a stage with water at its wall, by the results.
bool rested(const ResultTable& results, const std::string& stage, const std::string& body);

/// The results of how an excess pore pressure dissipates in a stage: the highest one, that at the end, and how long
/// after the stage's begin a half and nine tenths of the highest were gone.
class Dissipation {
 public:
  /// `of`: what has the pressure; `pressure`: its name.
  Dissipation(std::string stage, std::string of, std::string pressure, ResultTable& to);
  /// After a step of `dt` [s] that ends `time` [s] after the stage's begin: the pressure `now` [Pa]. It may be the
  /// highest so far, as may one of the start, `other` [Pa]. Times are linear between steps in the logarithm of time;
  /// a pressure that has grown starts anew. Returns whether it has.
  bool follow(double time, double dt, double now, double other = 0);
  /// Removes these results.
  void forget();

 private:
  const std::string stage_, of_, pressure_;
  ResultTable& to_;
};

}  // namespace mudline
