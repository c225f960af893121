#include "physics/initial_state.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "algebra/over_ranks.hpp"
#include "core/pi.hpp"
#include "core/text.hpp"
#include "core/told.hpp"
#include "discretisation/agree.hpp"
#include "discretisation/mesh_topology.hpp"
#include "materials/earth_pressure.hpp"
#include "materials/guarded_law.hpp"
#include "physics/overconsolidation.hpp"
#include "physics/soil_points.hpp"
#include "tensor/midpoint_rule.hpp"

namespace mudline {

void InitialState::parameters(Parameters& p) {
  p.choice("type", kind_,
           {{"stress free", Kind::stress_free},
            {"uniform", Kind::uniform},
            {"geostatic", Kind::geostatic},
            {"by law", Kind::by_law},
            {"from result", Kind::from_result}},
           "how the soil starts; by law: with the stresses that the skeleton law itself gives, as a 'umat' does by "
           "SIGINI; from result: with the state in which an axisymmetric run ended a stage, turned into space");
  p.add("result", result_,
        "from result: results and the stage at whose end the state is taken, 'results/pile@set-up'; relative to where "
        "the program is started");
  const char* names[6] = {"effective stress xx", "effective stress yy", "effective stress zz",
                          "shear stress yz",     "shear stress xz",     "shear stress xy"};
  for (int i = 0; i < 6; ++i)
    if (p.dimension() == 3 || i < 3 || i == 5)
      p.add(names[i], stress_[i], "Pa", any(),
            std::string("uniform start, compression positive") + (i == 3 || i == 4 ? "; in space" : ""));
  p.add("pore pressure", pressure_, "Pa", any(), "uniform start or by law, compression positive");
  p.add("surcharge", surcharge_, "Pa", non_negative(),
        "geostatic: vertical load on the surface, beside water that stands above it");
  p.add("water level", water_level_, "m", any(),
        "geostatic or by law: height of the water surface, counted against gravity; water above it is held by suction. "
        "Without it the pore pressure of a geostatic start is zero");
  has_water_ = p.given("water level");
  p.add_of_place(
      "K0", k0_, "-", non_negative(),
      "geostatic: earth pressure coefficient at rest, sigma'_h/sigma'_v; by default that of the skeleton law");
  has_k0_ = p.given("K0");
  p.add_of_place(
      "K0 friction angle [deg]", k0_angle_, "deg", half_open(0, 90),
      "geostatic, instead of K0: K0 = (1 - sin(phi)) OCR^sin(phi) (Jaky; Mayne and Kulhawy); function of position");
  has_k0_angle_ = p.given("K0 friction angle [deg]");
  p.add_of_place("overconsolidation ratio", ocr_, "-", at_least(1),
                 "scales the yield surface through the initial stress; function of position");
  has_ocr_ = p.given("overconsolidation ratio");
  p.add_of_place(
      "preoverburden pressure", preoverburden_, "Pa", non_negative(),
      "geostatic, instead of the overconsolidation ratio: vertical stress that once was there in addition, OCR = 1 + "
      "POP/sigma'_v; function of position");
  has_preoverburden_ = p.given("preoverburden pressure");
  p.add_of_place(
      "undrained strength", strength_, "Pa", positive(),
      "instead of the overconsolidation ratio, which is found so that the skeleton law has this undrained strength at "
      "the start; function of position");
  has_strength_ = p.given("undrained strength");
  p.add_of_place(
      "undrained strength ratio", strength_ratio_, "-", positive(),
      "geostatic, instead of the undrained strength: over the vertical effective stress, s_u/sigma'_v; function of "
      "position");
  has_strength_ratio_ = p.given("undrained strength ratio");
}

void InitialState::check(const Section& section) const {
  if (kind_ == Kind::from_result) {
    if (result_.empty()) section.fail("'type' = 'from result' needs the results and the stage, 'results/pile@set-up'");
    for (const std::string& name : section.parameter_names())
      if (name != "type" && name != "result") section.fail("with 'type' = 'from result' the result gives it", name);
    return;
  }
  if (!result_.empty()) section.fail("has a meaning only with 'type' = 'from result'", "result");
  if (has_k0_ && has_k0_angle_) section.fail("give either this or 'K0', not both", "K0 friction angle [deg]");
  const char* given = nullptr;  // what the overconsolidation follows from
  for (const auto& [entry, there] : {std::pair{"overconsolidation ratio", has_ocr_},
                                     {"preoverburden pressure", has_preoverburden_},
                                     {"undrained strength", has_strength_},
                                     {"undrained strength ratio", has_strength_ratio_}}) {
    if (there && given) section.fail("give either this or '" + std::string(given) + "', not both", entry);
    if (there) given = entry;
  }
  if (kind_ == Kind::by_law)
    for (const std::string& name : section.parameter_names()) {
      if (name == "pore pressure" && has_water_) section.fail("give either this or 'water level', not both", name);
      if (name != "type" && name != "pore pressure" && name != "water level" && name != "overconsolidation ratio")
        section.fail("with 'type' = 'by law' the law gives the stress", name);
    }
  if (has_strength_ && kind_ == Kind::stress_free)
    section.fail("without stress there is no overconsolidation; give the strength in 'skeleton'", "undrained strength");
  static const struct {
    std::vector<const char*> entries;
    std::vector<Kind> kinds;
    const char* words;
  } meanings[] = {
      {{"effective stress xx", "effective stress yy", "effective stress zz", "shear stress yz", "shear stress xz",
        "shear stress xy"},
       {Kind::uniform},
       "uniform"},
      {{"pore pressure"}, {Kind::uniform, Kind::by_law}, "uniform or by law"},
      {{"water level"}, {Kind::geostatic, Kind::by_law}, "geostatic or by law"},
      {{"surcharge", "K0", "K0 friction angle [deg]", "preoverburden pressure", "undrained strength ratio"},
       {Kind::geostatic},
       "geostatic"},
      {{"overconsolidation ratio"}, {Kind::uniform, Kind::geostatic, Kind::by_law}, "uniform, geostatic or by law"},
  };
  for (const auto& [entries, kinds, words] : meanings)
    for (const char* entry : entries)
      if (section.has_parameter(entry) && std::find(kinds.begin(), kinds.end(), kind_) == kinds.end())
        section.fail("has a meaning only with 'type' = " + std::string(words), entry);
}

void InitialState::check_laws(const Soil& soil, const Section& section) const {
  for (const auto& material : soil.materials) {
    const std::string whose = "the law '" + material->law + "' of material '" + material->name + "' ";
    if (kind_ == Kind::by_law && !material->skeleton->gives_stress())
      section.fail(whose + "gives no initial stress; a 'umat' does whose library has a SIGINI", "type");
    if (kind_ != Kind::by_law && material->skeleton->gives_stress())
      section.fail(whose + "gives the initial stress (SIGINI); allowed then: 'by law', 'from result'", "type");
  }
}

namespace {

/// "" or the reason why the strength of the law does not allow this earth pressure at rest.
std::string beyond_strength(const SoilMaterial& material, double k0, double vertical, const InitialPoint& point) {
  const auto allowed = material.skeleton->earth_pressures(vertical, point);
  const double rounding = 1e-6;
  if (!allowed || vertical <= 0 ||
      (k0 >= allowed->active / vertical - rounding && k0 <= allowed->passive / vertical * (1 + rounding)))
    return "";
  return told(k0, "K0 = %.4g is outside [") + told(std::max(0.0, allowed->active / vertical), "%.4g, ") +
         told(allowed->passive / vertical, "%.4g]") + ", what the strength of '" + material.law +
         told(vertical, "' under sigma'_v = %.4g Pa") + " allows between active and passive";
}

/// Whether the law or the void ratio starts otherwise from another overconsolidation ratio.
bool follows_overconsolidation(const SoilMaterial& material, const InitialPoint& point) {
  InitialPoint other = point;
  other.overconsolidation_ratio *= 2;
  const auto size = static_cast<std::size_t>(material.skeleton->state_size());
  std::vector<double> state(size), other_state(size);
  if (!material.find_void_ratio(other).empty() || !start_guarded(*material.skeleton, point, state.data()).empty() ||
      !start_guarded(*material.skeleton, other, other_state.data()).empty())
    return true;
  return other.void_ratio != point.void_ratio || other_state != state;
}

/// Writes the start of a point into the arrays of its block, and starts its law; returns "" or the law's problem.
std::string write_point(const SoilBlock& block, int row, const SoilMaterial& material, const InitialPoint& point,
                        const State& state) {
  const auto array = [&](int handle) { return state.arrays[handle]; };
  if (block.origin >= 0) {
    array(block.origin)(row, 0) = block.start(row, 0);
    for (int c = 1; c < static_cast<int>(array(block.origin).extent(1)); ++c)
      array(block.origin)(row, c) = point.position[c - 1];
  }
  for (int c = 0; c < 6; ++c) array(block.stress)(row, c) = point.stress[c];
  if (block.permeability >= 0)
    for (int c = 0; c < 6; ++c) array(block.permeability)(row, c) = material.permeability_ratios.tensor()[c];
  array(block.void_ratio)(row, 0) = array(block.void_ratio)(row, 1) = point.void_ratio;
  if (block.conductivity >= 0) {
    const std::string problem = material.permeability->numbers_at(point.position, &array(block.conductivity)(row, 0));
    if (!problem.empty()) return problem;
  }
  const PointView law = array(block.law);
  return start_guarded(*material.skeleton, point, law.data() + row * law.extent(1));
}

}  // namespace

std::string InitialState::at_rest(InitialPoint& point, double vertical, const Point& up,
                                  const SoilMaterial& material) const {
  if (const std::string problem = material.skeleton->number_out_of_range(point.position); !problem.empty())
    return problem;
  if (has_preoverburden_) {
    const double pop = preoverburden_(0, point.position);
    if (pop > 0 && vertical <= 0) return "a preoverburden pressure needs vertical effective stress; give a 'surcharge'";
    if (pop > 0) point.overconsolidation_ratio = 1 + pop / vertical;
  }
  if (has_strength_ratio_ && vertical <= 0)
    return "an undrained strength ratio needs vertical effective stress; give a 'surcharge'";
  if (!has_strength_ && !has_strength_ratio_) return stress_at_rest(point, vertical, up, material);
  return overconsolidate(
      material, has_strength_ ? strength_(0, point.position) : strength_ratio_(0, point.position) * vertical,
      [&](InitialPoint& at) { return stress_at_rest(at, vertical, up, material); }, point);
}

std::string InitialState::stress_at_rest(InitialPoint& point, double vertical, const Point& up,
                                         const SoilMaterial& material) const {
  double k0 = 0;
  if (has_k0_) {
    k0 = k0_(0, point.position);
  } else if (has_k0_angle_) {
    const double phi = k0_angle_(0, point.position) * pi / 180;
    k0 = earth_pressure_at_rest(std::sin(phi), point.overconsolidation_ratio);
  } else {
    const std::string problem = guarded_k0(*material.skeleton, point, k0);
    if (!problem.empty()) return problem;
    if (k0 < 0) return "the skeleton law has no K0 of its own; give 'K0'";
  }
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) point.stress[six(i, j)] = -vertical * ((i == j ? k0 : 0.0) + (1 - k0) * up[i] * up[j]);
  return beyond_strength(material, k0, vertical, point);
}

