#include <algorithm>
#include <cmath>

#include "checks/setup.hpp"
#include "integrator/overlap.hpp"
#include "physics/soil_points.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

std::string material(const Section& entry) { return "material '" + entry.name() + "': "; }

std::string law(const Section& entry) { return Setup::word(entry.section("skeleton"), "type"); }

/// Void ratio at the start, the mean over the material's points.
double void_ratio(const Setup& setup, const Section& entry) { return setup.soils().at(entry.name()).void_ratio; }

double number(const Setup& setup, const Section& section, const std::string& name, double fallback) {
  const Span span = setup.given(section, name);
  return span.known() ? span.high : fallback;
}

bool has_friction(const Setup& setup, const Section& entry) {
  return number(setup, entry.section("skeleton"), "friction angle [deg]", 0) >= 20;
}

void grain_density(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.materials()) {
    const Span given = setup.given(entry, "grain density");
    if (given.known() && void_ratio(setup, entry) > 0)  // without pores it is the density of a solid
      judge(given.high, material(entry) + "'grain density'",
            "give the mass density of the grains in kg/m3, as 2650 (2.65 is t/m3, 26.5 kN/m3; 1800 may be "
            "that of the soil)");
  }
}

void density(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.materials()) {
    const auto& mean = setup.soils().at(entry.name());
    if (mean.points > 0 && mean.density > 0)
      judge(mean.density, material(entry) + "the density of the soil as a whole",
            "give mass densities in kg/m3 (1.8 is t/m3, 18 kN/m3, 18000 N/m3)");
  }
}

void gravity_direction(const Setup& setup, const Judge& judge) {
  const Point g = setup.gravity_vector();
  if (length(g) == 0) return;
  judge(-g[setup.vertical()] / length(g), "the downward share of 'gravity'",
        std::string("down is -") + axis_names[setup.vertical()] + " in this mesh: gravity = {0, " +
            (setup.dimension() == 3 ? "0, " : "") + "-9.81}");
}

void gravity_size(const Setup& setup, const Judge& judge) {
  const bool hydrostatic = std::any_of(setup.conditions().begin(), setup.conditions().end(),
                                       [](const auto& c) { return c.type == "hydrostatic pressure"; });
  if (setup.gravity() == 0 && !hydrostatic) return;
  judge(setup.gravity(),
        hydrostatic && setup.gravity() == 0 ? "beside a condition 'hydrostatic pressure' the size of 'gravity'"
                                            : "the size of 'gravity', with its factor,",
        "give m/s2, as 9.81 (981 is cm/s2, 9810 mm/s2, 1 a multiple of g)");
}

/// Growth of the pore pressure with depth, over that of water at rest.
void water_at_rest(const Setup& setup, const Judge& judge) {
  const Soil& soil = *setup.model().soil();
  const int up = setup.vertical();
  if (!setup.porous() || soil.excess || setup.gravity() == 0 || soil.up[up] < 0.99) return;
  const Stage& first = *setup.model().stages().front();
  const Span factor = setup.given(*setup.gravity_entry(), "gravity factor", 0, 0);
  if (factor.known() && factor.high == 0) return;  // gravity is applied later
  if (first.type == Stage::Type::dynamic) return;  // a dynamic run may leave out the soil's own weight
  const State& state = setup.model().store().committed();
  const Mesh& mesh = setup.mesh();
  const auto& dof = soil.space->node_dof(soil.pressure);
  std::vector<double> sums(5, 0.0);  // sums of 1, y, p, y y, y p for the slope of a least-squares line
  for (int node = 0; node < mesh.num_owned_nodes(); ++node) {
    if (dof(node) < 0) continue;
    const double y = mesh.place(node)[up] - mesh.bounds().low[up], p = state.value(dof(node));
    const double terms[5] = {1, y, p, y * y, y * p};
    for (int i = 0; i < 5; ++i) sums[i] += terms[i];
  }
  sums = sum_over_ranks(*mesh.comm(), sums);
  const double spread = sums[0] * sums[3] - sums[1] * sums[1];
  if (!(spread > 0)) return;
  const double slope = -(sums[0] * sums[4] - sums[1] * sums[2]) / spread;
  const double weight = soil.any_of(soil.blocks.front()).fluid->density() * length(soil.gravity(0));
  judge(slope / weight, "the growth of the pore pressure with depth at the start, over that of water at rest,",
        "give the start a 'water level', or count pore pressures in excess of water at rest ('pore pressure' = "
        "excess); otherwise the water flows down from the start");
}

