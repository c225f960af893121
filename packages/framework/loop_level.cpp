#include "framework/loop_level.hpp"

namespace mudline {

LoopLevel::LoopLevel() = default;
LoopLevel::LoopLevel(const LoopLevel&) = default;
LoopLevel& LoopLevel::operator=(const LoopLevel&) = default;
LoopLevel::~LoopLevel() = default;

LoopLevel loop_level(const StepView& view, const Level& level, const FieldBlock& block) {
  LoopLevel at;
  at.x = level.x;
  at.value_old = view.value_old;
  at.value_end = view.value_end;
  at.value = view.value;
  at.rate = view.rate;
  at.acceleration = view.acceleration;
  at.open = view.open;
  at.outside = view.outside;
  at.geometry_weight = level.geometry_weight;
  if (block.moves()) at.displacement = view.sensitivity[block.displacement];
  for (int s = 0; s < block.scalars; ++s) at.scalar[s] = view.sensitivity[block.scalar[s]];
  return at;
}

LoopLevel end_level(const StepView& view, const FieldBlock& block) {
  LoopLevel at =
      loop_level(view, {view.time_end, view.x_end, view.kind == StepView::Kind::initial_rates ? 0.0 : 1.0}, block);
  at.value = view.value_end;
  for (Sensitivity& s : at.scalar) s.value = 1;
  return at;
}

LoopLevel level_of(const State& state) {
  LoopLevel at;
  at.x = state.coordinates;
  at.value = at.value_old = at.value_end = state.value;
  at.rate = state.rate;
  at.acceleration = state.acceleration;
  return at;
}

}  // namespace mudline
