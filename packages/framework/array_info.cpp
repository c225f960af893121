#include <numeric>
#include <utility>

#include "framework/state.hpp"
#include "framework/surface_points.hpp"

namespace mudline {

ArrayInfo ArrayInfo::of_model(std::string name, std::vector<StateVariable> variables, int rows) {
  ArrayInfo info{std::move(name), std::move(variables)};
  info.rows = rows;
  return info;
}

ArrayInfo ArrayInfo::of_model(std::string name, std::vector<StateVariable> variables, std::vector<long long> ids) {
  ArrayInfo info = of_model(std::move(name), std::move(variables), static_cast<int>(ids.size()));
  info.ids = std::move(ids);
  return info;
}

ArrayInfo ArrayInfo::of_sum(std::string name, std::vector<StateVariable> variables) {
  ArrayInfo info{std::move(name), std::move(variables)};
  info.on = On::sum;
  return info;
}

ArrayInfo ArrayInfo::at_points(std::string name, std::vector<StateVariable> variables, const Mesh& mesh, int block,
                               int points_per_element) {
  ArrayInfo info{std::move(name), std::move(variables)};
  info.on = On::points;
  info.rows = mesh.blocks().at(block).num_elements * points_per_element;
  info.block = block;
  info.points_per_element = points_per_element;
  return info;
}

ArrayInfo ArrayInfo::on_surface(std::string name, std::vector<StateVariable> variables,
                                std::shared_ptr<const SurfacePoints> points) {
  ArrayInfo info{std::move(name), std::move(variables)};
  info.on = On::surface;
  info.rows = points->count();
  info.ids = points->ids();
  info.surface = std::move(points);
  return info;
}

ArrayInfo ArrayInfo::at_nodes(std::string name, std::vector<StateVariable> variables, const Mesh& mesh,
                              const std::string& set) {
  ArrayInfo info{std::move(name), std::move(variables)};
  info.on = On::nodes;
  std::vector<int> all(mesh.num_owned_nodes());
  std::iota(all.begin(), all.end(), 0);
  for (int node : set.empty() ? all : mesh.nodes_of_set(set))
    if (node < mesh.num_owned_nodes()) info.nodes.push_back(node);
  for (int node : info.nodes) info.ids.push_back(mesh.node_ids()[node]);
  info.rows = static_cast<int>(info.nodes.size());
  return info;
}

ArrayInfo&& ArrayInfo::then_evaluated() && {
  evaluated = true;
  return std::move(*this);
}

ArrayInfo&& ArrayInfo::not_shown() && {
  hidden = true;
  return std::move(*this);
}

ArrayInfo&& ArrayInfo::rest_in(long long row) && {
  rest = row;
  return std::move(*this);
}

int ArrayInfo::columns() const {
  return std::accumulate(variables.begin(), variables.end(), 0,
                         [](int sum, const StateVariable& variable) { return sum + variable.components; });
}

std::string ArrayInfo::problem() const {
  const bool has_places = on == On::points || on == On::surface || on == On::nodes;
  if (name.empty()) return "it has no name";
  if (rows < 0 || (on == On::sum && rows != 1)) return "it has " + std::to_string(rows) + " rows";
  if (on == On::points && (block < 0 || points_per_element < 1)) return "its points are those of no element block";
  if (on == On::surface && !surface) return "its rows are on no surface";
  if (!ids.empty() && static_cast<int>(ids.size()) != rows) return "it has another number of ids than of rows";
  if (evaluated && !has_places) return "only an array whose rows have places is evaluated after a transfer";
  for (const StateVariable& v : variables) {
    const std::string of = "'" + v.name + "' ";
    if (v.components < 1) return of + "has no components";
    if (!(v.low <= v.high)) return of + "has a lower bound above its upper one";
    if (v.transfer == Transfer::mass && (on != On::points || v.components != 1))
      return of + "is to be transferred by mass, which is for void ratios at points";
    if (v.transfer == Transfer::nearest && !has_places)
      return of + "is to be that of the nearest row, but the rows have no places";
    if (v.transfer == Transfer::total && on == On::model)
      return of + "is a part of a sum, but all ranks have the same rows: declare it as a sum";
  }
  return "";
}

}  // namespace mudline
