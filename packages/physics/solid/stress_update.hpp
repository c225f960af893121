#pragma once

#include "materials/guarded_law.hpp"
#include "physics/soil.hpp"
#include "physics/term.hpp"

namespace mudline {

/// Stress update of a batch of elements: kinematics, skeleton law, void ratio. Reads the committed state, writes the
/// trial state. Elements per batch are few enough that the staging arrays stay in the cache.
class StressUpdate {
 public:
  static constexpr int batch = 64;  // elements

  StressUpdate(const Soil& soil, const SoilBlock& block, bool want_tangent);
  /// Elements [first, last); returns the number of failed points (law, or an inverted configuration).
  int run(const StepView& view, int first, int last);
  /// d stress / d strain of the last batch: (point of the batch, 36); empty unless wanted.
  const PointView& tangent() const { return tangent_; }
  /// What failed first, material, place, stress and strain increment included; "" where nothing has.
  const std::string& failure() const { return failure_; }
  /// Whether that is an answer of the law's which is none: not finite, or an exception.
  bool law_is_broken() const { return law_is_broken_; }

 private:
  template <int NU, int NP>
  int kinematics(const StepView& view, int first, int last);
  std::string describe(const StepView& view, int first, const LawFailure& failure) const;

  const Soil& soil_;
  const SoilBlock& block_;
  bool want_tangent_;
  PointView strain_, stress_old_, void_ratio_old_, state_old_, tangent_;
  Kokkos::View<int*> failed_;
  std::string failure_;
  bool law_is_broken_ = false;
  Kokkos::View<int*> tensors_;  // first columns of the law's tensor variables
};

}  // namespace mudline
