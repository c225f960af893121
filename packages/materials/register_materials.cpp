#include "materials/register_materials.hpp"

#include "materials/fluid/water.hpp"
#include "materials/permeability.hpp"
#include "materials/skeleton/drucker_prager.hpp"
#include "materials/skeleton/hypoplasticity.hpp"
#include "materials/skeleton/linear_elastic.hpp"
#include "materials/skeleton/modified_cam_clay.hpp"
#include "materials/skeleton/mohr_coulomb.hpp"
#include "materials/skeleton/neo_hookean.hpp"
#include "materials/skeleton/s_clay1s.hpp"
#include "materials/skeleton/tresca.hpp"
#include "materials/skeleton/umat.hpp"
#include "materials/skeleton/von_mises.hpp"

namespace mudline {

void register_materials(Registry<Skeleton>& skeletons, Registry<Fluid>& fluids,
                        Registry<Permeability>& permeabilities) {
  skeletons.add<PointwiseSkeleton<LinearElastic>>("linear elastic", "Isotropic linear elasticity in rate form");
  skeletons.add<PointwiseSkeleton<ModifiedCamClay>>("modified cam clay",
                                                    "Critical state clay with pressure-dependent elasticity");
  skeletons.add<PointwiseSkeleton<AutomaticTangent<MohrCoulomb>>>(
      "mohr-coulomb", "Frictional soil with cohesion, dilation, tension cut-off");
  skeletons.add<PointwiseSkeleton<AutomaticTangent<Tresca>>>(
      "tresca", "Undrained strength with depth, strain rate and softening");
  skeletons.add<PointwiseSkeleton<AutomaticTangent<DruckerPrager>>>(
      "drucker-prager", "Circular frictional cone, matched to Mohr-Coulomb");
  skeletons.add<PointwiseSkeleton<AutomaticTangent<NeoHookean>>>("neo-hookean",
                                                                 "Compressible elasticity at large stretch");
  skeletons.add<PointwiseSkeleton<AutomaticTangent<VonMises>>>("von mises",
                                                               "Deviatoric yield with isotropic hardening");
  skeletons.add<PointwiseSkeleton<AutomaticTangent<Hypoplasticity>>>(
      "hypoplasticity", "Sand from loose to dense in one set of parameters, with intergranular strain");
  skeletons.add<PointwiseSkeleton<SClay1sByParts>>(
      "s-clay1s", "Natural clay: Cam Clay with fabric, bonding and creep, each by its numbers");
  skeletons.add<Umat>("umat", "A subroutine UMAT as finite-element programs take it, from a shared library");
  fluids.add<Water>("water", "Slightly compressible or incompressible water");
  permeabilities.add<PermeabilityOfForm<Conductivity::Form::constant>>("constant",
                                                                       "The same conductivity at every void ratio");
  permeabilities.add<PermeabilityOfForm<Conductivity::Form::kozeny_carman>>(
      "kozeny-carman", "Conductivity follows the void ratio by Kozeny-Carman");
  permeabilities.add<PermeabilityOfForm<Conductivity::Form::log_linear>>(
      "log-linear", "The logarithm of conductivity is linear in the void ratio");
}

}  // namespace mudline
