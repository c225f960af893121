#pragma once

#include "framework/medium.hpp"
#include "framework/physics.hpp"
#include "physics/biot/darcy.hpp"

namespace mudline {

/// The soil of the model, for a physics whose field is in the pore water. InputError through `section` without one.
inline std::shared_ptr<Soil> soil_with_water(const PhysicsContext& context, const Section& section) {
  const auto soil = context.shared.find<Soil>();
  if (!soil || soil->pressure < 0)
    section.fail("there is no pore water: name a physics of saturated soil before this one", "type");
  soil->require_saturated(section, "type");
  return soil;
}

/// The term of a medium whose scalar fields are the pore pressure and, as number 1, another field: something in the
/// pore water. It sees the flow and the porosity of the water by Darcy's law, and adds nothing to the balance of the
/// water. make(view, block of soil, darcy) gives the medium in a step.
template <class Make>
std::unique_ptr<Term> in_pore_water(std::string name, std::shared_ptr<const Soil> soil, int field, Make make) {
  const Geometry geometry = soil->geometry;
  const auto blocks = soil->blocks_with(field);
  const auto laws = [soil, blocks, make](const StepView& view, auto&& add) {
    if (!view.flow) return;
    for (std::size_t i = 0; i < blocks->size(); ++i) {
      const FieldBlock& fields = (*blocks)[i];
      const SoilBlock& b = soil->blocks[i];
      const auto at = [&](const LoopLevel& level) { return make(view, b, Darcy(*soil, b, view, fields, level)); };
      const LoopLevel end = end_level(view, fields), balance = loop_level(view, view.balance, fields);
      add(fields, end, stored_law(at(end)));
      add(fields, balance, flow_law(at(balance)));
    }
  };
  return loop_term(std::move(name), Role::balance, geometry, laws, blocks);
}

}  // namespace mudline
