#include "simulation/wall_dissipation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/log.hpp"
#include "discretisation/side_map.hpp"
#include "integrator/overlap.hpp"
#include "physics/soil_points.hpp"
#include "simulation/excess_pressure.hpp"
#include "simulation/pressed_direction.hpp"
#include "tensor/mat.hpp"

namespace mudline {

namespace {

/// Largest thickness of an element at the wall over the smaller of the body's half width and the diffusion length of
/// the pore pressure. At this thickness linear pressures miss the curvature of the profile by some per cent.
constexpr double finest = 0.5;

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
  const double mobility = soil.conductivity(row) / soil.material(row).fluid->unit_weight();
  // the height is the volume over the area for a box, of which a simplex or a wedge is a part
  const double share = per_box(block.shape) / per_box(side_shape(block.shape, side.side));
  to.pressure += area * pressure;
  to.thickness += share * volume;
  to.diffusivity += area * mobility * (moduli.bulk + 4 * moduli.shear / 3);
  to.area += area;
}

WallDissipation::Wall WallDissipation::look(const Model& model, const Contact& contact, const NodalView& excess) {
  Wall wall;
  const std::vector<double> pressed = contact.nodal_pressure(model.store().committed());
  for (const Side& side : model.mesh().side_sets().at(contact.partners().surface)) {
    const ElementBlock& block = model.mesh().blocks()[side.block];
    const std::vector<int> nodes = side_nodes(block.shape, side.side);
    if (std::all_of(nodes.begin(), nodes.end(), [&](int a) { return pressed[block.nodes(side.element, a)] > 0; }))
      add_side(model, side, excess, wall);
  }
  const std::vector<double> sum =
      sum_over_ranks(*model.mesh().comm(), {wall.pressure, wall.thickness, wall.diffusivity, wall.area});
  if (!(sum[3] > 0)) return {};
  return {sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3], sum[3]};
}

void WallDissipation::begin_stage(const RunView& run) {
  const Model& model = run.model;
  if (run.resumed || !model.soil() || model.soil()->pressure < 0) return;
  const NodalView excess = run.pressure.values();
  start_.clear();
  for (const auto& [name, contact] : model.contacts()) {
    const RigidBody* body = contact->partners().body;
    if (body == nullptr) continue;
    const Wall wall = look(model, *contact, excess);
    if (wall.area > 0) start_[name] = {wall.pressure, body->position(model.store().committed())};
  }
}

void WallDissipation::end_stage(const RunView& run) {
  const Model& model = run.model;
  if (run.stage.type == Stage::Type::geostatic || !model.soil() || model.soil()->pressure < 0) return;
  const NodalView excess = run.pressure.values();
  for (const auto& [name, contact] : model.contacts()) {
    const auto start = start_.find(name);
    if (start == start_.end()) continue;
    const RigidBody& body = *contact->partners().body;
    const double width = pressed_half_width(model, *contact);
    const Wall now = look(model, *contact, excess);
    // only a body at rest is judged
    const bool rested = length(body.position(model.store().committed()) - start->second.position) < 0.01 * width;
    if (!rested || !(now.area > 0) || !(start->second.pressure > 0) || now.pressure >= start->second.pressure) continue;
    char text[300];
    const double way = std::sqrt(now.diffusivity * run.stage.duration);
    const bool coarse = now.thickness > finest * std::min(width, way);
    if (coarse)
      std::snprintf(
          text, sizeof text,
          "contact '%s': excess pore pressure on the wall %.3g -> %.3g kPa, but the mesh does not resolve its "
          "dissipation: elements there are %.2g m thick, more than half of %s %.2g m",
          name.c_str(), start->second.pressure / 1e3, now.pressure / 1e3, now.thickness,
          width < way ? "the body's half width," : "the distance that pressures diffuse in the stage,",
          std::min(width, way));
    else
      std::snprintf(text, sizeof text,
                    "contact '%s': excess pore pressure on the wall %.3g -> %.3g kPa, %.0f %% dissipated", name.c_str(),
                    start->second.pressure / 1e3, now.pressure / 1e3,
                    100 * (1 - now.pressure / start->second.pressure));
    coarse ? log::warn(text) : log::info(std::string("  ") + text);
  }
}

}  // namespace mudline