GeostaticColumn InitialState::column(const Soil& soil, double g, const Section& section) const {
  const Bounds& bounds = soil.space->mesh().bounds();
  GeostaticColumn column(soil, g, has_water_ ? std::optional<double>(water_level_) : std::nullopt, section);
  // Density where the void ratio varies, in the middle of the mesh's width: a layer has one weight at each depth.
  const auto density = [&](const SoilMaterial& material, double y, double total) {
    InitialPoint point{};
    const auto at_height = [&](Point place) {
      const double rise = y - soil.height(place);
      for (int i = 0; i < 3; ++i) place[i] += rise * soil.up[i];
      return place;
    };
    for (int i = 0; i < 3; ++i) point.position[i] = 0.5 * (bounds.low[i] + bounds.high[i]);
    point.position = at_height(point.position);
    point.height = y;
    const double given = material.void_ratio_at(point.position);
    for (const Point& end : {bounds.low, bounds.high})
      if (std::abs(material.void_ratio_at(at_height(end)) - given) > 1e-9)
        section.fail("the void ratio of material '" + material.name + "' varies sideways at the height " +
                         number_text(y) + "; use a stage of type 'geostatic' from a uniform state",
                     "type");
    point.overconsolidation_ratio = ocr_(0, point.position);
    std::string problem = at_rest(point, total - material.acting(column.pore_pressure(y)), soil.up, material);
    if (problem.empty()) problem = material.find_void_ratio(point);
    if (!problem.empty())
      section.fail("material '" + material.name + "' cannot start at the height " + std::to_string(y) + ": " + problem);
    return material.density(point.void_ratio / (1 + point.void_ratio),
                            material.retention.saturation(column.pore_pressure(y)));
  };
  column.weigh(surcharge_, density);
  return column;
}

