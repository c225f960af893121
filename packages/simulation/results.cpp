#include "simulation/results.hpp"

#include <algorithm>
#include <cmath>

#include "core/run_error.hpp"
#include "integrator/overlap.hpp"
#include "simulation/output/collective.hpp"
#include "tensor/vec.hpp"

namespace mudline {

namespace {

/// The same on every mesh of a run.
BodyOutline outline_of(const RigidBody& body) {
  BodyOutline outline;
  if (body.surface()) {
    outline = body.surface()->triangles(5e-4 * body.reach());
  } else {
    for (const PlanePoint& point : body.contour().sample(2e-4 * body.reach()))
      outline.points.push_back({point[0], point[1], 0});
    // a half contour is closed along its axis, so that pictures fill the body
    if (body.contour().extent() == ContourExtent::half && !outline.points.empty())
      outline.points.push_back({0, outline.points.back()[1], 0});
  }
  const BodyPlacement start = body.initial_placement();
  const Point at = body.initial_position();
  for (Point& point : outline.points) point = start.turn(point) + at;
  return outline;
}

BodyPose pose_of(const RigidBody& body, const State& state) {
  const BodyPlacement now = body.placement(state), start = body.initial_placement();
  return {now.centre - start.centre, now.turn * start.turn.inverse(), start.centre};
}

}  // namespace

Results::Results(Model& model, const OutputSettings& settings, const Origin& origin, DiscretisationError* error,
                 const std::optional<ResultsRestart>& restart)
    : model_(model),
      error_(error),
      fields_(model.mesh(), settings.stem(), restart ? std::optional(restart->fields) : std::nullopt,
              model.renewed() ? model.renewed()->number : 0),
      history_(model.mesh().comm(), settings.stem() + ".csv", restart ? std::optional(restart->history) : std::nullopt),
      initial_pressure_("initial pore pressure", model.space().dofs()->num_overlap_dofs()),
      fluid_density_(fluid_density()),
      probes_(model, settings.probes) {
  fields_.set_metadata("deck", origin.deck);
  fields_.set_metadata("deck file", origin.deck_file);
  fields_.set_metadata("program", origin.program);
  fields_.set_metadata("geometry", mudline::name(model.mesh().geometry()));
  for (const auto& [name, body] : model.bodies()) fields_.add_body(name, outline_of(*body));
}

void Results::look_at_files() const {
  const Teuchos::RCP<const Teuchos::Comm<int>> comm = model_.mesh().comm();
  std::string lost;
  if (comm->getRank() == 0) {
    lost = history_.lost();
    const std::string file = fields_.missing();
    if (lost.empty() && !file.empty()) lost = file + ": the file was removed by another program while the run went on";
  }
  lost = agreed_message(raw_communicator(*comm), lost);
  if (!lost.empty()) throw RunError(lost);
}

void Results::take_initial_pressure() { Kokkos::deep_copy(initial_pressure_, model_.store().committed().value); }

NodalView Results::fluid_density() const {
  const Soil* soil = model_.soil().get();
  const DofMap& dofs = *model_.space().dofs();
  NodalView sum("sum", dofs.num_overlap_dofs()), elements("elements", dofs.num_overlap_dofs());
  if (soil == nullptr || soil->pressure < 0) return sum;
  const auto& table = model_.space().node_dof(soil->pressure);
  for (const SoilBlock& b : soil->blocks)
    for (int e = 0; e < b.elements; ++e)
      for (int c = 0; c < num_corners(b.shape); ++c) {
        sum(table(b.nodes(e, c))) += soil->any_of(b).fluid->density();
        elements(table(b.nodes(e, c))) += 1;
      }
  const NodalView density = sum_overlap(dofs, sum), around = sum_overlap(dofs, elements);
  for (std::size_t i = 0; i < density.extent(0); ++i) density(i) /= std::max(1.0, around(i));
  return density;
}

NodalView Results::deeper_by() const {
  const State& state = model_.store().committed();
  NodalView result("deeper by", state.value.extent(0));
  const int field = model_.space().find("pore pressure");
  if (field < 0 || !model_.soil()) return result;
  const auto gravity = model_.soil()->water_gravity(state.time);
  const auto& start = model_.mesh().coordinates();
  for (int node = 0; node < model_.mesh().num_nodes(); ++node) {
    const int dof = model_.space().node_dof(field)(node);
    if (dof < 0) continue;
    // a node that has moved, with the soil or with the mesh, is compared with the water at rest where it is now
    double deeper = 0;
    for (int i = 0; i < model_.mesh().dimension(); ++i)
      deeper += gravity[i] * (state.coordinates(node, i) - start(node, i));
    result(dof) = fluid_density_(dof) * deeper;
  }
  return result;
}

NodalView Results::excess_pressure() const {
  const State& state = model_.store().committed();
  const int field = model_.space().find("pore pressure");
  NodalView excess("excess", state.value.extent(0));
  const NodalView deeper = deeper_by();
  for (int node = 0; node < model_.mesh().num_nodes(); ++node) {
    const int dof = model_.space().node_dof(field)(node);
    if (dof >= 0) excess(dof) = state.value(dof) - initial_pressure_(dof) - deeper(dof);
  }
  return excess;
}

NodalView Results::reference_pressure() const {
  const NodalView result = deeper_by();
  for (std::size_t dof = 0; dof < result.extent(0); ++dof) result(dof) += initial_pressure_(dof);
  return result;
}

void Results::take_reference_pressure(const NodalView& at_present_places) {
  const NodalView deeper = deeper_by();
  for (std::size_t dof = 0; dof < deeper.extent(0); ++dof)
    initial_pressure_(dof) = at_present_places(dof) - deeper(dof);
}

std::vector<double> Results::on_all_nodes(int field, const ConstNodalView& values) const {
  const Mesh& mesh = model_.mesh();
  const auto& table = model_.space().node_dof(field);
  const int components = model_.space().field(field).components;
  std::vector<double> result(mesh.num_owned_nodes() * components, 0.0);
  for (int node = 0; node < mesh.num_owned_nodes(); ++node)
    if (table(node) >= 0)
      for (int c = 0; c < components; ++c) result[node * components + c] = values(table(node) + c);
  if (model_.space().field(field).support == Support::all_nodes) return result;
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

std::vector<OutputField> Results::nodal_fields() const {
  const State& state = model_.store().committed();
  const Space& space = model_.space();
  std::vector<OutputField> result;
  for (int f = 0; f < space.num_fields(); ++f) {
    const Field& field = space.field(f);
    if (field.support == Support::apart) continue;
    result.push_back({field.name, field.unit, field.components, on_all_nodes(f, state.value)});
    if (field.time_order == 2) {
      result.push_back({"velocity", "m/s", field.components, on_all_nodes(f, state.rate)});
      result.push_back({"acceleration", "m/s2", field.components, on_all_nodes(f, state.acceleration)});
    }
    if (field.name == "pore pressure") {
      result.push_back({"excess pore pressure", "Pa", 1, on_all_nodes(f, excess_pressure())});
    }
  }
  for (const auto& [name, contact] : model_.contacts()) {
    std::vector<double> pressure = contact->nodal_pressure(state);
    pressure.resize(model_.mesh().num_owned_nodes());
    result.push_back({"contact pressure " + name, "Pa", 1, pressure});
    std::vector<double> shear = contact->nodal_shear(state);
    if (shear.empty()) continue;
    shear.resize(model_.mesh().num_owned_nodes());
    result.push_back({"contact shear " + name, "Pa", 1, shear});
  }
  return result;
}

std::vector<Results::PointVariables> Results::variables_of(int handle) const {
  if (model_.soil())
    for (const SoilBlock& b : model_.soil()->blocks)
      if (b.law == handle) {
        std::vector<PointVariables> laws;
        for (int k : b.made_of) laws.push_back({k, model_.soil()->materials[k]->skeleton->state_variables()});
        return laws;
      }
  return {{-1, model_.store().info(handle).variables}};
}

void Results::add_means(int handle, const std::string& name, double* to) const {
  const StateStore& store = model_.store();
  const ArrayInfo& info = store.info(handle);
  const PointView& rows = store.committed().arrays[handle];
  const int points = info.points_per_element, elements = static_cast<int>(rows.extent(0)) / points;
  for (const PointVariables& of : variables_of(handle)) {
    int column = 0;
    for (const StateVariable& v : of.variables) {
      const int first = column;
      column += v.components;
      if (v.name != name) continue;
      const PointView which =
          of.material >= 0 ? model_.soil()->which(model_.soil()->blocks[info.block], store.committed()) : PointView();
      for (int row = 0; row < elements * points; ++row) {
        if (of.material >= 0 && which(row, 0) != of.material) continue;
        for (int c = 0; c < v.components; ++c) to[row / points * v.components + c] += rows(row, first + c) / points;
      }
    }
  }
}

std::vector<OutputField> Results::point_means(const std::set<int>& without) const {
  const StateStore& store = model_.store();
  std::map<std::string, OutputField> fields;
  for (int handle = 0; handle < store.num_arrays(); ++handle)
    if (store.info(handle).block >= 0 && without.count(handle) == 0)
      for (const PointVariables& of : variables_of(handle))
        for (const StateVariable& v : of.variables)
          fields.emplace(v.name, OutputField{v.name, v.unit, v.components, {}});
  const auto& blocks = model_.mesh().blocks();
  for (std::size_t block = 0; block < blocks.size(); ++block)
    for (auto& [name, field] : fields) {
      const std::size_t first = field.values.size();
      field.values.resize(first + static_cast<std::size_t>(blocks[block].num_elements) * field.components, 0.0);
      for (int handle = 0; handle < store.num_arrays(); ++handle)
        if (store.info(handle).block == static_cast<int>(block) && without.count(handle) == 0)
          add_means(handle, name, field.values.data() + first);
    }
  std::vector<OutputField> result;
  for (auto& [name, field] : fields) result.push_back(std::move(field));
  return result;
}

std::vector<OutputField> Results::layer_fields() const {
  const Soil& soil = *model_.soil();
  const int dimension = model_.mesh().dimension();
  if (!soil.layered()) return {};
  OutputField material{"material", "-", 1, {}}, start{"place at the start", "m", dimension, {}};
  for (const SoilBlock& b : soil.blocks) {
    const PointView rows = model_.store().committed().arrays[b.origin];
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

std::vector<OutputField> Results::cell_fields() const {
  if (!model_.soil()) return point_means({});
  const State& state = model_.store().committed();
  OutputField stress{"effective stress", "Pa", 6, {}}, mean{"mean effective stress", "Pa", 1, {}},
      deviator{"deviatoric stress", "Pa", 1, {}}, ratio{"void ratio", "-", 1, {}};
  std::set<int> done;
  for (const SoilBlock& b : model_.soil()->blocks) {
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
  for (OutputField& field : layer_fields()) result.push_back(std::move(field));
  for (OutputField& field : point_means(done)) result.push_back(std::move(field));
  if (error_ != nullptr)
    for (OutputField& field : error_->fields()) result.push_back(std::move(field));
  return result;
}

void Results::estimate_error() {
  if (error_ != nullptr) error_->evaluate(model_.soil()->pressure >= 0 ? excess_pressure() : NodalView());
}

void Results::write_fields(int step, const std::string& stage) {
  const State& state = model_.store().committed();
  std::vector<double> coordinates;
  for (int node = 0; node < model_.mesh().num_owned_nodes(); ++node)
    for (int i = 0; i < model_.mesh().dimension(); ++i) coordinates.push_back(state.coordinates(node, i));
  std::map<std::string, BodyPose> bodies;
  for (const auto& [name, body] : model_.bodies()) bodies[name] = pose_of(*body, state);
  estimate_error();
  fields_.write(state.time, step, stage, coordinates, nodal_fields(), cell_fields(), bodies);
}

void Results::write_history(const Balances& balances, const Report& terms, double dt, int iterations) {
  const State& state = model_.store().committed();
  std::vector<HistoryValue> row{{"step/dt", "s", dt}, {"step/newton iterations", "-", static_cast<double>(iterations)}};
  for (const auto& [name, body] : model_.bodies()) {
    const auto add = [&, name = name, axes = body->dimension()](const char* what, const char* unit, const Point& x) {
      for (int i = 0; i < axes; ++i) row.push_back({"body/" + name + what + axis_names[i], unit, x[i]});
    };
    add("/position ", "m", body->position(state));
    add("/displacement ", "m", body->displacement(state));
    add("/velocity ", "m/s", body->velocity(state));
    if (body->dimension() == 2) continue;
    add("/rotation ", "rad", body->rotation(state));
    add("/spin ", "rad/s", body->spin(state));
  }
  for (const auto& [name, quantity] : terms) row.push_back({name, quantity.unit, quantity.value});
  const auto excess = [&] { return excess_pressure(); };
  estimate_error();
  if (error_ != nullptr)
    for (const HistoryValue& value : error_->values(terms)) row.push_back(value);
  for (const HistoryValue& value : probes_.values(state, excess, error_ != nullptr ? &error_->pressure() : nullptr))
    row.push_back(value);
  for (const HistoryValue& value : balances.values()) row.push_back(value);
  history_.write(state.time, row);
}

}  // namespace mudline
