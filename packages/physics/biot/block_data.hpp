#pragma once

#include "algebra/linear_solver.hpp"
#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// Soil data for the block preconditioner at the present linearisation point. Collective.
BlockData soil_block_data(const Soil& soil, const StepView& view, Kokkos::View<const char*> constrained);

}  // namespace mudline
