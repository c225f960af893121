#include "simulation/pressed_sides.hpp"

#include <algorithm>

#include "integrator/overlap.hpp"
#include "tensor/vec.hpp"

namespace mudline {

std::vector<Side> pressed_sides(const Model& model, const Contact& contact) {
  const std::vector<double> pressed = contact.nodal_pressure(model.store().committed());
  std::vector<Side> result;
  for (const Side& side : model.mesh().side_sets().at(contact.partners().surface)) {
    const ElementBlock& block = model.mesh().blocks()[side.block];
    const std::vector<int>& nodes = side_nodes(block.shape, side.side);
    if (std::all_of(nodes.begin(), nodes.end(), [&](int a) { return pressed[block.nodes(side.element, a)] > 0; }))
      result.push_back(side);
  }
  return result;
}

Point pressed_direction(const Model& model, const Contact& contact) {
  constexpr double least = 1e-6;  // [-] share of the sum of sizes below which the pressures cancel
  const Mesh& mesh = model.mesh();
  const State& state = model.store().committed();
  const int axes = mesh.dimension();
  Point vertical{};
  vertical[axes - 1] = 1;
  const RigidBody* body = contact.partners().body;
  const bool upright = axes == 2 && (mesh.geometry() == Geometry::axisymmetric ||
                                     (body != nullptr && body->contour().extent() == ContourExtent::half));
  if (upright) return vertical;
  const std::vector<double> pressure = contact.nodal_pressure(state);
  std::vector<double> sum(4, 0.0);  // resultant and sum of sizes [N]
  for (const Side& side : mesh.side_sets().at(contact.partners().surface)) {
    const ElementBlock& block = mesh.blocks()[side.block];
    const std::vector<int> local = side_nodes(block.shape, side.side);
    const int corners = num_corners(side_shape(block.shape, side.side));
    std::vector<Point> at;
    double mean = 0;
    for (int c = 0; c < corners; ++c) {
      const int node = block.nodes(side.element, local[c]);
      at.push_back(place_of(state.coordinates, node));
      mean += pressure[node] / corners;
    }
    const Point along = at[1] - at[0];
    Point area{along[1], -along[0], 0};
    if (corners == 3) area = 0.5 * cross(along, at[2] - at[0]);
    if (corners == 4) area = 0.5 * cross(at[2] - at[0], at[3] - at[1]);
    for (int i = 0; i < 3; ++i) sum[i] += mean * area[i];
    sum[3] += mean * length(area);
  }
  sum = sum_over_ranks(*mesh.comm(), sum);
  const Point resultant{sum[0], sum[1], sum[2]};
  const double size = length(resultant);
  return size > least * sum[3] ? 1 / size * resultant : vertical;
}

double pressed_half_width(const Model& model, const Contact& contact) {
  const RigidBody& body = *contact.partners().body;
  return 0.5 * body.shadow(body.placement(model.store().committed()), pressed_direction(model, contact)).width;
}

}  // namespace mudline
