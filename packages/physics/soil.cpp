#include "physics/soil.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "algebra/over_ranks.hpp"
#include "core/guarded.hpp"
#include "core/text.hpp"
#include "core/told.hpp"
#include "discretisation/agree.hpp"
#include "discretisation/mesh_topology.hpp"
#include "materials/guarded_law.hpp"
#include "tensor/vec.hpp"

namespace mudline {

void SoilMaterial::parameters(Parameters& p) {
  p.add("regions", regions, "mesh regions made of this soil; empty: all of them");
  p.add_of_place(
      "top", top, "m", any(),
      "the material is a layer: the soil of its regions below this height, counted against gravity, down to the next "
      "lower top among the materials of the region; function of the place at the start. Without it: up to the "
      "surface");
  has_top = p.given("top");
  p.add("grain density", grain_density, "kg/m3", positive(), "density of the solid grains");
  p.let_vary(&pores_);
  p.add("void ratio", initial_void_ratio, "-", non_negative(), "initial void ratio e (give this or the porosity)");
  double porosity = initial_porosity();
  p.add("porosity", porosity, "-", half_open(0, 1), "initial porosity n = e/(1+e) (give this or the void ratio)");
  p.let_vary(nullptr);
  p.add("void ratio from law", void_ratio_from_law,
        "the initial void ratio follows from stress and overconsolidation by the skeleton law, point by point (instead "
        "of 'void ratio')");
  p.add("Biot coefficient", biot_coefficient, "-", closed(0, 1), "alpha in sigma = sigma' - alpha p");
  p.add("grain bulk modulus", grain_bulk_modulus, "Pa", non_negative(), "K_s of the grains; 0: incompressible grains");
  double density = 0;
  p.add("density", density, "kg/m3", non_negative(),
        "bulk density of a single-phase soil (instead of the grain density)");
  p.passes_on("skeleton", "effective-stress law; see the skeleton types");
  p.passes_on("fluid", "pore fluid; see the fluid types (saturated soil only)");
  p.passes_on("permeability", "conductivity law; see the permeability types (saturated soil only)");
  permeability_ratios.parameters(p);
  if (p.documenting() || p.deck().has_section("retention"))
    p.section("retention", retention, "water that the soil keeps under suction; without it the soil is saturated");
  if (p.documenting()) return;
  if (retention.acts() && !p.deck().has_section("fluid"))
    p.deck().fail("there is no 'fluid' that the pores could keep", "retention");
  if (retention.acts() && (biot_coefficient != 1 || grain_bulk_modulus > 0))
    p.deck().fail("it is for a 'Biot coefficient' of 1 and incompressible grains", "retention");
  if (permeability_ratios.given() && !p.deck().has_section("permeability"))
    p.deck().fail("there is no 'permeability' to which the ratios refer", "permeability ratios");
  const bool both = p.given("porosity") && p.given("void ratio"), none = !p.given("porosity") && !p.given("void ratio");
  if (both) p.deck().fail("contradictory: give 'void ratio' or 'porosity', not both", "porosity");
  if (void_ratio_from_law && !none)
    p.deck().fail("contradictory: with 'void ratio from law' there is no 'void ratio' or 'porosity'",
                  "void ratio from law");
  if (void_ratio_varies() && p.given("density"))
    p.deck().fail((void_ratio_from_law ? "with 'void ratio from law'" : "where the pores are a function of the place") +
                      std::string(" the weight follows from 'grain density'; give that instead"),
                  "density");
  if (p.given("porosity")) initial_void_ratio = porosity / (1 - porosity);
  if (p.given("density")) {
    if (p.deck().has_section("fluid"))
      p.deck().fail("a saturated soil takes 'grain density', not 'density'", "density");
    if (p.given("grain density"))
      p.deck().fail("contradictory: give 'density' or 'grain density', not both", "density");
    grain_density = density * (1 + initial_void_ratio);
  }
  if (!none && pores_.empty() && initial_void_ratio == 0 && p.deck().has_section("fluid"))
    p.deck().fail("a saturated soil has pores: must be greater than 0",
                  p.given("porosity") ? "porosity" : "void ratio");
}

namespace {

/// Checks that the values of a fluid and a permeability, which may be plugins, are usable.
void check_fluid(const SoilMaterial& material, const Section& section) {
  const Section fluid = section.section("fluid"), permeability = section.section("permeability");
  const auto check = [](const Section& where, const std::string& what, double value, bool allowed) {
    if (!allowed) where.fail("the " + what + " is " + number_text(value) + ", which cannot be", "type");
  };
  guarded(fluid, "type", "the fluid's properties cannot be had", [&] {
    const double rho = material.fluid->density(), bulk = material.fluid->bulk_modulus(),
                 weight = material.fluid->unit_weight();
    check(fluid, "fluid's density", rho, rho >= 0 && std::isfinite(rho));
    check(fluid, "fluid's bulk modulus", bulk, bulk > 0);
    check(fluid, "fluid's unit weight", weight, weight > 0 && std::isfinite(weight));
  });
  const double e = material.void_ratio_varies() ? 1.0 : material.initial_void_ratio;
  guarded(permeability, "type", "the conductivity cannot be had", [&] {
    const double k = material.permeability->conductivity(e, e).k;
    check(permeability, "conductivity at the void ratio " + number_text(e), k, k >= 0 && std::isfinite(k));
  });
}

}  // namespace

std::shared_ptr<SoilMaterial> SoilMaterial::read(const Section& section, const MaterialRegistries& registries) {
  auto material = std::make_shared<SoilMaterial>();
  material->name = section.name();
  Parameters p(section);
  material->parameters(p);
  for (const std::string& group : registries.properties.names()) p.passes_on(group, "");
  p.finish();
  for (const std::string& group : registries.properties.names())
    if (section.has_section(group))
      material->properties[group] = registries.properties.create_by_name(section.section(group));
  const bool some = p.given("porosity") || p.given("void ratio") || material->void_ratio_from_law;
  if (!some && section.has_section("fluid"))
    section.fail("required parameter 'void ratio' (or 'porosity', or 'void ratio from law') is missing");
  const Section skeleton = section.section("skeleton");
  if (section.has_section("skeleton")) {
    material->skeleton = registries.skeletons.create(skeleton);
    material->law = skeleton.text("type");
    if (const std::string problem = state_problem(*material->skeleton); !problem.empty())
      skeleton.fail(problem, "type");
  } else if (material->properties.empty()) {
    section.fail("required section 'skeleton' is missing");
  }
  if (section.has_section("fluid")) material->fluid = registries.fluids.create(section.section("fluid"));
  if (section.has_section("permeability"))
    material->permeability = registries.permeabilities.create(section.section("permeability"));
  if (material->fluid && !material->permeability)
    section.fail("a saturated soil needs a section 'permeability' beside its 'fluid'");
  if (material->permeability && !material->fluid)
    section.fail("a section 'permeability' needs a section 'fluid' beside it");
  if (material->fluid) check_fluid(*material, section);
  for (const char* entry : {"Biot coefficient", "grain bulk modulus"})
    if (!material->fluid && section.has_parameter(entry))
      section.fail("has a meaning only beside a 'fluid', whose pressure acts on the grains", entry);
  if (material->biot_coefficient < material->initial_porosity() && material->fluid)
    section.fail("the Biot coefficient must not be below the porosity " + std::to_string(material->initial_porosity()),
                 "Biot coefficient");
  return material;
}

double SoilMaterial::void_ratio_at(const Point& place) const {
  if (pores_.empty()) return initial_void_ratio;
  const double value = pores_.front().function(0, place);
  return pores_.front().name == "porosity" ? value / (1 - value) : value;
}

std::string SoilMaterial::find_void_ratio(InitialPoint& point) const {
  point.void_ratio = void_ratio_from_law ? skeleton->void_ratio(point) : void_ratio_at(point.position);
  if (!void_ratio_varies()) return "";
  if (point.void_ratio == Skeleton::no_void_ratio)
    return "the skeleton law has no void ratio of its own here (Modified Cam Clay has one with a 'normal compression "
           "volume' or "
           "'critical state volume', and under a compressive stress); give 'void ratio' instead of 'void ratio from "
           "law'";
  const std::string origin = void_ratio_from_law ? "of the skeleton law" : "that the deck gives here";
  if (!(point.void_ratio > 0))
    return "the void ratio " + origin + ", " + std::to_string(point.void_ratio) + ", is not positive";
  if (porous() && point.void_ratio > biot_coefficient * (1 + point.void_ratio))
    return "the porosity " + origin + ", " + std::to_string(point.void_ratio / (1 + point.void_ratio)) +
           ", exceeds the Biot coefficient";
  return "";
}

double SoilMaterial::density(double porosity, double saturation) const {
  return (1 - porosity) * grain_density + (fluid ? saturation * porosity * fluid->density() : 0.0);
}

double SoilMaterial::storage(double porosity) const {
  double result = 0;
  if (fluid && std::isfinite(fluid->bulk_modulus())) result += porosity / fluid->bulk_modulus();
  if (grain_bulk_modulus > 0) result += (biot_coefficient - porosity) / grain_bulk_modulus;
  return result;
}

Point Soil::water_weight(int block, double time) const {
  const SoilMaterial& material = any_of(blocks[block]);
  return material.porous() ? material.fluid->density() * water_gravity(time) : Point{};
}

double Soil::uplift(const SoilMaterial& material) const {
  return excess && material.porous() ? material.biot_coefficient * material.fluid->density() : 0.0;
}

std::shared_ptr<std::vector<FieldBlock>> Soil::blocks_with(int field) const {
  const auto result = std::make_shared<std::vector<FieldBlock>>();
  for (const SoilBlock& b : blocks)
    result->emplace_back(*space, b.block, displacement, std::vector<int>{pressure, field}, b.degree);
  return result;
}

void Soil::choose_strain(bool slides) {
  const auto hardens = [this](int k) { return materials[k]->skeleton->hardens_with_volume(); };
  const bool all = saturated_strain == SaturatedStrain::water_balance;
  const bool some =
      saturated_strain == SaturatedStrain::hardening || (saturated_strain == SaturatedStrain::automatic && slides);
  for (SoilBlock& b : blocks)
    b.sees_water = !b.dries && (all || (some && std::any_of(b.made_of.begin(), b.made_of.end(), hardens)));
}

void Soil::declare_state(StateStore& store) {
  for (SoilBlock& b : blocks) {
    const std::string prefix = space->mesh().blocks()[b.block].region + "/";
    const std::string suffix =
        store.find(prefix + "effective stress") >= 0 ? std::string("#") + std::to_string(b.block) : "";
    const auto at_points = [&](const std::string& what, std::vector<StateVariable> variables) {
      return ArrayInfo::at_points(prefix + what + suffix, std::move(variables), space->mesh(), b.block, b.points);
    };
    b.stress = store.declare(at_points("effective stress", {{"effective stress", 6, "Pa"}}).then_evaluated());
    b.void_ratio =
        store.declare(at_points("void ratio", {{"void ratio", 1, "-", Transfer::mass, b.porous() ? 0.0 : -1.0},
                                               {"initial void ratio", 1, "-"}}));
    // the states of all laws of a block begin in the same column
    const auto widest = std::max_element(b.made_of.begin(), b.made_of.end(), [&](int one, int two) {
      return materials[one]->skeleton->state_size() < materials[two]->skeleton->state_size();
    });
    b.law = store.declare(at_points("law", materials[*widest]->skeleton->state_variables()).then_evaluated());
    if (std::any_of(b.made_of.begin(), b.made_of.end(),
                    [&](int k) { return materials[k]->permeability_ratios.given(); }))
      b.permeability = store.declare(at_points("permeability ratios", {{"permeability ratios", 6, "-"}}));
    if (std::any_of(b.made_of.begin(), b.made_of.end(), [&](int k) { return materials[k]->conductivity_varies(); }))
      b.conductivity = store.declare(
          at_points("conductivity", {{"hydraulic conductivity", 1, "m/s", Transfer::value, 0.0},
                                     {"reference void ratio of conductivity", 1, "-", Transfer::value, 0.0},
                                     {"permeability index", 1, "-", Transfer::value, 0.0}}));
    if (!layered()) continue;
    std::vector<StateVariable> place{{"material", 1, "-"}};
    for (int i = 0; i < space->mesh().dimension(); ++i)
      place.push_back({std::string("place at the start ") + axis_names[i], 1, "m"});
    b.origin = store.declare(at_points("material", place));
  }
}

void Soil::sparsity(Assembler& assembler) {
  for (SoilBlock& b : blocks) b.group = b.mass.group = assembler.add_group(b.dofs);
}

bool Soil::dries() const {
  return std::any_of(blocks.begin(), blocks.end(), [](const SoilBlock& b) { return b.dries; });
}

void Soil::require_saturated(const Section& section, const std::string& entry) const {
  if (dries()) section.fail("it is for saturated soil; a material has a 'retention'", entry);
}

bool Soil::layered() const {
  return std::any_of(blocks.begin(), blocks.end(), [](const SoilBlock& b) { return b.made_of.size() > 1; });
}

namespace {

constexpr double ramp = 1.4;  // with it the cut-off volume of an element is accurate to 2 to 4 % of the element (rms)

/// Height [m] of the top of a material at a position of the start.
double top_of(const SoilMaterial& material, const Point& start) {
  return material.has_top ? material.top(0, start) : 1e300;
}

}  // namespace

double Soil::extent() const {
  const Bounds& bounds = space->mesh().bounds();
  double sum = 0;
  for (int i = 0; i < 3; ++i) sum += std::abs(up[i]) * (bounds.high[i] - bounds.low[i]);
  return sum;
}

int Soil::material_at(const SoilBlock& b, const Point& start) const {
  const auto top = [&](int k) { return top_of(*materials[k], start); };
  const double here = height(start);
  int best = b.made_of.front();
  double lowest = top(best);
  for (int k : b.made_of) {
    const double other = top(k);
    const bool above = other >= here, better = lowest >= here ? above && other < lowest : other > lowest;
    if (better) best = k;
    if (better) lowest = other;
  }
  return best;
}

std::vector<double> Soil::layer_shares(const SoilBlock& b, const std::vector<Point>& starts) const {
  const std::size_t count = b.made_of.size(), points = starts.size();
  const auto top = [&](std::size_t k, const Point& start) { return top_of(*materials[b.made_of[k]], start); };
  std::vector<std::size_t> order(count);  // order of the materials from the top down
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t k) { return top(i, starts.front()) > top(k, starts.front()); });
  std::vector<double> shares(points * count, 0.0), above(points, 0.0), over(points);
  for (std::size_t i = 1; i <= count; ++i) {
    if (i < count) {
      for (std::size_t q = 0; q < points; ++q) over[q] = height(starts[q]) - top(order[i], starts[q]);
      const auto [lowest, highest] = std::minmax_element(over.begin(), over.end());
      const double width = ramp * (*highest - *lowest) / std::sqrt(static_cast<double>(points));
      for (double& h : over) h = width > 0 ? std::clamp(0.5 + h / width, 0.0, 1.0) : (h > 0 ? 1.0 : 0.0);
    } else {
      std::fill(over.begin(), over.end(), 1.0);
    }
    for (std::size_t q = 0; q < points; ++q) {
      over[q] = std::max(over[q], above[q]);
      shares[q * count + order[i - 1]] = over[q] - above[q];
      above[q] = over[q];
    }
  }
  return shares;
}