/// Largest suction at the start, of water above the water level.
void suction(const Setup& setup, const Judge& judge) {
  const Soil& soil = *setup.model().soil();
  if (!setup.porous() || soil.excess) return;
  const State& state = setup.model().store().committed();
  double lowest = 0;
  for (const SoilBlock& b : soil.blocks) {
    if (b.dries) continue;
    for (int e = 0; e < b.elements; ++e)
      for (int c = 0; c < b.p.nodes; ++c)
        lowest = std::min(lowest, state.value(b.dofs(e, setup.dimension() * b.u.nodes + c)));
  }
  lowest = min_over_ranks(*setup.mesh().comm(), lowest);
  judge(0.0 - lowest, "the suction at the start, above the water level",
        "soil without a 'retention' is saturated everywhere: give it one, put the water level at the surface, or begin "
        "the mesh at the water level with the soil above as 'surcharge' and load; or widen the range where capillary "
        "water reaches that high");
}

/// Largest height of the cells that start under suction, over the height in which their soil dries.
void drying_cells(const Setup& setup, const Judge& judge) {
  const Soil& soil = *setup.model().soil();
  const State& state = setup.model().store().committed();
  double coarsest = 0;
  for (const SoilBlock& b : soil.blocks) {
    if (!b.dries) continue;
    const SoilPoints points(soil, b, state);
    for (int e = 0; e < b.elements; ++e) {
      const SoilMaterial& material = points.material(e * b.points);
      if (!material.retention.acts() || b.scalar_at(e, 0, 0, state.value) >= 0) continue;
      double low = any_size, high = -any_size;
      for (int a = 0; a < b.u.nodes; ++a) {
        const double y = soil.height(setup.mesh().place(b.nodes(e, a)));
        low = std::min(low, y);
        high = std::max(high, y);
      }
      const double dries_over = material.retention.reference_suction() / material.fluid->unit_weight();
      coarsest = std::max(coarsest, (high - low) / dries_over);
    }
  }
  coarsest = max_over_ranks(*setup.mesh().comm(), coarsest);
  if (coarsest > 0)
    judge(coarsest,
          "the height of a cell above the water level, over that in which its soil dries (reference suction over "
          "unit weight),",
          "make the cells there lower, or the 'reference suction' of the 'retention' larger");
}

void compression_slope(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.materials()) {
    const Span slope = setup.given(entry.section("skeleton"), "compression slope");
    if (slope.known())
      judge(slope.high / (1 + void_ratio(setup, entry)),
            material(entry) + "'compression slope' " + told(slope.high) + " over 1 + e",
            "lambda is the slope over ln p': the compression index Cc divided by 2.303");
  }
}

/// Natural clays: Cc = 0.54 (e - 0.35) (Nishida 1956).
void compression_and_void_ratio(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.materials()) {
    const Span slope = setup.given(entry.section("skeleton"), "compression slope");
    const double e = void_ratio(setup, entry), usual = 0.54 * (e - 0.35) / std::log(10.0);
    if (slope.known() && slope.high > 0.04 && e > 0)
      judge(usual > 0 ? slope.high / usual : any_size,
            material(entry) + "'compression slope' " + told(slope.high) + " over that of clays with e = " + told(e) +
                ", 0.54 (e - 0.35)/2.303,",
            "look whether a porosity was given as 'void ratio' or the reverse, and Cc as lambda");
  }
}

void swelling_ratio(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.materials()) {
    const Section skeleton = entry.section("skeleton");
    const Span lambda = setup.given(skeleton, "compression slope"), kappa = setup.given(skeleton, "swelling slope");
    if (lambda.known() && kappa.known())
      judge(kappa.high / lambda.high, material(entry) + "'swelling slope' over 'compression slope'",
            "both are slopes over ln p': indices Cs and Cc are to be divided by 2.303");
  }
}

