#include "physics/thm/thermo_hydro_mechanical.hpp"

#include <cmath>

#include "algebra/over_ranks.hpp"
#include "framework/medium.hpp"
#include "physics/biot/darcy.hpp"

namespace mudline {

void HeatProperties::parameters(Parameters& p) {
  p.required("conductivity", conductivity, "W/(m K)", positive(), "of the saturated soil as a whole");
  p.required("grain heat capacity", grain_capacity, "J/(kg K)", positive(), "of the grains, per mass");
  p.add("grain expansion", grain_expansion, "1/K", non_negative(),
        "volumetric, of the grains; the drained skeleton expands alike");
}

namespace {

/// Heat and water of one material.
struct WarmSoil {
  Mixture mixture;
  WaterHeat water;
  double grain_capacity, conductivity;

  KOKKOS_INLINE_FUNCTION double water_capacity() const { return water.capacity * mixture.fluid_density; }  // [J/(m3 K)]
  /// Density of water over that at the reference temperature and zero pressure [-].
  template <class T>
  KOKKOS_INLINE_FUNCTION T density(const T& p, const T& t) const {
    return exponential(p * mixture.fluid_compliance - water.expansion * (t - mixture.reference));
  }
};

/// Water and heat in the pores and the grains.
struct WaterAndHeat : Medium {
  enum { pore_pressure, temperature, scalars };
  static constexpr bool cancels = true;
  ByMaterial<WarmSoil> soils;
  Darcy darcy;
  double dt, theta;

  template <class C, class T>
  KOKKOS_INLINE_FUNCTION void stored(int row, const PointFields<C, scalars, T>& at,
                                     PointBalance<C, scalars, T>& out) const {
    const WarmSoil& soil = soils(row);
    const double e = darcy.void_ratio(row, 0), old_n = e / (1 + e),
                 old_p = value(at.value[pore_pressure] - at.change[pore_pressure]),
                 old_t = value(at.value[temperature] - at.change[temperature]);
    const T share = 1.0 / at.volume_ratio, n = soil.mixture.porosity(e, at);
    const T now = n * soil.density(at.value[pore_pressure], at.value[temperature]),
            old = old_n * soil.density(old_p, old_t) * share;
    const double grains = (1 - old_n) * soil.mixture.grain_density_at(old_t) * soil.grain_capacity;
    const T capacity = grains * share + soil.water_capacity() * ((1 - theta) * now + theta * old);
    out.storage[pore_pressure] = (now - old) * (1 / dt);
    out.cancelled[pore_pressure] = (value(now) + value(old)) / dt;
    out.storage[temperature] = capacity * at.change[temperature] * (1 / dt);
  }

  template <class C, class T>
  KOKKOS_INLINE_FUNCTION void flows(int row, const PointFields<C, scalars, T>& at,
                                    PointBalance<C, scalars, T>& out) const {
    const WarmSoil& soil = soils(row);
    const T& t = at.value[temperature];
    const T density = soil.density(at.value[pore_pressure], t);
    T minus_discharge[C::dim], convected = 0.0;
    darcy.minus_discharge(row, at, minus_discharge);
    for (int i = 0; i < C::dim; ++i) {
      const T minus_flow = density * minus_discharge[i];
      convected -= minus_flow * at.gradient[temperature][i];
      out.flux[pore_pressure][i] = minus_flow;
      out.flux[temperature][i] = soil.conductivity * at.gradient[temperature][i];
    }
    out.storage[temperature] = soil.water_capacity() * convected;
  }
};

/// Heat and water of the whole soil.
struct WarmGround {
  std::shared_ptr<const Soil> soil;
  WaterHeat water;
  std::vector<std::shared_ptr<const HeatProperties>> heat;  // by material number

  ByMaterial<WarmSoil> at(const SoilBlock& b, const State& state) const {
    return {*soil, b, state, [&](int k) {
              return WarmSoil{Mixture(*soil, b, k, b), water, heat[k]->grain_capacity, heat[k]->conductivity};
            }};
  }