std::vector<double> Soil::layer_shares(const SoilBlock& b, const State& state, int element) const {
  std::vector<Point> starts(b.points, Point{});
  for (int q = 0; q < b.points; ++q)
    for (int d = 0; d < space->mesh().dimension(); ++d)
      starts[q][d] = state.arrays[b.origin](element * b.points + q, 1 + d);
  return layer_shares(b, starts);
}

void Soil::place_materials(const Section& section) {
  const auto& x = space->mesh().coordinates();
  std::string problem;
  std::vector<int> here(materials.size(), 0);
  for (SoilBlock& b : blocks) {
    b.start = PointView("material", b.elements * b.points, 1);
    for (int row = 0; row < b.elements * b.points; ++row) {
      const Point place = b.place(row / b.points, row % b.points, x);
      const int k = material_at(b, place);
      const SoilMaterial& material = *materials[k];
      b.start(row, 0) = k;
      ++here[k];
      if (problem.empty() && material.has_top && !(material.top(0, place) >= height(place)))
        problem = "no material at " + place_text(place, space->mesh().dimension()) +
                  ": it lies above the 'top' of every material of mesh region '" +
                  space->mesh().blocks()[b.block].region + "'; the uppermost one needs none";
    }
  }
  const auto& comm = *space->dofs()->comm();
  agree(comm, [&] {
    if (!problem.empty()) section.fail(problem);
  });
  const std::vector<int> everywhere = sum_over_ranks(comm, here);
  for (std::size_t k = 0; k < materials.size(); ++k)
    if (everywhere[k] == 0 && materials[k]->has_top)
      section.fail("no soil is made of '" + materials[k]->name +
                       "': no point of its regions lies below this and above " + "the next lower 'top'",
                   materials[k]->name + "/top");
}

