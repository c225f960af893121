#pragma once

#include "physics/geostatic_column.hpp"
#include "physics/soil.hpp"
#include "physics/solid/gravity.hpp"

namespace mudline {

/// Stress, pore pressure and state of the soil at the start. Inputs and vertical stress: geotechnical, compression
/// positive; the state itself is tension positive.
///  "stress free": everything zero.
///  "uniform": given stresses.
///  "geostatic": sigma'_v = surcharge + weight above - alpha p, sigma'_h = K0 sigma'_v, p that of water at rest, a
///  suction above the water level; horizontal layers by mesh region and material. The weight follows the void ratio,
///  also where that comes from the law.
///  "by law": stresses that the skeleton laws give; no other start may be given for such a law.
///  "from result": that of another run; simulation's ResultStart sets it later.
class InitialState {
 public:
  void parameters(Parameters& p);
  void apply(const Soil& soil, StateStore& store, const Gravity& gravity, const Section& section) const;

 private:
  enum class Kind { stress_free, uniform, geostatic, by_law, from_result };
  void check(const Section& section) const;
  /// InputError where some laws of the soil, or none, give the stress and the deck says otherwise.
  void check_laws(const Soil& soil, const Section& section) const;
  /// InputError where the start does not suit the model; `gravity` [m/s2] is its size.
  void check_model(const Soil& soil, double gravity, const Section& section) const;
  struct Found;
  /// InputError of a start from a strength where no rank has found soil with one, and of overconsolidation that nothing
  /// follows. Collective.
  void check_found(const Soil& soil, const Found& found, const Section& section) const;
  /// Starts the points of a block of elements. InputError where one cannot start.
  void start_block(const Soil& soil, const SoilBlock& b, const std::optional<GeostaticColumn>& ground, State& state,
                   Found& found, const Section& section) const;
  /// Stresses and pore pressures over height, of starts that have them.
  std::optional<GeostaticColumn> ground(const Soil& soil, double gravity, const Section& section) const;
  /// Sets overconsolidation ratio and stress of a point; returns "" or the problem.
  std::string set_stress(const Soil& soil, const std::optional<GeostaticColumn>& ground, const SoilMaterial& material,
                         InitialPoint& point) const;
  /// Sets overconsolidation ratio and stress of a geostatic point under a vertical effective stress [Pa]; returns "" or
  /// the problem.
  std::string at_rest(InitialPoint& point, double vertical, const Point& up, const SoilMaterial& material) const;
  /// Sets the stress of a geostatic point with its overconsolidation ratio; returns "" or the problem.
  std::string stress_at_rest(InitialPoint& point, double vertical, const Point& up, const SoilMaterial& material) const;
  GeostaticColumn column(const Soil& soil, double g, const Section& section) const;
  /// Sets the pore pressures at the start as a function of height.
  void set_pressure(const Soil& soil, StateStore& store, const std::function<double(double height)>& at) const;

  Kind kind_ = Kind::stress_free;
  std::string result_;
  double stress_[6] = {};  // xx yy zz yz xz xy, compression positive
  double pressure_ = 0;
  double surcharge_ = 0, water_level_ = 0;
  bool has_water_ = false, has_k0_ = false, has_k0_angle_ = false, has_ocr_ = false, has_preoverburden_ = false,
       has_strength_ = false, has_strength_ratio_ = false;
  Function k0_, k0_angle_, ocr_{1.0}, preoverburden_, strength_, strength_ratio_;
};

}  // namespace mudline
