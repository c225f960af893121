// A solute in the pore water of a saturated soil: it flows with the water and diffuses in it.
//
//     n R (c_{n+1} - c_n) + dt (w . grad c - div(D grad c)) = 0
//
// c: mass per volume of water [kg/m3], n: porosity, R: retardation, w: Darcy's discharge, D: effective diffusivity. The
// materials of the regions give the properties, the physics of the pore water gives the discharge.
#include "physics/biot/in_pore_water.hpp"
#include "simulation/plugin.hpp"

namespace {

using namespace mudline;

struct SoluteValues {
  double diffusivity = 0, retardation = 1;
};
/// The section "solute" of a material.
struct SoluteProperties : Properties, SoluteValues {
  void parameters(Parameters& p) {
    p.required("diffusivity", diffusivity, "m2/s", positive(), "effective, of the soil as a whole");
    p.add("retardation", retardation, "-", closed(1, 1e6), "what is there over what is in the water");
  }
};

struct SoluteInWater : Medium {
  enum { pore_pressure, concentration, scalars };
  Darcy darcy;
  ByMaterial<SoluteValues> values;
  double dt, theta;

  template <class C, class T>  // with a water content between those of the step's start and end
  KOKKOS_INLINE_FUNCTION void stored(int row, const PointFields<C, scalars, T>& at,
                                     PointBalance<C, scalars, T>& out) const {
    const double e = darcy.void_ratio(row, 0);
    const T water = (1 - theta) * darcy.porosity(row, at) + theta * e / (1 + e) / at.volume_ratio;
    out.storage[concentration] = values(row).retardation / dt * water * at.change[concentration];
  }
  template <class C, class T>
  KOKKOS_INLINE_FUNCTION void flows(int row, const PointFields<C, scalars, T>& at,
                                    PointBalance<C, scalars, T>& out) const {
    T minus_flow[C::dim];
    darcy.minus_discharge(row, at, minus_flow);
    for (int i = 0; i < C::dim; ++i) {
      out.storage[concentration] -= minus_flow[i] * at.gradient[concentration][i];
      out.flux[concentration][i] = values(row).diffusivity * at.gradient[concentration][i];
    }
  }
};

struct Solute : Physics {
  void parameters(Parameters&) {}
  std::vector<Field> fields() const override { return {{"concentration", "kg/m3", "kg/s", 1, Support::vertices, 1}}; }
  void build(PhysicsContext& context, const Section& section) override {
    const auto soil = soil_with_water(context, section);
    const int field = context.space.find("concentration");
    const auto properties = soil->require<SoluteProperties>("solute", context.materials_section);
    const auto make = [=](const StepView& view, const SoilBlock& b, const Darcy& darcy) {
      const ByMaterial<SoluteValues> values(*soil, b, *view.committed, [&](int k) { return *properties[k]; });
      return SoluteInWater{{}, darcy, values, view.dt, view.sensitivity[field].value};
    };
    context.terms.push_back(in_pore_water("solute", soil, field, make));
  }
};

}  // namespace

MUDLINE_PLUGIN(registries) {
  registries.properties.add<SoluteProperties>("solute", "diffusion and retardation, for physics 'solute'");
  registries.physics.add<Solute>("solute", "a solute that the pore water carries and that diffuses in it");
}