  /// Heat above the reference temperature [J]. Collective.
  double content(const State& state) const {
    double here = 0;
    const LoopLevel level = level_of(state);
    for (const SoilBlock& b : soil->blocks) {
      const ByMaterial<WarmSoil> soils = at(b, state);
      const PointView void_ratio = state.arrays[b.void_ratio];
      with_moving_element(soil->geometry, b, [&](auto coordinates, auto shapes) {
        using Loop = ElementLoop<decltype(coordinates), decltype(shapes)>;
        const Loop loop{b, level};
        if constexpr (Loop::S > 1)
          for (int e = 0; e < b.elements; ++e)
            loop.template for_each_point<false, false>(
                e, [&](int q, const typename Loop::Shape& s, const typename Loop::Fields& f) {
                  const WarmSoil& warm = soils(e * b.points + q);
                  const double ratio = void_ratio(e * b.points + q, 0), n = ratio / (1 + ratio),
                               t = f.value[WaterAndHeat::temperature];
                  here += s.dv * (t - warm.mixture.reference) *
                          ((1 - n) * warm.mixture.grain_density_at(t) * warm.grain_capacity +
                           n * warm.density(f.value[WaterAndHeat::pore_pressure], t) * warm.water_capacity());
                });
      });
    }
    return sum_over_ranks(*soil->space->dofs()->comm(), here);
  }
};

/// The balances of water and heat. They are zero in a geostatic stage, which takes no time.
std::unique_ptr<Term> water_and_heat(std::shared_ptr<const WarmGround> ground) {
  const Geometry geometry = ground->soil->geometry;
  return loop_term("water and heat", Role::balance, geometry, [ground](const StepView& view, auto&& add) {
    if (!view.flow) return;
    const Soil& soil = *ground->soil;
    for (const SoilBlock& b : soil.blocks) {
      const WaterAndHeat medium{
          {}, ground->at(b, *view.committed), Darcy(soil, b, view), view.dt, view.sensitivity[soil.temperature].value};
      add(b, end_level(view, b), stored_law(medium));
      add(b, loop_level(view, view.balance, b), flow_law(medium));
    }
  });
}

}  // namespace

void ThermoHydroMechanical::parameters(Parameters& p) {
  common_parameters(p);
  pore_water_parameters(p);
  p.add("reference temperature", reference_, "degC", open(-100, 1000),
        "at which densities and conductivities are as given");
  p.add_of_place("initial temperature", initial_, "degC", any(),
                 "at the start, a function of position; that of reference where it is not given");
  initial_given_ = p.given("initial temperature");
  p.add("water heat capacity", water_.capacity, "J/(kg K)", positive(), "of the pore water, per mass");
  p.add("water expansion", water_.expansion, "1/K", non_negative(), "volumetric, of the pore water");
  enum class Viscosity { constant, follows };
  Viscosity viscosity = Viscosity::follows;
  p.choice("viscosity", viscosity, {{"constant", Viscosity::constant}, {"follows temperature", Viscosity::follows}},
           "of the pore water; it falls by 2 % per kelvin at 20 degC, and the conductivity grows with it");
  viscosity_follows_ = viscosity == Viscosity::follows;
}

std::vector<Field> ThermoHydroMechanical::fields() const {
  return {displacement_field(), pore_pressure_field(), {"temperature", "degC", "W", 1, Support::vertices, 1}};
}

void ThermoHydroMechanical::add_terms(PhysicsContext& context) {
  if (soil_->dries())
    context.materials_section.fail(
        "physics 'thermo-hydro-mechanical' is for saturated soil; a material has a 'retention'");
  const auto heat = soil_->require<HeatProperties>("heat", context.materials_section);
  soil_->water_expansion = water_.expansion;
  soil_->reference_temperature = reference_;
  soil_->viscosity_follows = viscosity_follows_;
  for (const auto& of : heat) soil_->grain_expansion.push_back(of->grain_expansion);
  require_one_fluid_density(context.materials_section, "in physics 'thermo-hydro-mechanical'");
  const auto ground = std::make_shared<const WarmGround>(WarmGround{soil_, water_, heat});
  const double per_water =
      soil_->blocks.empty() ? 0.0 : water_.capacity * soil_->any_of(soil_->blocks.front()).fluid->density();
  context.conserved.push_back({"heat", "J", soil_->temperature,
                               [ground](const State& state) { return ground->content(state); }, soil_->pressure,
                               per_water, reference_});
  context.terms.push_back(water_and_heat(ground));
}

void ThermoHydroMechanical::initialise(StateStore& store, const Section& section) {
  SoilPhysics::initialise(store, section);
  const Space& space = *soil_->space;
  const auto& dof = space.node_dof(soil_->temperature);
  for (int node = 0; node < space.mesh().num_nodes(); ++node)
    if (dof(node) >= 0)
      store.committed().value(dof(node)) =
          initial_given_ ? initial_(store.committed().time, space.mesh().place(node)) : reference_;
}

}  // namespace mudline
