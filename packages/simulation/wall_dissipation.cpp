#include "simulation/wall_dissipation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/log.hpp"
#include "discretisation/side_map.hpp"
#include "integrator/overlap.hpp"
#include "physics/soil_points.hpp"
#include "simulation/excess_pressure.hpp"
#include "simulation/output/collective.hpp"
#include "simulation/pressed_sides.hpp"
#include "simulation/results/dissipation.hpp"
#include "tensor/mat.hpp"

namespace mudline {

namespace {

/// Largest thickness of an element at the wall over the smaller of the body's half width and the diffusion length of
/// the pore pressure. At this thickness linear pressures miss the curvature of the profile by some per cent.
constexpr double finest = 0.5;

/// State array of what the walls were like when the stage began: a row per contact, 0 where it has no body.
constexpr const char* at_the_start = "wall at the start";
enum Column { area, pressure, place };

/// Whether there are walls with water behind them.
bool watches(const Model& model) { return !model.contacts().empty() && model.soil() && model.soil()->pressure >= 0; }

PointView rows_of(const RunView& run) {
  const StateStore& store = run.model.store();
  return run.state.arrays[store.find(at_the_start)];
}

/// Whether the body of a contact is still where it was when the stage began. One that is held by forces may give way a
/// little.
bool rests(const Model& model, const Contact& contact, const PointView& start, std::size_t k) {
  const Point position = {start(k, place), start(k, place + 1), start(k, place + 2)};
  const RigidBody& body = *contact.partners().body;
  const double allowed = body.released() ? 0.01 : 1e-6;  // of the half width
  return length(body.position(model.store().committed()) - position) < allowed * pressed_half_width(model, contact);
}

/// Area of the side and volume of its element [m2, m3], both without the length out of the plane.
template <int Dim>
std::array<double, 2> extents(const ElementBlock& block, const SoilBlock& b, const Side& side,
                              const ConstCoordinateView& x) {
  const std::vector<int>& nodes = side_nodes(block.shape, side.side);
  const CellShape shape = side_shape(block.shape, side.side);
  const QuadratureRule rule = cell_quadrature(shape, is_simplex(shape) ? 2 : 3);
  std::array<double, 2> result{};
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    double N[9], dN[18];
    evaluate_shape(shape, rule.points[q].data(), N, dN);
    SideMap<Dim> map;
    map.compute(static_cast<int>(nodes.size()), N, dN,
                [&](int a, int i) { return x(block.nodes(side.element, nodes[a]), i); });
    result[0] += rule.weights[q] * map.stretch;
  }
  for (int q = 0; q < b.points; ++q) {
    Mat<double, Dim> slope = {};
    for (int a = 0; a < b.u.nodes; ++a)
      for (int i = 0; i < Dim; ++i)
        for (int k = 0; k < Dim; ++k) slope[i][k] += x(block.nodes(side.element, a), i) * b.u.dN(q, a, k);
    result[1] += b.u.weights(q) * determinant(slope);
  }
  return result;
}

}  // namespace

void WallDissipation::add_side(const Model& model, const Side& side, const NodalView& excess, Wall& to) {
  const ElementBlock& block = model.mesh().blocks()[side.block];
  const State& state = model.store().committed();
  const auto own = std::find_if(model.soil()->blocks.begin(), model.soil()->blocks.end(),
                                [&](const SoilBlock& b) { return b.block == side.block; });
  if (own == model.soil()->blocks.end() || !own->porous()) return;
  const auto [area, volume] = model.mesh().dimension() == 2 ? extents<2>(block, *own, side, state.coordinates)
                                                            : extents<3>(block, *own, side, state.coordinates);
  double pressure = 0;
  const int corners = num_corners(side_shape(block.shape, side.side));
  for (int a = 0; a < corners; ++a) {
    const int node = block.nodes(side.element, side_nodes(block.shape, side.side)[a]);
    pressure += excess(model.space().node_dof(model.soil()->pressure)(node)) / corners;
  }
  const int row = side.element * own->points;
  const SoilPoints soil(*model.soil(), *own, state);
  const ElasticModuli moduli = soil.moduli(row);
  double ratio = 0;  // of the permeability, mean of the directions
  const int dimension = model.mesh().dimension();
  for (int i = 0; i < dimension; ++i) {
    Point along{};
    along[i] = 1;
    ratio += soil.along_ratios(row, along.data(), along.data(), dimension) / dimension;
  }
  // the height is the volume over the area for a box, of which a simplex or a wedge is a part
  const double share = per_box(block.shape) / per_box(side_shape(block.shape, side.side));
  to.pressure += area * pressure;
  to.thickness += share * volume;
  to.diffusivity += area * ratio * soil.mobility(row) * (moduli.bulk + 4 * moduli.shear / 3);
  to.area += area;
}

