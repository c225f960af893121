#include "materials/retention.hpp"

namespace mudline {

void Retention::parameters(Parameters& p) {
  p.choice("type", form_, {{"van genuchten", Form::van_genuchten}, {"exponential", Form::exponential}},
           "van genuchten: S_e = (1 + (s/s_0)^n)^(1/n - 1), with the relative permeability of Mualem; exponential: S_e "
           "= k_r = exp(-s/s_0)");
  p.required("reference suction", reference_suction_, "Pa", positive(),
             "s_0: 1/alpha of van Genuchten; coarse soils have little, clays much");
  p.add("shape", shape_, "-", open(1, 100), "n of van Genuchten: the larger, the faster the pores empty");
  p.add("connectivity", connectivity_, "-", closed(-2, 10), "l of Mualem's relative permeability, S_e^l (...)^2");
  p.add("residual saturation", residual_, "-", half_open(0, 1), "share of the pores whose water no suction takes away");
  p.add("least relative permeability", least_permeability_, "-", closed(0, 1),
        "of dry soil, so that its pore pressure is determined");
  acts_ = !p.documenting();
  if (p.documenting() || form_ == Form::van_genuchten) return;
  for (const char* name : {"shape", "connectivity"})
    if (p.given(name)) p.deck().fail("has no effect with 'type' = 'exponential'", name);
}

}  // namespace mudline
