#include "simulation/probes.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/over_ranks.hpp"
#include "integrator/overlap.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// Moves reference coordinates to the nearest ones within the cell.
void into_cell(CellShape shape, double (&xi)[3]) {
  const int simplex = simplex_coordinates(shape);
  double sum = 0;
  for (int d = 0; d < 3; ++d) {
    xi[d] = d < simplex ? std::max(xi[d], 0.0) : std::clamp(xi[d], -1.0, 1.0);
    if (d < simplex) sum += xi[d];
  }
  for (int d = 0; d < simplex; ++d) xi[d] /= std::max(1.0, sum);
}

std::string column(const std::string& probe, const std::string& field, int components, int component) {
  return "probe/" + probe + "/" + field + (components > 1 ? std::string(" ") + axis_names[component] : "");
}

}  // namespace

Probes::Probes(const Model& model, const std::vector<ProbeSettings>& settings)
    : model_(model), extent_(model.mesh().bounds().extent()) {
  for (const ProbeSettings& probe : settings) {
    if (probe.at_node)
      nodes_.push_back(nearest_node(probe));
    else
      moving_.push_back(probe);
  }
  // one layer of ghosts shows where the soil ends
  if (!moving_.empty()) mesh_ = std::make_unique<GhostedMesh>(model.mesh(), 1);
}

Probes::NodeProbe Probes::nearest_node(const ProbeSettings& settings) const {
  const Space& space = model_.space();
  const auto& comm = *model_.mesh().comm();
  NodeProbe probe{settings.name, {}, {}};
  for (int f = 0; f < space.num_fields(); ++f) {
    double best = 1e300;
    int dof = -1;
    for (int node = 0; node < model_.mesh().num_owned_nodes(); ++node) {
      if (space.node_dof(f)(node) < 0) continue;
      const Point x = model_.mesh().place(node);
      const double distance = std::hypot(x[0] - settings.point[0], x[1] - settings.point[1], x[2] - settings.point[2]);
      if (distance < best) {
        best = distance;
        dof = space.node_dof(f)(node);
      }
    }
    // only the owner of the nearest node keeps the dof, so that the others add nothing to the sum over ranks
    const double nearest = min_over_ranks(comm, best);
    const int owner = first_rank(comm, best == nearest);
    probe.dof.push_back(owner == comm.getRank() ? dof : -1);
    if (space.field(f).name != "pore pressure") continue;
    long long mine_is = -1;
    if (owner == comm.getRank())
      for (int node = 0; node < model_.mesh().num_owned_nodes(); ++node)
        if (space.node_dof(f)(node) == dof) mine_is = model_.mesh().node_ids()[node];
    probe.around = elements_at(max_over_ranks(comm, mine_is));
  }
  return probe;
}

std::vector<int> Probes::elements_at(long long node) const {
  std::vector<int> found;
  int element = 0;
  for (const ElementBlock& block : model_.mesh().blocks())
    for (int e = 0; e < block.num_elements; ++e, ++element)
      for (int a = 0; a < num_corners(block.shape); ++a)
        if (model_.mesh().node_ids()[block.nodes(e, a)] == node) found.push_back(element);
  return found;
}

double Probes::mean_error(const std::vector<int>& elements, const std::vector<double>& error) const {
  std::vector<double> sums{0, static_cast<double>(elements.size())};
  for (int e : elements) sums[0] += error[e];
  sums = sum_over_ranks(*model_.mesh().comm(), sums);
  return sums[0] / std::max(1.0, sums[1]);
}

Point Probes::place(const ProbeSettings& probe, const State& state) const {
  if (probe.moves_with.empty()) return probe.point;
  const RigidBody& body = *model_.bodies().at(probe.moves_with);
  const BodyPlacement start = body.initial_placement(), now = body.placement(state);
  return now.centre + now.turn(start.turn.back(probe.point - start.centre));
}

double Probes::distance(const MeshPlace& place, const Point& at, const Positions& x) const {
  if (place.element < 0) return 1e300;
  const auto& element = mesh_->elements()[place.element];
  double N[27], dN[81];
  evaluate_shape(element.shape, place.xi, N, dN);
  Point off = at;
  for (int a = 0; a < num_nodes(element.shape); ++a) off -= N[a] * x[element.nodes[a]];
  return length(off);
}

MeshPlace Probes::place_in_soil(const Point& at, const PointLocator& locator, const Positions& x) const {
  MeshPlace best;
  double least = 1e300;
  for (int e = 0; e < static_cast<int>(mesh_->elements().size()); ++e) {
    const auto& element = mesh_->elements()[e];
    bool near = true;  // a curved element lies within the box of its nodes, enlarged by half its size on each side
    for (int i = 0; i < mesh_->dimension(); ++i) {
      double low = 1e300, high = -1e300;
      for (int a = 0; a < num_nodes(element.shape); ++a) {
        low = std::min(low, x[element.nodes[a]][i]);
        high = std::max(high, x[element.nodes[a]][i]);
      }
      near = std::abs(at[i] - 0.5 * (low + high)) <= high - low;
      if (!near) break;
    }
    MeshPlace here{e};
    if (!near || !locator.invert(e, at, here.xi)) continue;
    into_cell(element.shape, here.xi);
    const double away = distance(here, at, x);
    if (away >= least) continue;
    least = away;
    best = here;
  }
  return best;
}

