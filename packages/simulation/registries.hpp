#pragma once

#include <string>
#include <vector>

#include "ale/interior_motion.hpp"
#include "ale/remap.hpp"
#include "algebra/linear_solver.hpp"
#include "bodies/rigid_body.hpp"
#include "contact/contact.hpp"
#include "integrator/time_scheme.hpp"
#include "materials/point/point_test.hpp"
#include "materials/register_materials.hpp"
#include "physics/register.hpp"
#include "simulation/observer.hpp"
#include "simulation/stage_end.hpp"

namespace mudline {

/// All types that a deck's "type" may name; a plugin adds its own.
struct Registries {
  Registry<MeshSource> mesh_sources{"mesh"};
  Registry<Skeleton> skeletons{"skeleton"};
  Registry<Fluid> fluids{"fluid"};
  Registry<Permeability> permeabilities{"permeability"};
  Registry<Properties> properties{"property group"};
  Registry<Physics> physics{"physics"};
  Registry<Condition> conditions{"boundary condition"};
  Registry<ContourShape> contours{"contour"};
  SurfaceRegistry surfaces{"surface"};
  Registry<BodyMotion> motions{"motion"};
  ContactRegistry contacts{"contact"};
  Registry<Friction> frictions{"friction"};
  Registry<NormalLaw> normal_laws{"normal law"};
  Registry<InteriorMotion> interior_motions{"mesh motion"};
  Registry<Remap> remaps{"remap"};
  Registry<TimeIntegrator> integrators{"integrator"};
  Registry<StageEnd> stage_ends{"stage end"};
  Registry<LinearSolver> linear_solvers{"linear solver"};
  Registry<PointTest> point_tests{"test"};
  Registry<Observer> observers{"observer"};
};

/// Fills the registries with mudline's own types.
void register_all(Registries& registries);

/// Documentation of every registered type and of the deck's fixed sections, in deck order, without "plausibility".
std::vector<EntryDoc> document_all(const Registries& registries);

}  // namespace mudline
