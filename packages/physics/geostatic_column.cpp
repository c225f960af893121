#include "physics/geostatic_column.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "algebra/over_ranks.hpp"

namespace mudline {

namespace {

constexpr int parts = 400;  // integration steps in a layer whose density varies with the depth

/// Height ranges of the materials of a region, from the top; empty if some top is not horizontal.
std::vector<std::pair<const SoilMaterial*, std::array<double, 2>>> slices(const Soil& soil, const SoilBlock& b,
                                                                          const std::array<double, 2>& range) {
  std::vector<std::pair<const SoilMaterial*, std::array<double, 2>>> result;
  for (int k : b.made_of) {
    const SoilMaterial& material = *soil.materials[k];
    if (b.made_of.size() > 1 && material.has_top && !material.top.is_constant()) return {};
    const bool whole = b.made_of.size() == 1 || !material.has_top;
    result.push_back({&material, {range[0], whole ? range[1] : std::min(range[1], material.top(0, {}))}});
  }
  std::sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.second[1] > b.second[1]; });
  for (std::size_t i = 0; i + 1 < result.size(); ++i) result[i].second[0] = result[i + 1].second[1];
  return result;
}

/// Lowest and highest node of every region, by name. Collective.
std::map<std::string, std::array<double, 2>> heights(const Soil& soil) {
  const Mesh& mesh = soil.space->mesh();
  const std::vector<std::string>& regions = mesh.regions();
  std::vector<double> here(2 * regions.size(), -1e300);  // minus the lowest, the highest
  for (const ElementBlock& block : mesh.blocks()) {
    const std::size_t k = std::find(regions.begin(), regions.end(), block.region) - regions.begin();
    for (int e = 0; e < block.num_elements; ++e)
      for (int a = 0; a < num_nodes(block.shape); ++a) {
        const double height = soil.height(mesh.place(block.nodes(e, a)));
        here[2 * k] = std::max(here[2 * k], -height);
        here[2 * k + 1] = std::max(here[2 * k + 1], height);
      }
  }
  const std::vector<double> everywhere = max_over_ranks(*mesh.comm(), here);
  std::map<std::string, std::array<double, 2>> result;
  for (std::size_t k = 0; k < regions.size(); ++k) result[regions[k]] = {-everywhere[2 * k], everywhere[2 * k + 1]};
  return result;
}

}  // namespace

GeostaticColumn::GeostaticColumn(const Soil& soil, double gravity, std::optional<double> water_level,
                                 const Section& section)
    : gravity_(gravity), water_level_(water_level) {
  const Mesh& mesh = soil.space->mesh();
  for (const auto& [region, range] : heights(soil)) {
    const SoilBlock* block = nullptr;
    for (const SoilBlock& b : soil.blocks)  // every rank has every block
      if (mesh.blocks()[b.block].region == region) block = &b;
    const auto parts = slices(soil, *block, range);
    if (parts.empty())
      section.fail("the 'top' of a material of mesh region '" + region +
                       "' varies with the place; use a stage of type 'geostatic' from a uniform state",
                   "type");
    for (const auto& [material, heights] : parts) {
      const double fluid = material->porous() && !soil.excess ? material->fluid->density() : 0.0;
      layers_.push_back({heights[0], heights[1], soil.uplift(*material), fluid, material});
    }
  }
  std::sort(layers_.begin(), layers_.end(), [](const Layer& a, const Layer& b) { return a.top > b.top; });
  double bottom = layers_.front().bottom;
  for (const Layer& layer : layers_) bottom = std::min(bottom, layer.bottom);
  const double tolerance = 1e-6 * (layers_.front().top - bottom);
  for (std::size_t i = 1; i < layers_.size(); ++i) {
    const Layer &above = layers_[i - 1], &here = layers_[i];
    if (here.top <= above.bottom + tolerance || here.material == above.material) continue;
    const bool varying = here.varies() || above.varies();
    if (!varying && std::abs(here.constant_density() - above.constant_density()) < 1e-9 &&
        here.fluid_density == above.fluid_density)
      continue;  // regions of the same weight side by side
    section.fail(
        "the mesh regions are not horizontal layers; use a stage of type 'geostatic' from a uniform state, or one "
        "density of soil and pore fluid",
        "type");
  }
}

void GeostaticColumn::weigh(double surcharge, const Density& density) {
  stations_.clear();
  double y = layers_.front().top;
  double stress = surcharge + layers_.front().material->biot_coefficient * std::max(0.0, pore_pressure(y));
  for (const Layer& layer : layers_) {
    const double from = std::min(layer.top, y);
    if (from <= layer.bottom) continue;
    const bool varying = layer.varies();
    const int n = varying ? parts : 1;
    const double h = (from - layer.bottom) / n;
    const auto slope = [&](double height, double total) {
      return gravity_ * (varying ? density(*layer.material, height, total) - layer.uplift : layer.constant_density());
    };
    for (int i = 0; i < n; ++i) {  // Runge-Kutta of fourth order
      const double at = from - i * h;
      const double a = slope(at, stress), b = slope(at - 0.5 * h, stress + 0.5 * h * a);
      const double c = slope(at - 0.5 * h, stress + 0.5 * h * b), d = slope(at - h, stress + h * c);
      stations_.push_back({at, stress, a});
      stress += h / 6 * (a + 2 * b + 2 * c + d);
    }
    stations_.push_back({layer.bottom, stress, slope(layer.bottom, stress)});
    y = layer.bottom;
  }
}

double GeostaticColumn::fluid_weight(double y) const {
  double weight = 0, from = layers_.back().bottom;
  for (auto layer = layers_.rbegin(); layer != layers_.rend(); ++layer) {
    const bool lowest = layer == layers_.rbegin(), highest = layer + 1 == layers_.rend();
    // the lowest layer extends downwards and the uppermost one upwards without end
    const double to = highest ? y : lowest ? std::min(y, layer->top) : std::max(from, std::min(y, layer->top));
    weight += layer->fluid_density * gravity_ * (to - from);
    from = to;
    if (!highest && y <= layer->top) break;
  }
  return weight;
}

double GeostaticColumn::pore_pressure(double y) const {
  return water_level_ ? fluid_weight(*water_level_) - fluid_weight(y) : 0;
}

double GeostaticColumn::total_stress(double y) const {
  // the last station at or above y
  auto below = std::find_if(stations_.begin(), stations_.end(), [&](const Station& s) { return s.y < y; });
  if (below == stations_.begin()) return stations_.front().stress;
  if (below == stations_.end()) return stations_.back().stress + stations_.back().slope * (stations_.back().y - y);
  const Station &a = *(below - 1), &b = *below;
  const double h = a.y - b.y, t = (a.y - y) / h;
  return (1 + 2 * t) * (1 - t) * (1 - t) * a.stress + t * (1 - t) * (1 - t) * h * a.slope +
         t * t * (3 - 2 * t) * b.stress + t * t * (t - 1) * h * b.slope;
}

}  // namespace mudline
