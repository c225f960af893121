#include "physics/conditions/absorbing.hpp"
#include "physics/conditions/fluid_supply.hpp"
#include "physics/conditions/in_situ_support.hpp"
#include "physics/conditions/prescribed.hpp"
#include "physics/conditions/seepage_face.hpp"
#include "physics/conditions/side_terms.hpp"
#include "physics/conditions/well.hpp"
#include "physics/register.hpp"

namespace mudline {

void register_conditions(Registry<Condition>& registry) {
  registry.add<DisplacementCondition>("displacement", "prescribed displacement of a set, component by component");
  registry.add<VelocityCondition>("velocity", "prescribed velocity of a set with an optional smooth ramp from rest");
  registry.add<FixedCondition>("fixed",
                               "zero displacement of a set in one or both directions (rollers, clamped edges)");
  registry.add<PorePressureCondition>("pore pressure", "prescribed pore pressure, compression positive (0: drained)");
  registry.add<HydrostaticCondition>("hydrostatic pressure", "hydrostatic pore pressure below a water level");
  registry.add<ValueCondition>("value", "prescribed value of any field, e.g. one of a plugin");
  registry.add<Traction>("traction", "force per current area in fixed directions");
  registry.add<SurfacePressure>("pressure", "pressure that follows the current surface");
  registry.add<NormalFlux>("flux", "prescribed outward flux of a scalar field, by default the discharge of pore water");
  registry.add<SeepageFace>("seepage face", "surface open to the air: water leaves where it reaches it, none enters");
  registry.add<FluidSupply>("fluid supply", "water that enters the soil of a region inside, per volume and time");
  registry.add<Well>("well", "water that enters the soil at a point or along a line");
  registry.add<InSituSupport>("in-situ support",
                              "holds a set as it is when it becomes active: along a hole in the initial state, until a "
                              "stage without it");
  registry.add<AbsorbingBoundary>("absorbing", "viscous boundary that lets waves leave; holds the static reaction");
}

}  // namespace mudline
