#pragma once

#include "physics/soil_physics.hpp"

namespace mudline {

/// Section "heat" of a material: thermal properties of its skeleton and grains.
class HeatProperties : public Properties {
 public:
  void parameters(Parameters& p);
  double conductivity = 0;     // lambda [W/(m K)] of the saturated soil
  double grain_capacity = 0;   // c_s [J/(kg K)]
  double grain_expansion = 0;  // beta_s [1/K], volumetric; the drained skeleton expands like its grains
};

/// Thermal properties of the pore water.
struct WaterHeat {
  double capacity = 4186;      // c_w [J/(kg K)]
  double expansion = 2.07e-4;  // beta_w [1/K], volumetric
};

/// Saturated soil with heat: the skeleton expands with its grains, water expands more and so raises the pore pressure,
/// heat is conducted and advected by the flow, warm water is lighter and less viscous. Balances over a step (rho_w:
/// density of water at pressure p and temperature T; m = n rho_w):
///   water: m_{n+1} - m_n/J + dt div(rho_w q) = 0,   q = -k(e)/gamma_w mu_0/mu(T) (grad p - rho_w g)
///   heat:  C (T_{n+1} - T_n) + dt [c_w rho_w q . grad T - div(lambda grad T)] = 0
/// C = (1-n) rho_s c_s + m c_w. In this form a uniform temperature stays uniform in any flow. Together the balances of
/// water and heat conserve heat exactly, because temperature and pore pressure have the same shape functions. One
/// temperature for grains and water; no heat from plastic work.
class ThermoHydroMechanical : public SoilPhysics {
 public:
  void parameters(Parameters& p);
  std::vector<Field> fields() const override;
  void check_mesh(const Mesh& mesh, const Section& section) const override { require_quadratic_cells(mesh, section); }
  void initialise(StateStore& store, const Section& section) override;

 protected:
  std::vector<std::string> scalar_fields() const override { return {"pore pressure", "temperature"}; }
  void add_terms(PhysicsContext& context) override;

 private:
  WaterHeat water_;
  bool viscosity_follows_ = true;  // viscosity depends on the temperature; else it is that at the reference temperature
  double reference_ = 20;          // [degC]
  Function initial_;
  bool initial_given_ = false;
};

}  // namespace mudline
