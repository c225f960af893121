#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/field_block.hpp"
#include "framework/material.hpp"
#include "framework/space.hpp"
#include "framework/state.hpp"
#include "materials/register_materials.hpp"
#include "materials/retention.hpp"
#include "physics/permeability_ratios.hpp"

namespace mudline {

/// The registries a deck's "materials" section needs.
struct MaterialRegistries {
  const Registry<Skeleton>& skeletons;
  const Registry<Fluid>& fluids;
  const Registry<Permeability>& permeabilities;
  const Registry<Properties>& properties;
};

/// One entry of the deck's "materials": the soil of some regions.
class SoilMaterial : public Material {
 public:
  /// Reads and validates the entry. InputError.
  static std::shared_ptr<SoilMaterial> read(const Section& section, const MaterialRegistries& registries);
  /// Documentation of the entry's own parameters.
  static void document(Parameters& p) { SoilMaterial().parameters(p); }
  void parameters(Parameters& p);

  double grain_density = 2650;    // [kg/m3]
  double initial_void_ratio = 0;  // [-] 0 where it comes from the law or is a function of the place
  bool void_ratio_from_law = false;
  double biot_coefficient = 1;    // alpha [-]
  double grain_bulk_modulus = 0;  // K_s [Pa]; 0: incompressible
  std::shared_ptr<Skeleton> skeleton;
  std::string law;                             // registered type of the skeleton
  std::shared_ptr<Fluid> fluid;                // null: single phase (total stress)
  std::shared_ptr<Permeability> permeability;  // null: single phase
  PermeabilityRatios permeability_ratios;
  Retention retention;
  bool porous() const { return fluid != nullptr; }
  bool conductivity_varies() const { return permeability && permeability->varies(); }
  bool has_top = false;  // the soil lies below the height `top` [m], a function of the position at the start
  Function top;

  /// Whether the initial void ratio is not the same at all points.
  bool void_ratio_varies() const { return void_ratio_from_law || !pores_.empty(); }
  /// The initial void ratio that the deck gives at a place; 0 where it gives none.
  double void_ratio_at(const Point& place) const;
  /// Sets the void ratio of `point` from its place, or from its stress and overconsolidation ratio; returns "" or the
  /// problem.
  std::string find_void_ratio(InitialPoint& point) const;
  double initial_porosity() const { return initial_void_ratio / (1 + initial_void_ratio); }
  /// rho = n S rho_f + (1-n) rho_s [kg/m3] with the saturation S; the void space is empty in a single-phase soil.
  double density(double porosity, double saturation = 1) const;
  /// The part of a pore pressure that acts in the total stress [Pa].
  double acting(double pressure) const { return biot_coefficient * retention.acting(pressure); }
  /// 1/Q = n/K_f + (alpha - n)/K_s [1/Pa]
  double storage(double porosity) const;

 private:
  std::vector<NumberOfPlace> pores_;  // void ratio or porosity, where it is a function
};

/// The elements of one mesh block with their soil and its state; shared by the terms of a physics. Every point has its
/// own material: one region may have layers whose boundaries are no mesh lines.
struct SoilBlock : FieldBlock {
  int block;
  std::vector<int> made_of;  // indices of its materials in Soil::materials
  PointView start;           // index of the material of each point at the start
  int origin = -1;  // state handle: (material index, position of the soil at the start); -1: no region has layers
  int stress = -1, void_ratio = -1, law = -1;  // state handles: effective stress; (e, initial e); law's own state
  int permeability = -1;    // state handle: tensor of PermeabilityRatios, turned with the soil; -1: all of ones
  int conductivity = -1;    // state handle: Permeability::numbers_at; -1: no number of its materials varies
  bool dries = false;       // some of its materials has a retention
  bool sees_water = false;  // its laws see the volume strain of the water, see WaterDilatation
  bool porous() const { return scalars > 0; }
  FieldBlock mass;  // the same elements with enough points for a mass matrix of full rank
};

/// The volume strain that the laws of saturated soil see: that of each point, or that of the water (WaterDilatation)
/// for all laws or for those that harden with their volume. Automatic: hardening where soil slides along something,
/// at points elsewhere.
enum class SaturatedStrain { automatic, at_points, water_balance, hardening };

/// All soil of a model.
struct Soil {
  const Space* space = nullptr;
  Geometry geometry = Geometry::plane_strain;
  int displacement = -1, pressure = -1, temperature = -1;  // field indices; -1: not among the unknowns
  std::vector<std::shared_ptr<const SoilMaterial>> materials;
  std::vector<SoilBlock> blocks;
  std::vector<double>
      grain_expansion;  // by material number [1/K]: volumetric, of grains and drained skeleton; empty: 0
  double water_expansion = 0, reference_temperature = 0;  // [1/K] volumetric; [degC] at which densities are as given
  bool viscosity_follows = false;                         // the viscosity of the water depends on the temperature
  bool excess = false;  // pore pressures are in excess of water at rest, weights are submerged weights
  /// Unit vector against gravity, along which heights are counted; without gravity the mesh's last direction.
  Point up{};
  /// Height of the whole mesh at the start [m].
  double extent() const;
  double height(const Point& x) const { return x[0] * up[0] + x[1] * up[1] + x[2] * up[2]; }
  double reduction_rate = 0;  // [1/s] growth of the factor by which the present stage divides strengths
  /// That factor [-], so long after the stage's start [s].
  double strength_factor(double since) const { return 1 + reduction_rate * since; }
  std::function<Point(double time)> gravity = [](double) { return Point{}; };  // [m/s2]
  /// Gravity [m/s2] at a time in the balance of the pore water; zero without pore fluid and where pore pressures are in
  /// excess of water at rest.
  std::function<Point(double time)> water_gravity = [](double) { return Point{}; };

