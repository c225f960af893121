#pragma once

#include <memory>

#include "framework/physics.hpp"
#include "physics/initial_state.hpp"

namespace mudline {

/// Common base of the physics of soils: displacement, stresses, inertia, gravity, damping and the initial state.
class SoilPhysics : public Physics {
 public:
  void build(PhysicsContext& context, const Section& section) override;
  void initialise(StateStore& store, const Section& section) override;

 protected:
  /// The scalar fields beside the displacement: none, the pore pressure, or the pore pressure and the temperature.
  virtual std::vector<std::string> scalar_fields() const { return {}; }
  /// Adds the terms and soil data that are specific to a physics; called once the soil exists. InputError.
  virtual void add_terms(PhysicsContext&) {}
  void common_parameters(Parameters& p);
  /// Parameters of saturated soil.
  void pore_water_parameters(Parameters& p);
  /// InputError for linear cells, on which displacement and pore pressure are no stable pair; `otherwise`: advice
  /// besides quadratic cells.
  static void require_quadratic_cells(const Mesh& mesh, const Section& section, const std::string& otherwise = "");
  /// InputError where pore fluids have several densities; `why`: "with ...".
  void require_one_fluid_density(const Section& materials, const std::string& why) const;

  std::shared_ptr<Soil> soil_;
  Gravity gravity_;
  bool excess_ = false;
  SaturatedStrain saturated_strain_ = SaturatedStrain::automatic;
  VolumeStrain volume_strain_ = VolumeStrain::at_points;

 private:
  bool porous() const { return !scalar_fields().empty(); }
  void warn_of_locking(const State& state) const;
  /// InputError where the fitted volume strain has no effect, or the law does not suit it.
  void require_fit(const Section& section) const;

  InitialState initial_;
  static constexpr int cell_default = 0;
  int quadrature_ = 4;
  double mass_damping_ = 0, stiffness_damping_ = 0;
};

}  // namespace mudline