Field displacement_field() { return {"displacement", "m", "N", vector_components, Support::all_nodes, 2}; }
Field pore_pressure_field() { return {"pore pressure", "Pa", "m3/s", 1, Support::vertices, 1}; }

namespace {

/// Sufficient degree for the strains of a cell: three points in a tri3, four in a tet4 or tet10, two per direction in a
/// quad4 or hex8, three per direction in a quad9 or hex27, six in a tri6, three in each layer of a wedge.
int default_degree(CellShape shape) {
  if (dimension(shape) == 3 && simplex_coordinates(shape) > 0) return 2;
  if (order(shape) == 1) return is_simplex(shape) ? 2 : 3;
  return 4;
}

/// InputError if a material does not fit the fields of the physics.
void check_phases(const SoilMaterial& material, bool porous, const Section& where) {
  if (!material.skeleton) where.section(material.name).fail("required section 'skeleton' is missing");
  if (porous && !material.porous())
    where.fail(
        "material '" + material.name + "' needs the sections 'fluid' and 'permeability' in a physics of saturated soil",
        material.name);
  if (!porous && material.porous())
    where.fail("material '" + material.name +
                   "' has a pore fluid, but physics 'solid' is single-phase; remove 'fluid' and "
                   "'permeability', or use physics 'biot'",
               material.name);
}

/// InputError if the materials of a region cannot be its layers.
void check_layers(const std::vector<std::shared_ptr<const SoilMaterial>>& layers, const std::string& region,
                  const Section& where) {
  for (std::size_t k = 1; k < layers.size(); ++k)
    for (std::size_t i = 0; i < k; ++i) {
      const SoilMaterial &one = *layers[i], &two = *layers[k];
      const std::string both = "'" + one.name + "' and '" + two.name + "'";
      if (!one.has_top && !two.has_top)
        where.fail("mesh region '" + region + "' has two materials, " + both +
                   "; as layers all but the uppermost one need a 'top'");
      if (one.has_top && two.has_top && one.top.is_constant() && two.top.is_constant() &&
          one.top(0, {}) == two.top(0, {}))
        where.fail("the layers " + both + " of mesh region '" + region + "' have the same top", two.name + "/top");
      if (one.fluid && two.fluid &&
          (one.fluid->density() != two.fluid->density() || one.fluid->bulk_modulus() != two.fluid->bulk_modulus() ||
           one.fluid->unit_weight() != two.fluid->unit_weight()))
        where.fail("the layers " + both + " of mesh region '" + region +
                       "' have different pore fluids: water does not stay with the layer; give both the same",
                   two.name + "/fluid");
    }
}

/// Terms of the fit of the volume strain in the cells of a block; 0: no fit. There is none where a cell has no more
/// than two points per term: so few points do not lock. Nor is there one where a law joins volume and shear: where
/// yielding changes the volume, the points of a cell would be pressed together or pulled apart without end.
int dilatation_terms(const Soil& soil, const SoilBlock& block, VolumeStrain how) {
  if (how == VolumeStrain::at_points || (how == VolumeStrain::automatic && order(block.shape) > 1)) return 0;
  for (const int k : block.made_of)
    if (!soil.materials[k]->skeleton->volume_apart()) return 0;
  int terms = 1;
  if (block.shape == CellShape::tri3 || block.shape == CellShape::tet4) terms = 0;
  if (block.shape == CellShape::quad9) terms = 3;
  if (block.shape == CellShape::hex27) terms = 4;
  return block.points > 2 * terms ? terms : 0;
}

}  // namespace

