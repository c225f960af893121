#pragma once

#include <vector>

#include "ale/remap.hpp"

namespace mudline {

/// The rules of the columns of a block's point data that are no fields, around a remap of all columns as fields.
class PointRules {
 public:
  explicit PointRules(const std::vector<StateVariable>& variables);
  /// Columns that are transferred by a rule.
  std::vector<int> of(Transfer rule) const;
  /// Before the remap: divides the totals in a table of gather_points by the points' volumes, and takes their bounds,
  /// which are those of the totals, from the variables.
  void to_densities(const BlockPoints& at, Geometry geometry, std::vector<double>& table,
                    std::vector<StateVariable>& variables) const;
  /// After it: makes totals of densities again and scales them to the old sum over all ranks. Where that came to
  /// nothing, the sum is spread evenly. Collective.
  void to_totals(const PointTransfer& transfer, Geometry geometry) const;
  /// Sets the nearest columns of this rank's points to those of the nearest point of the old element that they are in.
  void take_nearest(const PointTransfer& transfer) const;

 private:
  std::vector<Transfer> rules_;  // (column)
};

}  // namespace mudline
