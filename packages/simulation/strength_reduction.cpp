#include "simulation/strength_reduction.hpp"

namespace mudline {

void StrengthReduction::parameters(Parameters& p) {
  p.required("largest factor", largest, "-", open(1, 1000),
             "the factor that divides the strengths grows from 1 to this in the stage's duration");
  p.add("resolution", resolution, "-", open(0, 1),
        "the stage ends when no equilibrium is found for a growth of the factor by less than this");
  p.add("displacement limit", displacement_limit, "-", positive(),
        "a step whose largest displacement, over the height of the soil, is more than this times the growth of the "
        "factor finds no equilibrium");
}

}  // namespace mudline
