#include "simulation/state_fields.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "framework/nodal_exchange.hpp"
#include "framework/surface_points.hpp"
#include "integrator/overlap.hpp"
#include "physics/mixture.hpp"
#include "physics/soil_points.hpp"

namespace mudline {

namespace {

/// Values of a field at all owned nodes; those of a linear field at mid-side nodes are interpolated.
std::vector<double> on_all_nodes(const Model& model, int field, const ConstNodalView& values) {
  const Mesh& mesh = model.mesh();
  const auto& table = model.space().node_dof(field);
  const int components = model.space().field(field).components;
  std::vector<double> result(mesh.num_owned_nodes() * components, 0.0);
  for (int node = 0; node < mesh.num_owned_nodes(); ++node)
    if (table(node) >= 0)
      for (int c = 0; c < components; ++c) result[node * components + c] = values(table(node) + c);
  if (model.space().field(field).support == Support::all_nodes) return result;
  for (const ElementBlock& block : mesh.blocks()) {
    const int corners = num_corners(block.shape);
    std::vector<std::vector<int>> around;
    for (int a = 0; a < num_nodes(block.shape); ++a) around.push_back(corners_around(block.shape, a));
    for (int e = 0; e < block.num_elements; ++e)
      for (int a = corners; a < num_nodes(block.shape); ++a) {
        const int node = block.nodes(e, a);
        if (node >= mesh.num_owned_nodes()) continue;
        for (int c = 0; c < components; ++c) {
          double mean = 0;
          for (int k : around[a]) mean += values(table(block.nodes(e, k)) + c) / around[a].size();
          result[node * components + c] = mean;
        }
      }
  }
  return result;
}

bool shown(const ArrayInfo& info, ArrayInfo::On on) { return info.on == on && !info.hidden; }

struct PointVariables {
  int material;  // whose points have these variables; -1: all points
  std::vector<StateVariable> variables;
};

std::vector<PointVariables> variables_of(const Model& model, int handle) {
  if (model.soil())
    for (const SoilBlock& b : model.soil()->blocks)
      if (b.law == handle) {
        std::vector<PointVariables> laws;
        for (int k : b.made_of) laws.push_back({k, model.soil()->materials[k]->skeleton->state_variables()});
        return laws;
      }
  return {{-1, model.store().info(handle).variables}};
}

/// Adds the means of the variables of this name in one point array to `to`, by element.
void add_means(const Model& model, int handle, const std::string& name, double* to) {
  const StateStore& store = model.store();
  const ArrayInfo& info = store.info(handle);
  const PointView& rows = store.committed().arrays[handle];
  const int points = info.points_per_element, elements = static_cast<int>(rows.extent(0)) / points;
  for (const PointVariables& of : variables_of(model, handle)) {
    int column = 0;
    for (const StateVariable& v : of.variables) {
      const int first = column;
      column += v.components;
      if (v.name != name) continue;
      const PointView which =
          of.material >= 0 ? model.soil()->which(model.soil()->blocks[info.block], store.committed()) : PointView();
      for (int row = 0; row < elements * points; ++row) {
        if (of.material >= 0 && which(row, 0) != of.material) continue;
        for (int c = 0; c < v.components; ++c) to[row / points * v.components + c] += rows(row, first + c) / points;
      }
    }
  }
}

/// Means over each element's points of all point data except the arrays `without`, by name; points without a variable
/// count as 0.
std::vector<OutputField> point_means(const Model& model, const std::set<int>& without) {
  const StateStore& store = model.store();
  std::map<std::string, OutputField> fields;
  for (int handle = 0; handle < store.num_arrays(); ++handle)
    if (shown(store.info(handle), ArrayInfo::On::points) && without.count(handle) == 0)
      for (const PointVariables& of : variables_of(model, handle))
        for (const StateVariable& v : of.variables)
          if (!v.hidden) fields.emplace(v.name, OutputField{v.name, v.unit, v.components, {}});
  const auto& blocks = model.mesh().blocks();
  for (std::size_t block = 0; block < blocks.size(); ++block)
    for (auto& [name, field] : fields) {
      const std::size_t first = field.values.size();
      field.values.resize(first + static_cast<std::size_t>(blocks[block].num_elements) * field.components, 0.0);
      for (int handle = 0; handle < store.num_arrays(); ++handle)
        if (shown(store.info(handle), ArrayInfo::On::points) && store.info(handle).block == static_cast<int>(block) &&
            without.count(handle) == 0)
          add_means(model, handle, name, field.values.data() + first);
    }
  std::vector<OutputField> result;
  for (auto& [name, field] : fields) result.push_back(std::move(field));
  return result;
}

/// The material of most of a cell's points, and the place of its soil at the start; empty where no region has layers.
std::vector<OutputField> layer_fields(const Model& model) {
  const Soil& soil = *model.soil();
  const int dimension = model.mesh().dimension();
  if (!soil.layered()) return {};
  OutputField material{"material", "-", 1, {}}, start{"place at the start", "m", dimension, {}};
  for (const SoilBlock& b : soil.blocks) {
    const PointView rows = model.store().committed().arrays[b.origin];
    for (int e = 0; e < b.elements; ++e) {
      std::vector<int> points(soil.materials.size(), 0);
      std::vector<double> mean(dimension, 0.0);
      for (int q = 0; q < b.points; ++q) {
        ++points[static_cast<int>(rows(e * b.points + q, 0))];
        for (int i = 0; i < dimension; ++i) mean[i] += rows(e * b.points + q, 1 + i) / b.points;
      }
      material.values.push_back(static_cast<double>(std::max_element(points.begin(), points.end()) - points.begin()));
      start.values.insert(start.values.end(), mean.begin(), mean.end());
    }
  }
  return {material, start};
}

/// The arrays at nodes and on surfaces by node, "<array>/<variable>"; 0 where there is no row. Means over the sides
/// around a node of their rows that are nearest to it.
std::vector<OutputField> array_fields(const Model& model) {
  const StateStore& store = model.store();
  std::optional<NodalExchange> exchange;  // of arrays on surfaces
  std::vector<OutputField> result;
  for (int handle = 0; handle < store.num_arrays(); ++handle) {
    const ArrayInfo& info = store.info(handle);
    const bool at_nodes = shown(info, ArrayInfo::On::nodes);
    if (!at_nodes && !shown(info, ArrayInfo::On::surface)) continue;
    if (!at_nodes && !exchange) exchange.emplace(model.mesh());
    const PointView& rows = store.committed().arrays[handle];
    int column = 0;
    for (const StateVariable& variable : info.variables) {
      const int owned = model.mesh().num_owned_nodes(), components = variable.components;
      OutputField field{info.name + "/" + variable.name, variable.unit, components,
                        std::vector<double>(static_cast<std::size_t>(owned) * components, 0.0)};
      for (int c = 0; c < components; ++c, ++column) {
        std::vector<double> sums(model.mesh().num_nodes(), 0.0), counts(sums);
        for (std::size_t row = 0; row < info.nodes.size(); ++row) sums[info.nodes[row]] = rows(row, column);
        if (!at_nodes) {
          info.surface->add_at_nodes(rows, column, sums, counts);
          exchange->sum_shared(sums);
          exchange->sum_shared(counts);
        }
        for (int node = 0; node < owned; ++node)
          field.values[node * components + c] = sums[node] / std::max(1.0, counts[node]);
      }
      result.push_back(std::move(field));
    }
  }
  return result;
}

}  // namespace

std::vector<OutputField> nodal_fields(const Model& model, const ExcessPressure& pressure) {
  const State& state = model.store().committed();
  const Space& space = model.space();
  std::vector<OutputField> result;
  for (int f = 0; f < space.num_fields(); ++f) {
    const Field& field = space.field(f);
    if (field.support == Support::apart) continue;
    result.push_back({field.name, field.unit, field.components, on_all_nodes(model, f, state.value)});
    if (field.time_order == 2) {
      result.push_back({"velocity", "m/s", field.components, on_all_nodes(model, f, state.rate)});
      result.push_back({"acceleration", "m/s2", field.components, on_all_nodes(model, f, state.acceleration)});
    }
    if (field.name == "pore pressure") {
      result.push_back({"excess pore pressure", "Pa", 1, on_all_nodes(model, f, pressure.values())});
    }
  }
  for (const auto& [name, contact] : model.contacts()) {
    std::vector<double> pressure = contact->nodal_pressure(state);
    pressure.resize(model.mesh().num_owned_nodes());
    result.push_back({"contact pressure " + name, "Pa", 1, pressure});
    std::vector<double> shear = contact->nodal_shear(state);
    if (shear.empty()) continue;
    shear.resize(model.mesh().num_owned_nodes());
    result.push_back({"contact shear " + name, "Pa", 1, shear});
  }
  for (OutputField& field : array_fields(model)) result.push_back(std::move(field));
  return result;
}

std::vector<HistoryValue> state_sums(const Model& model) {
  const StateStore& store = model.store();
  std::vector<HistoryValue> result;
  for (int handle = 0; handle < store.num_arrays(); ++handle) {
    const ArrayInfo& info = store.info(handle);
    const bool is_sum = shown(info, ArrayInfo::On::sum);
    if (!is_sum && !(shown(info, ArrayInfo::On::model) && info.rows == 1)) continue;
    int column = 0;
    for (const StateVariable& variable : info.variables)
      for (int c = 0; c < variable.components; ++c, ++column) {
        const double here = store.committed().arrays[handle](0, column);
        result.push_back({info.name + "/" + variable.name + (variable.components > 1 ? " " + std::to_string(c) : ""),
                          variable.unit, is_sum ? sum_over_ranks(*model.mesh().comm(), here) : here});
      }
  }
  return result;
}

namespace {

/// Share of the pores that water fills, mean of each element.
OutputField saturation(const Soil& soil, const State& state) {
  OutputField result{"saturation", "-", 1, {}};
  for (const SoilBlock& b : soil.blocks) {
    const SoilPoints points(soil, b, state);
    const int pressure = place_of_scalar(b, soil.pressure);
    for (int e = 0; e < b.elements; ++e) {
      double sum = 0;
      for (int q = 0; q < b.points; ++q)
        sum += points.material(e * b.points + q).retention.saturation(b.scalar_at(e, q, pressure, state.value));
      result.values.push_back(sum / b.points);
    }
  }
  return result;
}

}  // namespace

std::vector<OutputField> cell_fields(const Model& model) {
  if (!model.soil()) return point_means(model, {});
  const State& state = model.store().committed();
  OutputField stress{"effective stress", "Pa", 6, {}}, mean{"mean effective stress", "Pa", 1, {}},
      deviator{"deviatoric stress", "Pa", 1, {}}, ratio{"void ratio", "-", 1, {}};
  std::set<int> done;
  for (const SoilBlock& b : model.soil()->blocks) {
    done.insert({b.stress, b.void_ratio, b.origin});
    for (int e = 0; e < b.elements; ++e) {
      double s[6] = {0, 0, 0, 0, 0, 0}, void_ratio = 0;
      for (int q = 0; q < b.points; ++q) {
        const int row = e * b.points + q;
        for (int c = 0; c < 6; ++c) s[c] += state.arrays[b.stress](row, c) / b.points;
        void_ratio += state.arrays[b.void_ratio](row, 0) / b.points;
      }
      stress.values.insert(stress.values.end(), s, s + 6);
      const double p = -(s[0] + s[1] + s[2]) / 3;
      const double j2 = (std::pow(s[0] - s[1], 2) + std::pow(s[1] - s[2], 2) + std::pow(s[2] - s[0], 2)) / 6 +
                        s[3] * s[3] + s[4] * s[4] + s[5] * s[5];
      mean.values.push_back(p);
      deviator.values.push_back(std::sqrt(3 * j2));
      ratio.values.push_back(void_ratio);
    }
  }
  std::vector<OutputField> result{stress, mean, deviator, ratio};
  if (model.soil()->dries()) result.push_back(saturation(*model.soil(), state));
  for (OutputField& field : layer_fields(model)) result.push_back(std::move(field));
  for (OutputField& field : point_means(model, done)) result.push_back(std::move(field));
  return result;
}

}  // namespace mudline
