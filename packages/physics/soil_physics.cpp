#include "physics/soil_physics.hpp"

#include <algorithm>

#include "core/log.hpp"
#include "core/text.hpp"
#include "physics/biot/block_data.hpp"
#include "physics/biot/open_boundary.hpp"
#include "physics/soil_points.hpp"
#include "physics/solid/inertia.hpp"
#include "physics/solid/rayleigh_damping.hpp"
#include "physics/solid/stress_divergence.hpp"
#include "physics/solid/weight.hpp"

namespace mudline {

void SoilPhysics::build(PhysicsContext& context, const Section& section) {
  if (context.shared.find<Soil>()) section.fail("only one physics may own the displacements");
  soil_ = make_soil(context.space, context.materials, scalar_fields(), quadrature_, volume_strain_,
                    context.materials_section);
  context.shared.offer(soil_);
  if (volume_strain_ == VolumeStrain::fitted) require_fit(section);
  soil_->excess = excess_;
  soil_->saturated_strain = porous() ? saturated_strain_ : SaturatedStrain::at_points;
  soil_->choose_strain(false);
  soil_->gravity = [gravity = gravity_](double time) { return gravity.at(time); };
  soil_->up = gravity_.up(context.space.mesh().dimension());
  soil_->place_materials(context.materials_section);
  if (excess_ && soil_->dries())
    section.fail("a material has a 'retention': suction is counted from the air's pressure; allowed: total",
                 "pore pressure");
  if (porous() && excess_) require_one_fluid_density(context.materials_section, "with 'pore pressure' = 'excess'");
  if (porous() && !excess_) soil_->water_gravity = soil_->gravity;
  context.terms.push_back(std::make_unique<StressDivergence>(soil_));
  context.terms.push_back(inertia(soil_));
  context.terms.push_back(weight(soil_, gravity_));
  add_terms(context);
  if (porous()) context.terms.push_back(std::make_unique<OpenBoundary>(soil_));
  if (mass_damping_ > 0 || stiffness_damping_ > 0)
    context.terms.push_back(rayleigh_damping(soil_, mass_damping_, stiffness_damping_));
  context.block_data = [soil = soil_](const StepView& view) { return soil_block_data(*soil, view, view.constrained); };
}

void SoilPhysics::initialise(StateStore& store, const Section& section) {
  initial_.apply(*soil_, store, gravity_, section.section("initial state"));
  if (!porous()) warn_of_locking(store.committed());
}

void SoilPhysics::require_fit(const Section& section) const {
  for (const SoilBlock& b : soil_->blocks) {
    if (b.dilatation_terms > 0) continue;
    for (const int k : b.made_of)
      if (const SoilMaterial& material = *soil_->materials[k]; !material.skeleton->volume_apart())
        section.fail(
            "'fitted' is for laws whose mean stress follows the volume strain alone: linear elastic, "
            "neo-hookean, tresca, von mises; material '" +
                material.name + "' is " + material.law,
            "volume strain");
    section.fail(std::string("'fitted' has no effect in ") + mudline::name(b.shape) + " cells with " +
                     std::to_string(b.points) + (b.points == 1 ? " point" : " points"),
                 "volume strain");
  }
}

void SoilPhysics::common_parameters(Parameters& p) {
  p.add("gravity", gravity_.vector, "m/s2", "gravitational acceleration as a vector");
  p.add("gravity factor", gravity_.factor, "-", "function of time that scales gravity");
  p.add(
      "quadrature degree", quadrature_, "-", closed(1, 8),
      "polynomial degree that the element quadrature integrates exactly; by default 4, in tet10, tri3, tet4 and wedges "
      "2, in quad4 and hex8 3. Inertia takes at least twice the order of the cell");
  if (!p.given("quadrature degree")) quadrature_ = cell_default;
  p.add("mass damping", mass_damping_, "1/s", non_negative(), "Rayleigh damping: factor of the mass matrix");
  p.add("stiffness damping", stiffness_damping_, "s", non_negative(),
        "Rayleigh damping: factor of the elastic stiffness matrix");
  p.section("initial state", initial_, "stresses and pore pressures at the start");
}

void SoilPhysics::pore_water_parameters(Parameters& p) {
  enum class Counted { total, excess };
  Counted counted = Counted::total;
  p.choice("pore pressure", counted, {{"total", Counted::total}, {"excess", Counted::excess}},
           "excess: counted from water at rest, whose weight then acts nowhere; total stresses, loads and contact "
           "pressures are in excess of the water's too");
  excess_ = counted == Counted::excess;
  p.choice(
      "volume strain", saturated_strain_,
      {{"automatic", SaturatedStrain::automatic},
       {"at points", SaturatedStrain::at_points},
       {"water balance", SaturatedStrain::water_balance},
       {"hardening", SaturatedStrain::hardening}},
      "the volume strain that the laws see at the end of a step. at points: that of each point's motion; water "
      "balance: where the soil cannot drain within the step, that which the balance of the water resolves, which is "
      "more exact beside rough walls; hardening: the same for laws that harden with their volume only (modified cam "
      "clay, s-clay1s, hypoplasticity); automatic: hardening if a contact has friction, else at points. Where it is "
      "that "
      "of the water, a surface that a contact may seal drains only as fast as its water can flow");
}

void SoilPhysics::require_quadratic_cells(const Mesh& mesh, const Section& section, const std::string& otherwise) {
  for (const ElementBlock& block : mesh.blocks())
    if (order(block.shape) < 2)
      section.fail(std::string("linear ") + mudline::name(block.shape) +
                       " cells give an unstable displacement and pore-pressure pair; use quadratic cells (" +
                       (mesh.dimension() == 3 ? "tet10, wedge15 or hex27" : "tri6 or quad9") + ", in Gmsh: order 2)" +
                       otherwise,
                   "type");
}

/// Water at rest, the reference of excess pressures, must have one density: an interface between two fluids would move
/// with the soil and change the reference pressure.
void SoilPhysics::require_one_fluid_density(const Section& materials, const std::string& why) const {
  const SoilMaterial& first = soil_->any_of(soil_->blocks.front());
  for (const SoilBlock& b : soil_->blocks) {
    const SoilMaterial& other = soil_->any_of(b);
    if (other.fluid->density() != first.fluid->density())
      materials.fail(why + " all pore fluids have one density; it is " + number_text(other.fluid->density()) +
                         " kg/m3 here and " + number_text(first.fluid->density()) + " in '" + first.name + "'",
                     other.name + "/fluid/density");
  }
}

/// Nine-node cells that are incompressible at 3 x 3 points have too few deformation modes left (volumetric locking):
/// collapse loads are some per cent too high (docs/materials.md, section 10).
void SoilPhysics::warn_of_locking(const State& state) const {
  for (const SoilBlock& b : soil_->blocks) {
    const SoilPoints points(*soil_, b, state);
    if (b.shape != CellShape::quad9 || b.points < 9 || b.dilatation_terms > 0 || b.elements == 0) continue;
    const SoilMaterial& material = points.material(0);
    const ElasticModuli m = points.moduli(0);
    if (material.skeleton->state_size() > 0 && (3 * m.bulk - 2 * m.shear) / (6 * m.bulk + 2 * m.shear) >= 0.48)
      log::warn("material '" + material.name +
                "' is nearly incompressible: nine-node cells with 3 x 3 points are some per cent too stiff "
                "where it yields; 'volume strain' = 'fitted' mends that, as do six-node triangles with 'quadrature "
                "degree' 2");
  }
}

}  // namespace mudline