  /// Material index of each point of a block: (point, 0). It moves with the soil and is constant within a step.
  PointView which(const SoilBlock& b, const State& state) const {
    return b.origin >= 0 ? state.arrays[b.origin] : b.start;
  }
  /// Material of soil that was at this position at the start: the one with the lowest top above it, or the uppermost.
  int material_at(const SoilBlock& b, const Point& start) const;
  /// Share of each material of a block in the points of one element: (point, index in made_of), from the positions of
  /// the soil at the start. The shares of a point add up to 1. An interface is a ramp about as high as a point's part
  /// of the element, so that the content of a layer does not jump when a point passes the interface.
  std::vector<double> layer_shares(const SoilBlock& b, const std::vector<Point>& starts) const;
  /// Those of an element of a block with several materials in a state.
  std::vector<double> layer_shares(const SoilBlock& b, const State& state, int element) const;
  /// Whether some region has more than one material.
  bool layered() const;
  /// Whether some material has a retention: under suction it is not saturated.
  bool dries() const;
  /// InputError through `section` for something that knows saturated soil only, where a material has a retention.
  void require_saturated(const Section& section, const std::string& entry) const;
  /// Any material of a block, for properties that all have in common (the pore fluid).
  const SoilMaterial& any_of(const SoilBlock& b) const { return *materials[b.made_of.front()]; }
  /// Fills SoilBlock::start. InputError through `section`, the deck's "materials", where soil lies above the tops of
  /// all materials or a material has no points. Collective.
  void place_materials(const Section& section);

  /// Weight vector of the pore water of a block [N/m3] under water_gravity.
  Point water_weight(int block, double time) const;

  /// Density of the water in the uplift, alpha rho_f [kg/m3]; zero where pore pressures are total.
  double uplift(const SoilMaterial& material) const;
  /// A group of properties that a physics needs of every material, by material number. InputError through `where`, the
  /// deck's "materials", when one is missing.
  template <class T>
  std::vector<std::shared_ptr<const T>> require(const std::string& group, const Section& where) const {
    std::vector<std::shared_ptr<const T>> result;
    for (const auto& material : materials) result.push_back(material->require<T>(group, where));
    return result;
  }
  /// The same elements and points, block by block, with the pore pressure and another scalar field: for the balance of
  /// something in the pore water.
  std::shared_ptr<std::vector<FieldBlock>> blocks_with(int field) const;
  SaturatedStrain saturated_strain = SaturatedStrain::at_points;
  /// Chooses the volume strain that the laws of each block see. slides: whether a contact has friction.
  void choose_strain(bool slides);
  void declare_state(StateStore& store);
  void sparsity(Assembler& assembler);
};

/// The volume strain that the laws of single-phase soil see. At points: that of each point. Fitted: a constant or, in
/// quad9 and hex27, a linear function fitted to that of the cell's points, so that the cell does not lock where the
/// soil keeps its volume. It is for laws with Skeleton::volume_apart, and for all cells but tri3 and tet4. Automatic:
/// fitted in quad4, hex8 and wedge6 with such a law.
enum class VolumeStrain { automatic, fitted, at_points };

/// Pairs every element block with the materials that name its region. `scalars`: the fields beside the displacement:
/// none, the pore pressure, or pore pressure and temperature. InputError when no material names a region, when several
/// name it that are no layers, or when one does not fit (with pore pressure: fluid and permeability required; otherwise
/// refused). quadrature_degree: 0 stands for the default of the cell.
std::shared_ptr<Soil> make_soil(const Space& space, const Materials& materials, const std::vector<std::string>& scalars,
                                int quadrature_degree, VolumeStrain volume_strain, const Section& where);

/// The fields of soil, with the same declaration in every physics.
Field displacement_field();
Field pore_pressure_field();

}  // namespace mudline
