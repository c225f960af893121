#include "simulation/probes.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>

#include "ale/point_locator.hpp"
#include "core/space_vector.hpp"
#include "integrator/overlap.hpp"

namespace mudline {

namespace {

/// Reference coordinates moved into the cell.
void into_cell(CellShape shape, double (&xi)[3]) {
  if (!is_simplex(shape)) {
    for (double& c : xi) c = std::clamp(c, -1.0, 1.0);
    return;
  }
  for (double& c : xi) c = std::max(c, 0.0);
  const double sum = xi[0] + xi[1] + xi[2];
  for (double& c : xi) c /= std::max(1.0, sum);
}

std::string column(const std::string& probe, const std::string& field, int components, int component) {
  return "probe/" + probe + "/" + field + (components > 1 ? std::string(" ") + axis_names[component] : "");
}

}  // namespace

Probes::Probes(const Model& model, const std::vector<ProbeSettings>& settings) : model_(model) {
  for (const ProbeSettings& probe : settings) {
    if (probe.at_node)
      nodes_.push_back(nearest_node(probe));
    else
      moving_.push_back(probe);
  }
  if (!moving_.empty()) mesh_ = std::make_unique<GhostedMesh>(model.mesh());
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
    // the owner of the nearest node keeps the dof; the others add nothing to the sum over ranks
    const double nearest = min_over_ranks(comm, best);
    const int mine = best == nearest ? comm.getRank() : comm.getSize();
    int owner = 0;
    Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, 1, &mine, &owner);
    probe.dof.push_back(owner == comm.getRank() ? dof : -1);
    if (space.field(f).name != "pore pressure") continue;
    long long mine_is = -1, nearest_node = -1;
    for (int node = 0; owner == comm.getRank() && node < model_.mesh().num_owned_nodes(); ++node)
      if (space.node_dof(f)(node) == dof) mine_is = model_.mesh().node_ids()[node];
    Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 1, &mine_is, &nearest_node);
    probe.around = elements_at(nearest_node);
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
  return plus(now.centre, 1, now.turn(minus(probe.point, start.centre)));
}

void Probes::interpolated(const ProbeSettings& probe, const State& state, const std::vector<Values>& fields,
                          const Positions& x, const std::vector<double>* error, std::vector<HistoryValue>& row) const {
  const Point at = place(probe, state);
  const PointLocator locator(*mesh_, x);
  const double rounding = 1e-9 * model_.mesh().bounds().extent();
  MeshPlace best;
  double least = 1e300, N[27], dN[81];
  for (std::size_t block = 0; block < model_.mesh().blocks().size(); ++block) {
    if (mesh_->block_elements(static_cast<int>(block)).empty()) continue;
    MeshPlace here = locator.find(at, mesh_->block_elements(static_cast<int>(block)).front());
    const auto& element = mesh_->elements()[here.element];
    into_cell(element.shape, here.xi);
    evaluate_shape(element.shape, here.xi, N, dN);
    Point off = at;
    for (int a = 0; a < num_nodes(element.shape); ++a) off = plus(off, -N[a], x[element.nodes[a]]);
    const double distance = length(off);
    if (distance >= least) continue;
    least = distance;
    best = here;
  }
  if (least > rounding) best = locator.nearest_on_boundary(at);
  const auto& element = mesh_->elements()[best.element];
  for (int i = 0; i < model_.mesh().dimension(); ++i)
    row.push_back({"probe/" + probe.name + "/position " + axis_names[i], "m", at[i]});
  std::vector<int> element_here;
  int number = 0;
  for (const ElementBlock& block : model_.mesh().blocks())
    for (long long id : block.global_ids) {
      if (id == best.element) element_here.push_back(number);
      ++number;
    }
  for (const Values& values : fields) {
    const Field& field = model_.space().field(values.field);
    const bool pressure = model_.space().find("pore pressure") == values.field;
    const CellShape shape = field.support == Support::vertices ? linear_partner(element.shape) : element.shape;
    evaluate_shape(shape, best.xi, N, dN);
    for (int c = 0; c < field.components; ++c) {
      double sum = 0;
      for (int a = 0; a < num_nodes(shape); ++a)
        sum += N[a] * values.of_nodes[static_cast<std::size_t>(field.components) * element.nodes[a] + c];
      row.push_back({column(probe.name, values.name, field.components, c), field.unit, sum});
    }
    if (pressure && error != nullptr)
      row.push_back({column(probe.name, values.name + " error", 1, 0), field.unit, mean_error(element_here, *error)});
  }
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
    fields.push_back({field.name, f, mesh_->gather(space, f, state.value)});
    if (field.name == "pore pressure") fields.push_back({"excess pore pressure", f, mesh_->gather(space, f, excess())});
  }
  for (const ProbeSettings& probe : moving_) interpolated(probe, state, fields, x, error, row);
  return row;
}

}  // namespace mudline