void InitialState::set_pressure(const Soil& soil, StateStore& store, const std::function<double(double)>& at) const {
  if (soil.pressure < 0) return;
  State& state = store.committed();
  const auto& dof = soil.space->node_dof(soil.pressure);
  for (int node = 0; node < soil.space->mesh().num_nodes(); ++node)
    if (dof(node) >= 0) state.value(dof(node)) = at(soil.height(soil.space->mesh().place(node)));
}

void InitialState::check_model(const Soil& soil, double gravity, const Section& section) const {
  if (soil.excess && has_water_)
    section.fail("pore pressures are in excess of water at rest: its level has no effect", "water level");
  check_laws(soil, section);
  if (kind_ == Kind::geostatic && gravity == 0)
    section.fail("a geostatic start needs gravity: give the physics a 'gravity'", "type");
  if (kind_ == Kind::by_law && has_water_ && gravity == 0)
    section.fail("the pressure of water at rest needs gravity: give the physics a 'gravity'", "water level");
  for (const char* entry : {"water level", "pore pressure"})
    if (soil.pressure < 0 && section.has_parameter(entry))
      section.fail("this physics has one phase and no pore pressure; 'biot' has one", entry);
}

std::optional<GeostaticColumn> InitialState::ground(const Soil& soil, double gravity, const Section& section) const {
  if (kind_ == Kind::geostatic) return column(soil, gravity, section);
  if (kind_ == Kind::by_law && has_water_) return GeostaticColumn(soil, gravity, water_level_, section);
  return std::nullopt;
}

