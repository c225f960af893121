#pragma once

#include <string>

#include "framework/loop_level.hpp"
#include "materials/guarded_law.hpp"
#include "physics/soil_points.hpp"

namespace mudline {

/// Input of the laws at the points of a batch: (row of the batch, component).
struct LawInput {
  PointView strain, stress_old, void_ratio_old, state_old;  // tensors rotated with the material
  Kokkos::View<int**> tensors;  // first columns of the tensor variables of each material's law; -1: no more
  PointView surroundings;       // if a law asks for them, else empty
  PointView dilatation;         // volume strain of all points of the block beyond that of the motion; empty: none
};

/// Runs the laws over batches of elements: computes strains from the motion and writes stress, state and void ratio of
/// the trial state.
class StressUpdate {
 public:
  enum class Tangent { none, batch, all };
  /// `tangent`: for which points the tangent is stored; `all`: array for the tangents of all points.
  StressUpdate(const Soil& soil, const SoilBlock& block, const StepView& view, Tangent tangent,
               const PointView& all = PointView());
  /// Runs elements [first, last); returns the number of failed points (failure of the law, or an inverted
  /// configuration).
  int run(int first, int last);
  /// The laws and the void ratio see this volume strain beyond that of the motion: (point of the block, 0).
  void add_dilatation(const PointView& beyond) { input_.dilatation = beyond; }
  /// d stress / d strain of the last batch: (point of the batch, 36); empty unless that is wanted.
  const PointView& tangent() const { return tangent_; }
  const LoopLevel& level() const { return level_; }
  /// The first failure with material, position, stress and strain increment; "" if there is none.
  const std::string& failure() const { return failure_; }
  /// Whether that failure is an error of the law: a result that is not finite, or an exception.
  bool law_is_broken() const { return law_is_broken_; }

 private:
  int stage_motion(int first, int last);
  /// Runs the law of one material on points [begin, end) of a batch whose first point is this row of the block.
  int run_law(const SoilMaterial& material, int row, int begin, int end);
  std::string describe(const SoilMaterial& material, int row, int point, const LawFailure& failure) const;

  const Soil& soil_;
  const SoilBlock& block_;
  const StepView& view_;
  const SoilPoints points_;
  LoopLevel level_;
  Tangent wanted_;
  LawInput input_;
  PointView tangent_;
  Kokkos::View<int*> failed_;
  std::string failure_;
  bool law_is_broken_ = false;
};

}  // namespace mudline