WallDissipation::Wall WallDissipation::look(const Model& model, const Contact& contact, const NodalView& excess) {
  Wall wall;
  for (const Side& side : pressed_sides(model, contact)) add_side(model, side, excess, wall);
  const std::vector<double> sum = sum_over_ranks(
      *model.mesh().comm(), std::vector<double>{wall.pressure, wall.thickness, wall.diffusivity, wall.area});
  if (!(sum[3] > 0)) return {};
  return {sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3], sum[3]};
}

void WallDissipation::declare_state(Model& model) {
  if (!watches(model)) return;
  std::vector<long long> ids;
  for (const auto& [name, contact] : model.contacts()) ids.push_back(id_of(name));
  const std::vector<StateVariable> wall{
      {"area", 1, "m2"}, {"pressure", 1, "Pa"}, {"body x", 1, "m"}, {"body y", 1, "m"}, {"body z", 1, "m"}};
  model.store().declare(ArrayInfo::of_model(at_the_start, wall, std::move(ids)).not_shown());
}

void WallDissipation::begin_stage(const RunView& run) {
  const Model& model = run.model;
  if (run.resumed || !watches(model)) return;
  const NodalView excess = run.pressure.values();
  const PointView start = rows_of(run);
  Kokkos::deep_copy(start, 0.0);
  for (std::size_t k = 0; k < model.contacts().size(); ++k) {
    const Contact& contact = *model.contacts()[k].second;
    const RigidBody* body = contact.partners().body;
    if (body == nullptr) continue;
    const Wall wall = look(model, contact, excess);
    const Point position = body->position(run.state);
    start(k, area) = wall.area;
    start(k, pressure) = wall.pressure;
    for (int i = 0; i < 3; ++i) start(k, place + i) = position[i];
  }
}

void WallDissipation::results(const RunView& run, ResultTable& to) {
  const Model& model = run.model;
  if (!watches(model)) return;
  const PointView start = rows_of(run);
  NodalView excess;  // of a step in which a body rests
  for (const auto& [name, body] : model.bodies()) {
    Dissipation of_wall(run.stage.name, name, wall_pressure, to);
    double area_before = 0, before = 0, area_now = 0, now = 0;  // [m2], [N] over the body's contacts
    bool at_rest = true;
    for (std::size_t k = 0; k < model.contacts().size() && at_rest; ++k) {
      const Contact& contact = *model.contacts()[k].second;
      if (contact.partners().body != body.get() || !(start(k, area) > 0)) continue;
      at_rest = rests(model, contact, start, k);
      if (!at_rest) continue;
      if (excess.extent(0) == 0) excess = run.pressure.values();
      const Wall wall = look(model, contact, excess);
      area_before += start(k, area);
      before += start(k, area) * start(k, pressure);
      area_now += wall.area;
      now += wall.area * wall.pressure;
    }
    if (!at_rest || (area_before > 0 && !(area_now > 0)))  // it moves, or has left the soil
      of_wall.forget();
    else if (area_before > 0)
      of_wall.follow(run.state.time - run.stage_start, run.dt, now / area_now, before / area_before);
  }
}

void WallDissipation::end_stage(const RunView& run) {
  const Model& model = run.model;
  if (run.stage.type == Stage::Type::geostatic || !watches(model)) return;
  const NodalView excess = run.pressure.values();
  const PointView start = rows_of(run);
  for (std::size_t k = 0; k < model.contacts().size(); ++k) {
    if (!(start(k, area) > 0)) continue;
    const auto& [name, contact] = model.contacts()[k];
    const double before = start(k, pressure), width = pressed_half_width(model, *contact);
    const Wall now = look(model, *contact, excess);
    // only a body at rest is judged
    if (!rests(model, *contact, start, k) || !(now.area > 0) || !(before > 0) || now.pressure >= before) continue;
    char text[300];
    const double way = std::sqrt(now.diffusivity * (run.state.time - run.stage_start));
    const bool coarse = now.thickness > finest * std::min(width, way);
    if (coarse)
      std::snprintf(
          text, sizeof text,
          "contact '%s': excess pore pressure on the wall %.3g -> %.3g kPa, but the mesh does not resolve its "
          "dissipation: elements there are %.2g m thick, more than half of %s %.2g m",
          name.c_str(), before / 1e3, now.pressure / 1e3, now.thickness,
          width < way ? "the body's half width," : "the distance that pressures diffuse in the stage,",
          std::min(width, way));
    else
      std::snprintf(text, sizeof text,
                    "contact '%s': excess pore pressure on the wall %.3g -> %.3g kPa, %.0f %% dissipated", name.c_str(),
                    before / 1e3, now.pressure / 1e3, 100 * (1 - now.pressure / before));
    coarse ? log::warn(text) : log::info(std::string("  ") + text);
  }
}

}  // namespace mudline
