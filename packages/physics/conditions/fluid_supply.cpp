#include "physics/conditions/fluid_supply.hpp"

#include "framework/element_loop.hpp"

namespace mudline {

namespace {

struct Supply : PointLaw {
  static constexpr int fields = 1;
  static constexpr bool storages = true, motion = false, scalars = false, rates = false;
  ConstPointView rate;

  template <class C, int S, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const PointFields<C, S, T>&, PointBalance<C, S, T>& out) const {
    out.storage[0] = -rate(row, 0);
  }
};

}  // namespace

std::shared_ptr<const Soil> supplied_soil(const ConditionContext& context, const Section& section) {
  const std::shared_ptr<const Soil> soil = context.shared.find<Soil>();
  if (!soil || soil->pressure < 0) section.fail("this model has no pore water", "type");
  if (soil->temperature >= 0)
    section.fail(
        "water supplied inside the soil would need a temperature, which this condition does not have; it is for "
        "'biot'",
        "type");
  return soil;
}

void FluidSupply::parameters(Parameters& p) {
  p.add("region", region_, "mesh region that is supplied; without it the whole mesh");
  p.required(
      "rate", rate_, "1/s",
      "volume of water that enters, per initial volume of soil and time; negative: it is taken out; a function of "
      "time and initial position");
}

void FluidSupply::bind(const ConditionContext& context, const Section& section) {
  soil_ = supplied_soil(context, section);
  if (!region_.empty()) require_region(context.space.mesh(), section, "region", region_);
  parts_.clear();
  for (const SoilBlock& block : soil_->blocks)
    if (region_.empty() || context.space.mesh().blocks()[block.block].region == region_)
      parts_.push_back({&block, PointView("supply", static_cast<std::size_t>(block.elements) * block.points, 1)});
}

int FluidSupply::residual(const StepView& view, const ResidualView& f) {
  if (!view.flow) return 0;
  const ConstCoordinateView initial = soil_->space->mesh().coordinates();
  int failures = 0;
  for (const auto& [block, rate] : parts_) {
    for (int e = 0; e < block->elements; ++e)
      for (int q = 0; q < block->points; ++q)
        rate(e * block->points + q, 0) = rate_(view.balance.time, block->place(e, q, initial));
    const LoopLevel level = loop_level(view, {view.balance.time, initial, 0.0}, *block);
    failures += add_residual(soil_->geometry, *block, level, Supply{{}, rate}, f);
  }
  return failures;
}

}  // namespace mudline