MeshPlace Probes::find(const Point& at, const Positions& x) const {
  const PointLocator locator(*mesh_, x);
  MeshPlace place = place_in_soil(at, locator, x);
  double mine = distance(place, at, x), least = mesh_->smallest(mine);
  if (least > 1e-9 * extent_) {
    place = locator.nearest_on_boundary(at);
    mine = distance(place, at, x);
    least = mesh_->smallest(mine);
  }
  const Comm& comm = *model_.mesh().comm();
  return first_rank(comm, mine == least) == comm.getRank() ? place : MeshPlace{};
}

void Probes::interpolated(const ProbeSettings& probe, const State& state, const std::vector<Values>& fields,
                          const Positions& x, std::vector<HistoryValue>& row) const {
  const Point at = place(probe, state);
  const MeshPlace found = find(at, x);
  for (int i = 0; i < model_.mesh().dimension(); ++i)
    row.push_back({"probe/" + probe.name + "/position " + axis_names[i], "m", at[i]});
  for (const Values& values : fields)
    for (int c = 0; c < values.components; ++c) {
      double sum = 0, N[27], dN[81];
      if (found.element >= 0 && values.by_element) {
        sum = values.numbers[found.element];
      } else if (found.element >= 0) {
        const auto& element = mesh_->elements()[found.element];
        const CellShape shape = values.at_vertices ? linear_partner(element.shape) : element.shape;
        evaluate_shape(shape, found.xi, N, dN);
        for (int a = 0; a < num_nodes(shape); ++a)
          sum += N[a] * values.numbers[static_cast<std::size_t>(values.components) * element.nodes[a] + c];
      }
      row.push_back({column(probe.name, values.name, values.components, c), values.unit,
                     sum_over_ranks(*model_.mesh().comm(), sum)});
    }
}

std::vector<double> Probes::by_element(const std::vector<double>& own) const {
  std::vector<double> all(mesh_->elements().size());
  auto next = own.begin();
  for (int block = 0; block < static_cast<int>(model_.mesh().blocks().size()); ++block) {
    std::vector<double> table(mesh_->block_elements(block).size(), 0.0);
    for (int e : mesh_->own_elements(block)) table[mesh_->first_row(e, 1)] = *next++;
    mesh_->fill_points(block, 1, 1, table);
    for (int e : mesh_->block_elements(block)) all[e] = table[mesh_->first_row(e, 1)];
  }
  return all;
}

std::vector<HistoryValue> Probes::values(const State& state, const std::function<NodalView()>& excess,
                                         const std::vector<double>* error) const {
  const Space& space = model_.space();
  std::vector<HistoryValue> row;
  for (const NodeProbe& probe : nodes_)
    for (int f = 0; f < space.num_fields(); ++f) {
      const Field& field = space.field(f);
      if (field.support == Support::apart) continue;
      for (int c = 0; c < field.components; ++c) {
        const double mine = probe.dof[f] >= 0 ? state.value(probe.dof[f] + c) : 0.0;
        row.push_back({column(probe.name, field.name, field.components, c), field.unit,
                       sum_over_ranks(*space.dofs()->comm(), mine)});
      }
      if (field.name == "pore pressure" && error != nullptr)
        row.push_back({column(probe.name, "pore pressure error", 1, 0), field.unit, mean_error(probe.around, *error)});
    }
  if (moving_.empty()) return row;
  const Positions x = mesh_->gather(state.coordinates);
  std::vector<Values> fields;
  for (int f = 0; f < space.num_fields(); ++f) {
    const Field& field = space.field(f);
    if (field.support == Support::apart) continue;
    const bool at_vertices = field.support == Support::vertices;
    fields.push_back(
        {field.name, field.unit, field.components, at_vertices, false, mesh_->gather(space, f, state.value)});
    if (field.name != "pore pressure") continue;
    if (error != nullptr) fields.push_back({field.name + " error", field.unit, 1, false, true, by_element(*error)});
    fields.push_back({"excess pore pressure", field.unit, 1, at_vertices, false, mesh_->gather(space, f, excess())});
    if (error != nullptr)
      fields.push_back({"excess pore pressure error", field.unit, 1, false, true, fields[fields.size() - 2].numbers});
  }
  for (const ProbeSettings& probe : moving_) interpolated(probe, state, fields, x, row);
  return row;
}

}  // namespace mudline