void porosity(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.materials()) {
    const Span given = setup.given(entry, "porosity");
    if (given.known() && given.high > 0)
      judge(given.high, material(entry) + "'porosity'", "n = e/(1 + e): 0.8 may be a void ratio");
  }
}

void drained_poisson(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.materials()) {
    const Span given = setup.given(entry.section("skeleton"), "Poisson's ratio");
    if (given.known() && entry.has_section("fluid"))
      judge(given.high, material(entry) + "Poisson's ratio of the drained skeleton",
            "of saturated soil give the drained one, 0.15 to 0.35: the pore water makes it incompressible");
  }
}

void undrained_poisson(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.materials()) {
    const Span given = setup.given(entry.section("skeleton"), "Poisson's ratio");
    if (given.known() && law(entry) == "tresca" && !entry.has_section("fluid"))
      judge(given.low, material(entry) + "Poisson's ratio of undrained soil in total stress",
            "undrained soil keeps its volume: 0.49 or so");
  }
}

void permeability_index(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.materials()) {
    const Span given = setup.given(entry.section("permeability"), "permeability index");
    if (given.known() && void_ratio(setup, entry) > 0)
      judge(given.high / void_ratio(setup, entry), material(entry) + "'permeability index' over the void ratio",
            "Ck is the change of e for a tenfold conductivity, about e/2");
  }
}

/// A clay's conductivity grows with its void ratio and falls with its plasticity, for which its compression slope
/// stands.
void clay_conductivity(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.materials()) {
    const Span slope = setup.given(entry.section("skeleton"), "compression slope");
    const auto& mean = setup.soils().at(entry.name());
    if (!slope.known() || slope.high < 0.02 || !(mean.conductivity > 0) || !(mean.void_ratio > 0)) continue;
    const double usual = 1e-9 * std::pow(mean.void_ratio, 4) * std::pow(0.1 / slope.high, 2);
    judge(mean.conductivity / usual,
          material(entry) + "the conductivity of " + told(mean.conductivity) +
              " m/s, over that of clays of this void ratio and compression slope, about " + told(usual, "%.1g") +
              " m/s,",
          "give m/s (1e-7 may be cm/s, 1e-4 m/day or m/year, 1e-16 m2)");
  }
}

void sand_conductivity(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.materials()) {
    const auto& mean = setup.soils().at(entry.name());
    if (!has_friction(setup, entry) || !(mean.conductivity > 0)) continue;
    if (number(setup, entry.section("skeleton"), "cohesion", 0) > 5e3) continue;
    judge(mean.conductivity, material(entry) + "the conductivity of a frictional soil",
          "give m/s: sands have 1e-6 to 1e-2 (1e-11 may be m2, 10 m/day)");
  }
}

/// alpha = 1 - K/K_s.
void grain_compressibility(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.materials()) {
    const Span alpha = setup.given(entry, "Biot coefficient"), grains = setup.given(entry, "grain bulk modulus");
    const auto& mean = setup.soils().at(entry.name());
    if (!alpha.known() && !grains.known()) continue;
    const double bulk = mean.modulus - 4.0 / 3 * mean.shear;
    const double share = grains.known() && grains.high > 0 ? bulk / grains.high : 0;
    judge((alpha.known() ? alpha.high : 1) + share,
          material(entry) + "'Biot coefficient' + K/'grain bulk modulus', with K = " + readable(bulk, "Pa", 3) + ",",
          "alpha = 1 - K/K_s: give both, K_s in Pa, as 36e9 (36 is GPa, 3.6e7 kPa)");
  }
}

void weight_over_stiffness(const Setup& setup, const Judge& judge) {
  const auto& soil = setup.soil();
  if (setup.gravity() == 0 || !(soil.modulus > 0)) return;
  const double weight = soil.density * setup.gravity() * setup.extent(setup.vertical());
  judge(weight / soil.modulus,
        "the soil's own weight, " + readable(weight, "Pa", 3) + " at the base, over its stiffness, " +
            readable(soil.modulus, "Pa", 3) + ",",
        "give stiffnesses in Pa, densities in kg/m3 and lengths in m: a model in kPa needs t/m3");
}

