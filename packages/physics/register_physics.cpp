#include "physics/biot/drying_water.hpp"
#include "physics/biot/fluid_mass.hpp"
#include "physics/biot/pore_air.hpp"
#include "physics/biot/pressure_projection.hpp"
#include "physics/register.hpp"
#include "physics/soil_physics.hpp"
#include "physics/thm/thermo_hydro_mechanical.hpp"

namespace mudline {

namespace {

class Biot : public SoilPhysics {
 public:
  void parameters(Parameters& p) {
    common_parameters(p);
    pore_water_parameters(p);
    p.add("fluid acceleration", fluid_acceleration_, "keep the term rho_f a in Darcy's law");
    p.choice(
        "pressure", pair_, {{"Taylor-Hood", Pair::taylor_hood}, {"equal order", Pair::equal_order}},
        "nodes of the pore pressure. Taylor-Hood: the corners of quadratic cells; equal order: all nodes of linear "
        "cells, steadied by a projection on the element's mean");
  }
  std::vector<Field> fields() const override { return {displacement_field(), pore_pressure_field()}; }
  void check_mesh(const Mesh& mesh, const Section& section) const override {
    if (pair_ == Pair::taylor_hood) require_quadratic_cells(mesh, section, ", or give 'pressure' = 'equal order'");
    for (const ElementBlock& block : mesh.blocks())
      if (pair_ == Pair::equal_order && order(block.shape) > 1)
        section.fail(std::string("equal order is for linear cells; the mesh has ") + mudline::name(block.shape),
                     "pressure");
  }

 protected:
  std::vector<std::string> scalar_fields() const override { return {"pore pressure"}; }
  void add_terms(PhysicsContext& context) override {
    if (fluid_acceleration_ && soil_->dries())
      context.materials_section.fail(
          "'fluid acceleration' of the physics is for saturated soil; a material has a 'retention'");
    context.terms.push_back(fluid_mass(soil_, fluid_acceleration_));
    if (soil_->dries()) {
      context.terms.push_back(drying_water(soil_));
      context.terms.push_back(pore_air(soil_));
    }
    if (pair_ == Pair::equal_order) context.terms.push_back(std::make_unique<PressureProjection>(soil_));
  }

 private:
  enum class Pair { taylor_hood, equal_order };
  bool fluid_acceleration_ = false;
  Pair pair_ = Pair::taylor_hood;
};

class Solid : public SoilPhysics {
 public:
  void parameters(Parameters& p) {
    common_parameters(p);
    volume_strain_ = VolumeStrain::automatic;
    p.choice("volume strain", volume_strain_,
             {{"automatic", VolumeStrain::automatic},
              {"fitted", VolumeStrain::fitted},
              {"at points", VolumeStrain::at_points}},
             "the volume strain that the laws see. fitted: a constant, in quad9 and hex27 a linear function, fitted to "
             "that of the cell's points, so that cells do not lock where the soil keeps its volume (mean dilatation, "
             "F-bar), for laws whose mean stress follows the volume strain alone; at points: each point's own; "
             "automatic: fitted in quad4, hex8 and wedge6 with such a law");
  }
  std::vector<Field> fields() const override { return {displacement_field()}; }
};

}  // namespace

void register_physics(Registry<Physics>& registry) {
  registry.add<Biot>("biot", "saturated soil: displacement and pore pressure, finite deformation, inertia");
  registry.add<Solid>("solid", "single-phase solid in total stress: displacement, finite deformation, inertia");
  registry.add<ThermoHydroMechanical>(
      "thermo-hydro-mechanical",
      "saturated soil with heat: displacement, pore pressure and temperature, conduction and convection");
}

void register_properties(Registry<Properties>& registry) {
  registry.add<HeatProperties>("heat", "conduction, heat capacity and expansion, for 'thermo-hydro-mechanical'");
}

}  // namespace mudline
