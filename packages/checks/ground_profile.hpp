#pragma once

#include <string>
#include <vector>

#include "simulation/model.hpp"

namespace mudline {

/// The ground of a model at its start, along a vertical line: what the initial state and the laws make of it. There is
/// a row for each element that the line crosses, with the values of that element's point which is nearest to the line.
class GroundProfile {
 public:
  /// `at`: a place on the line. InputError where the line misses the mesh or the model has no soil. For one rank.
  GroundProfile(const Model& model, const Point& at);
  /// The place in the middle of the mesh, from which a line may be drawn.
  static Point middle(const Model& model);

  /// Writes all columns in SI units, from the top down: "depth [m],...,material". A value that a law does not have is
  /// left empty. RunError.
  void write(const std::string& path) const;
  /// The columns that engineers look for, in kPa, at most `rows` of the rows, for a terminal.
  std::string table(int rows) const;

 private:
  struct Column {
    std::string name, unit;
    std::vector<double> values;  // by row; NaN: there is none
  };
  /// The column of this name, which is made where it is new.
  Column& column(const std::string& name, const std::string& unit);
  void add(const std::string& name, const std::string& unit, double value) { column(name, unit).values.back() = value; }
  void add_row(const Soil& soil, const SoilBlock& block, const State& state, int element, int point);
  /// Sorts the rows from the top down and drops columns without a value.
  void tidy();

  double surface_ = -1e300;  // [m] height of the highest node, from which depths are counted
  std::vector<Column> columns_;
  std::vector<std::string> materials_;  // by row
};

}  // namespace mudline
