#include "physics/biot/darcy.hpp"

#include <stdexcept>

namespace mudline {

namespace {

/// Temperature at the points of a block that has it among its fields: (point; value, change in the step) [degC].
PointView temperatures(const SoilBlock& b, int place, const LoopLevel& level) {
  PointView result("temperature", static_cast<std::size_t>(b.elements) * b.points, 2);
  for (int e = 0; e < b.elements; ++e)
    for (int q = 0; q < b.points; ++q) {
      const double value = b.scalar_at(e, q, place, level.value);
      result(e * b.points + q, 0) = value;
      result(e * b.points + q, 1) = value - b.scalar_at(e, q, place, level.value_old);
    }
  return result;
}

}  // namespace

Darcy::Darcy(const Soil& soil, const SoilBlock& block, const StepView& view, const FieldBlock& fields,
             const LoopLevel& level)
    : mixture(mixtures_of(soil, block, *view.committed, fields)),
      lift(soil.excess ? soil.any_of(block).fluid->density() : 0.0),
      void_ratio(view.committed->arrays[block.void_ratio]),
      ratios(block.permeability >= 0 ? view.committed->arrays[block.permeability] : PointView()),
      numbers(block.conductivity >= 0 ? view.committed->arrays[block.conductivity] : PointView()) {
  if (place_of_scalar(fields, soil.pressure) < 0)
    throw std::logic_error("Darcy's law is asked for without a pore pressure among the fields");
  if (fields.points != block.points) throw std::logic_error("Darcy's law is asked for at other points than the soil's");
  const Point g = soil.gravity(view.balance.time);
  for (int i = 0; i < 3; ++i) gravity[i] = g[i];
  if (const int place = place_of_scalar(block, soil.temperature);
      place >= 0 && place_of_scalar(fields, soil.temperature) < 0)
    elsewhere = temperatures(block, place, level);
}

}  // namespace mudline
