#include "ale/conservation.hpp"

#include <algorithm>
#include <cmath>

#include "core/pi.hpp"
#include "discretisation/cell_map.hpp"

namespace mudline {

namespace {

/// Map of one element at one quadrature point; factor det: volume.
struct PointMap : CellMap<2> {
  double factor = 0;

  PointMap(const WholeMesh::Element& element, const SoilBlock& block, int q, const Positions& x, bool axisymmetric) {
    double r = 0, gradient[2][2] = {};
    for (int a = 0; a < block.u.nodes; ++a) {
      const auto& place = x[element.nodes[a]];
      r += block.u.N(q, a) * place[0];
      for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 2; ++k) gradient[i][k] += place[i] * block.u.dN(q, a, k);
    }
    compute(gradient);
    factor = block.u.weights(q) * (axisymmetric ? 2 * pi * r : 1.0);
  }
  double volume() const { return factor * det; }
};

}  // namespace

double soil_volume(const WholeMesh& mesh, const Soil& soil, const Positions& x) {
  double sum = 0;
  for (const SoilBlock& block : soil.blocks)
    for (int e : mesh.block_elements(block.block))
      for (int q = 0; q < block.points; ++q)
        sum += PointMap(mesh.elements()[e], block, q, x, soil.axisymmetric()).volume();
  return sum;
}

FreeBoundary::FreeBoundary(const WholeMesh& mesh, const Soil& soil, const std::vector<double>& freedom,
                           const std::vector<double>& held, const Positions& x) {
  std::vector<std::array<double, 2>> gradient(mesh.num_nodes(), {0, 0});  // of the volume
  for (const SoilBlock& block : soil.blocks)
    for (int e : mesh.block_elements(block.block)) {
      const auto& element = mesh.elements()[e];
      if (std::none_of(element.nodes.begin(), element.nodes.begin() + block.u.nodes,
                       [&](int node) { return freedom[node] > 0; }))
        continue;
      for (int q = 0; q < block.points; ++q) {
        const PointMap at(element, block, q, x, soil.axisymmetric());
        for (int a = 0; a < block.u.nodes; ++a) {
          const double d[2] = {block.u.dN(q, a, 0), block.u.dN(q, a, 1)};
          auto& g = gradient[element.nodes[a]];
          g[0] += at.factor * (d[0] * at.slope[1][1] - d[1] * at.slope[1][0]);
          g[1] += at.factor * (at.slope[0][0] * d[1] - at.slope[0][1] * d[0]);
          if (soil.axisymmetric()) g[0] += 2 * pi * block.u.weights(q) * block.u.N(q, a) * at.det;
        }
      }
    }
  double largest = 0;
  for (int node = 0; node < mesh.num_nodes(); ++node)
    if (freedom[node] > 0) largest = std::max(largest, std::hypot(gradient[node][0], gradient[node][1]));
  for (int node = 0; node < mesh.num_nodes(); ++node) {
    if (!(freedom[node] > 0)) continue;
    const auto& g = gradient[node];
    const double size = std::hypot(g[0], g[1]);
    if (!(size > 1e-6 * largest)) continue;  // rounding would choose its direction
    Mover mover{node, {0, 0}};
    double share = 0;  // of the normal that is left
    for (int i = 0; i < 2; ++i) {
      if (held[2 * node + i] != 0) continue;
      mover.normal[i] = g[i] / size;
      share += mover.normal[i] * mover.normal[i];
    }
    if (share < 0.1) continue;  // a roller: what is left is rounding
    for (double& component : mover.normal) component *= freedom[node];
    area += share * freedom[node] * size;
    movers.push_back(mover);
  }
}

double restore_grains(const PointTransfer& t, bool axisymmetric, int column) {
  double before = 0, after = 0, moved = 0;
  std::vector<double> weight(t.now.size() / t.columns, 0.0);
  for (int e : t.mesh.block_elements(t.block.block)) {
    const auto& element = t.mesh.elements()[e];
    for (int q = 0; q < t.block.points; ++q) {
      const std::size_t row = t.mesh.first_row(e, t.block.points) + q;
      const PointMap old(element, t.block, q, t.x_old, axisymmetric), now(element, t.block, q, t.x_new, axisymmetric);
      before += old.volume() / (1 + t.old[row * t.columns + column]);
      after += now.volume() / (1 + t.now[row * t.columns + column]);
      const auto from = Recovery::position(element, t.block, q, t.x_old),
                 to = Recovery::position(element, t.block, q, t.x_new);
      weight[row] = std::min(1.0, std::hypot(to[0] - from[0], to[1] - from[1]) / std::sqrt(std::abs(old.det)));
      moved += weight[row] * now.volume();
    }
  }
  if (!(moved > 0)) return 0;
  const double change = (before - after) / moved;  // of the dry density where a point moved by its element's size
  for (std::size_t row = 0; row < weight.size(); ++row) {
    double& ratio = t.now[row * t.columns + column];
    if (weight[row] > 0) ratio = 1 / (1 / (1 + ratio) + weight[row] * change) - 1;
  }
  return (before - after) / before;
}

}  // namespace mudline