std::string InitialState::set_stress(const Soil& soil, const std::optional<GeostaticColumn>& ground,
                                     const SoilMaterial& material, InitialPoint& point) const {
  for (int c = 0; c < 6; ++c) point.stress[c] = kind_ == Kind::stress_free ? 0.0 : -stress_[c];
  point.overconsolidation_ratio = ocr_(0, point.position);
  if (kind_ == Kind::by_law) return guarded_stress(*material.skeleton, point);
  if (kind_ == Kind::geostatic) {
    const double pressure = material.acting(ground->pore_pressure(point.height));
    return at_rest(point, ground->total_stress(point.height) - pressure, soil.up, material);
  }
  if (!has_strength_) return "";
  return overconsolidate(
      material, strength_(0, point.position), [](InitialPoint&) { return ""; }, point);
}

/// What the points of this rank showed when they started.
struct InitialState::Found {
  bool asks_strength, asks_ratio;  // what the start has to know
  bool strength = false;           // a law has an undrained strength
  bool overconsolidated = false;   // an overconsolidation ratio is not 1
  bool follows = false;            // and the law or the void ratio starts otherwise for it

  void add(const SoilMaterial& material, const InitialPoint& point, const SoilPoints& points, int row) {
    if (asks_strength && !strength) strength = points.soil_state(row).undrained_strength.has_value();
    if (!asks_ratio || point.overconsolidation_ratio == 1) return;
    overconsolidated = true;
    follows = follows || follows_overconsolidation(material, point);
  }
};

void InitialState::check_found(const Soil& soil, const Found& found, const Section& section) const {
  const auto any = [&](bool here) { return on_any_rank(*soil.space->dofs()->comm(), here); };
  if (found.asks_strength && !any(found.strength))
    section.fail("no soil of this model has a law with an undrained strength",
                 has_strength_ ? "undrained strength" : "undrained strength ratio");
  if (found.asks_ratio && any(found.overconsolidated) && !any(found.follows))
    section.fail(
        "no law of this model follows it, and without a 'K0 friction angle [deg]' the earth pressure at rest does not "
        "either",
        has_ocr_ ? "overconsolidation ratio" : "preoverburden pressure");
}

void InitialState::start_block(const Soil& soil, const SoilBlock& b, const std::optional<GeostaticColumn>& ground,
                               State& state, Found& found, const Section& section) const {
  const SoilPoints points(soil, b, state);
  const auto& numbers = soil.space->mesh().blocks()[b.block].global_ids;
  for (int e = 0; e < b.elements; ++e)
    for (int q = 0; q < b.points; ++q) {
      const int row = e * b.points + q;
      const SoilMaterial& material = *soil.materials[static_cast<int>(b.start(row, 0))];
      InitialPoint point;
      point.position = b.place(e, q, state.coordinates);
      point.height = soil.height(point.position);
      point.element = static_cast<int>(numbers[e] + 1);
      point.number = q + 1;
      std::string reason = set_stress(soil, ground, material, point);
      if (reason.empty()) reason = material.find_void_ratio(point);
      if (reason.empty()) reason = write_point(b, row, material, point, state);
      if (!reason.empty())
        section.fail("material '" + material.name + "' cannot start at " +
                     place_text(point.position, soil.space->mesh().dimension()) + ": " + reason);
      found.add(material, point, points, row);
    }
}

void InitialState::apply(const Soil& soil, StateStore& store, const Gravity& gravity, const Section& section) const {
  check(section);
  if (kind_ == Kind::from_result) return;
  const double g = length(gravity.at(0));
  if (g == 0 && length(gravity.vector) > 0 && (kind_ == Kind::geostatic || has_water_))
    section.fail("the 'gravity factor' is 0 at t = 0, when this start takes gravity", "type");
  check_model(soil, g, section);
  const std::optional<GeostaticColumn> column = ground(soil, g, section);
  if (column) set_pressure(soil, store, [&](double y) { return column->pore_pressure(y); });
  if (!column && kind_ != Kind::stress_free) set_pressure(soil, store, [&](double) { return pressure_; });
  Found found{has_strength_ || has_strength_ratio_, !has_k0_angle_ && (has_ocr_ || has_preoverburden_)};
  // any rank may find a problem
  agree(*soil.space->dofs()->comm(), [&] {
    for (const SoilBlock& b : soil.blocks) start_block(soil, b, column, store.committed(), found, section);
  });
  check_found(soil, found, section);
}

}  // namespace mudline
