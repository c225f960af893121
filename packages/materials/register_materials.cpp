#include "materials/register_materials.hpp"

#include "materials/fluid/water.hpp"
#include "materials/permeability/constant.hpp"
#include "materials/permeability/kozeny_carman.hpp"
#include "materials/permeability/log_linear.hpp"
#include "materials/skeleton/linear_elastic.hpp"
#include "materials/skeleton/modified_cam_clay.hpp"
#include "materials/skeleton/umat.hpp"

namespace mudline {

void register_materials(Registry<Skeleton>& skeletons, Registry<Fluid>& fluids,
                        Registry<Permeability>& permeabilities) {
  skeletons.add<PointwiseSkeleton<LinearElastic>>("linear elastic", "Isotropic linear elasticity in rate form");
  skeletons.add<PointwiseSkeleton<ModifiedCamClay>>("modified cam clay",
                                                    "Critical state clay with pressure-dependent elasticity");
  skeletons.add<Umat>("umat", "A subroutine UMAT as finite-element programs take it, from a shared library");
  fluids.add<Water>("water", "Slightly compressible or incompressible water");
  permeabilities.add<ConstantPermeability>("constant", "The same conductivity at every void ratio");
  permeabilities.add<KozenyCarmanPermeability>("kozeny-carman", "Conductivity follows the void ratio by Kozeny-Carman");
  permeabilities.add<LogLinearPermeability>("log-linear", "The logarithm of conductivity is linear in the void ratio");
}

}  // namespace mudline
