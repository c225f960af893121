#pragma once

#include <memory>

#include "framework/term.hpp"
#include "physics/soil.hpp"

namespace mudline {

/// The water that is missing where air fills a part of the pores, in soil with a retention:
///   R_p -= [int Np n (1 - S(p at the node)) dv at the end, less that at the start of the step] / dt.
/// The saturation is taken at the nodes (a lumped storage): with that of the points a wetting front makes the soil
/// before it drier than it was. Source: Celia, Bouloutas and Zarba 1990, WRR 26.
std::unique_ptr<Term> pore_air(std::shared_ptr<const Soil> soil);

}  // namespace mudline