void rigidity(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.materials()) {
    const Section skeleton = entry.section("skeleton");
    const Span index = setup.given(skeleton, "rigidity index");
    Span strength = setup.given(skeleton, "undrained strength");
    if (law(entry) == "mohr-coulomb" && !has_friction(setup, entry)) strength = setup.given(skeleton, "cohesion");
    double value = index.known() ? index.high : 0;
    if (!index.known() && strength.known() && strength.high > 0)
      value = setup.soils().at(entry.name()).shear / strength.high;
    if (value > 0 && !(law(entry) == "tresca" && setup.given(skeleton, "undrained strength gradient").high > 0))
      judge(value, material(entry) + "the rigidity index G/s_u",
            "give strength and stiffness in Pa; clays have 50 to 1000");
  }
}

/// Pore pressure and stress of a uniform start.
void uniform_start(const Setup& setup, const Judge& judge) {
  for (const Section& entry : setup.physics()) {
    const Section start = entry.section("initial state");
    for (const char* name : {"effective stress xx", "effective stress yy", "effective stress zz", "pore pressure"}) {
      const Span given = setup.given(start, name);
      if (given.known() && given.high != 0 && (given.high < 0 || !setup.scales()))
        judge(given.high, "physics '" + entry.name() + "': '" + name + "' of the start",
              "give it in Pa (100 may be kPa), compression positive");
    }
  }
}

}  // namespace

std::vector<Check<Setup>> material_checks() {
  return {
      {{"grain density", "kg/m3", {1900, 5500}, "of the grains of a soil with pores"}, grain_density},
      {{"density", "kg/m3", {300, 12000}, "of the soil as a whole at the start, mean of a material"}, density},
      {{"gravity", "m/s2", {3, 12}, "its size, with its factor; 0 is doubted where water at rest is prescribed"},
       gravity_size},
      {{"gravity direction", "-", {0.7, 1}, "share of gravity that points down, along the mesh's last axis"},
       gravity_direction},
      {{"water at rest",
        "-",
        {0.8, 1.2},
        "growth of the pore pressure with depth at the start over that of water at rest, "
        "where gravity acts and pore pressures are total"},
       water_at_rest},
      {{"suction", "Pa", {0, 2e4}, "at the start, of soil without a retention"}, suction},
      {{"drying cells",
        "-",
        {0, 4},
        "height of cells under suction at the start times unit weight over reference suction"},
       drying_cells},
      {{"compression slope", "-", {0.01, 0.15}, "lambda/(1 + e) of a clay"}, compression_slope},
      {{"compression by void ratio", "-", {0.2, 4}, "lambda over what the void ratio suggests, 0.54 (e - 0.35)/2.303"},
       compression_and_void_ratio},
      {{"swelling ratio", "-", {0.04, 0.4}, "kappa/lambda of a clay"}, swelling_ratio},
      {{"porosity", "-", {0.1, 0.75}, "as given; 0: a solid"}, porosity},
      {{"drained Poisson's ratio", "-", {0, 0.45}, "of the skeleton of a saturated soil"}, drained_poisson},
      {{"undrained Poisson's ratio", "-", {0.4, 0.5}, "of a Tresca soil in total stress"}, undrained_poisson},
      {{"permeability index", "-", {0.15, 1.5}, "Ck/e"}, permeability_index},
      {{"clay conductivity", "-", {1e-3, 200}, "over 1e-9 m/s e^4 (0.1/lambda)^2"}, clay_conductivity},
      {{"sand conductivity", "m/s", {1e-9, 0.1}, "of a soil with friction and cohesion of 5 kPa at most"},
       sand_conductivity},
      {{"grain compressibility", "-", {0.95, 1.05}, "Biot coefficient + K/K_s"}, grain_compressibility},
      {{"weight over stiffness", "-", {0, 0.5}, "weight of the soil over the whole height, over its mean stiffness"},
       weight_over_stiffness},
      {{"rigidity index", "-", {10, 1e6}, "G/s_u"}, rigidity},
      {{"initial stress",
        "Pa",
        {500, 1e8},
        "or pore pressure of a uniform start, where it is not 0; positive ones of soil with weight or strength only"},
       uniform_start},
  };
}

}  // namespace mudline