std::shared_ptr<Soil> make_soil(const Space& space, const Materials& materials, const std::vector<std::string>& scalars,
                                int degree, VolumeStrain volume_strain, const Section& where) {
  const bool porous = !scalars.empty();
  auto soil = std::make_shared<Soil>();
  soil->space = &space;
  soil->geometry = space.mesh().geometry();
  soil->displacement = space.find("displacement");
  std::vector<int> fields;
  for (const std::string& name : scalars) fields.push_back(space.find(name));
  if (fields.size() > 0) soil->pressure = fields[0];
  if (fields.size() > 1) soil->temperature = fields[1];
  std::map<std::string, std::vector<std::shared_ptr<const SoilMaterial>>> layers;
  for (const std::string& region : space.mesh().regions()) {
    for (const auto& material : materials_of(region, space.mesh(), materials, where))
      layers[region].push_back(std::static_pointer_cast<const SoilMaterial>(material));
    for (const auto& material : layers[region]) check_phases(*material, porous, where);
    check_layers(layers[region], region, where);
  }
  for (const auto& material : materials) {
    const auto used = [&](const auto& entry) {
      return std::find(entry.second.begin(), entry.second.end(), material) != entry.second.end();
    };
    if (std::any_of(layers.begin(), layers.end(), used))
      soil->materials.push_back(std::static_pointer_cast<const SoilMaterial>(material));
  }
  for (std::size_t i = 0; i < space.mesh().blocks().size(); ++i) {
    const ElementBlock& elements = space.mesh().blocks()[i];
    SoilBlock b;
    b.block = static_cast<int>(i);
    for (const auto& material : layers[elements.region])
      b.made_of.push_back(static_cast<int>(std::find(soil->materials.begin(), soil->materials.end(), material) -
                                           soil->materials.begin()));
    b.dries =
        std::any_of(b.made_of.begin(), b.made_of.end(), [&](int k) { return soil->materials[k]->retention.acts(); });
    const int own = degree > 0 ? degree : default_degree(elements.shape);
    static_cast<FieldBlock&>(b) = FieldBlock(space, b.block, soil->displacement, fields, own);
    b.dilatation_terms = porous ? 0 : dilatation_terms(*soil, b, volume_strain);
    const int products = 2 * order(elements.shape);  // degree of the product of two shape functions
    b.mass = own < products ? b.with_quadrature(products) : b;
    soil->blocks.push_back(b);
  }
  return soil;
}

}  // namespace mudline
