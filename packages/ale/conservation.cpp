#include "ale/conservation.hpp"

#include <algorithm>
#include <cmath>

#include "discretisation/cell_map.hpp"
#include "framework/coordinates.hpp"
#include "tensor/dual.hpp"

namespace mudline {

namespace {

constexpr int dim = place_size;

/// Map of one element at one quadrature point; factor det: volume.
struct PointMap : CellMap<dim> {
  Dual<dim> around, place[dim];  // measure at the point, the point [m], with derivatives by the point
  double factor = 0;

  PointMap(const WholeMesh::Element& element, const SoilBlock& block, int q, const Positions& x, Geometry geometry) {
    double gradient[dim][dim] = {};
    for (int i = 0; i < dim; ++i) {
      place[i] = Dual<dim>(0, i);
      for (int a = 0; a < block.u.nodes; ++a) {
        const double at = x[element.nodes[a]][i];
        place[i] += block.u.N(q, a) * at;
        for (int k = 0; k < dim; ++k) gradient[i][k] += at * block.u.dN(q, a, k);
      }
    }
    compute(gradient);
    around = measure(geometry, place);
    factor = block.u.weights(q) * around.v;
  }
  double volume() const { return factor * det; }
  /// Adds the derivative of the volume by the place of node a.
  void add_gradient(const SoilBlock& block, int q, int a, std::array<double, dim>& to) const {
    double slope[1][dim];
    gradients(&block.u.dN(q, a, 0), slope);
    for (int i = 0; i < dim; ++i)
      to[i] += volume() * slope[0][i] + around.d[i] * block.u.weights(q) * block.u.N(q, a) * det;
  }
};

}  // namespace

double soil_volume(const WholeMesh& mesh, const Soil& soil, const Positions& x) {
  double sum = 0;
  for (const SoilBlock& block : soil.blocks)
    for (int e : mesh.block_elements(block.block))
      for (int q = 0; q < block.points; ++q) sum += PointMap(mesh.elements()[e], block, q, x, soil.geometry).volume();
  return sum;
}

FreeBoundary::FreeBoundary(const WholeMesh& mesh, const Soil& soil, const std::vector<double>& freedom,
                           const std::vector<double>& held, const Positions& x) {
  std::vector<std::array<double, dim>> gradient(mesh.num_nodes(), {0, 0});  // of the volume
  for (const SoilBlock& block : soil.blocks)
    for (int e : mesh.block_elements(block.block)) {
      const auto& element = mesh.elements()[e];
      if (std::none_of(element.nodes.begin(), element.nodes.begin() + block.u.nodes,
                       [&](int node) { return freedom[node] > 0; }))
        continue;
      for (int q = 0; q < block.points; ++q) {
        const PointMap at(element, block, q, x, soil.geometry);
        for (int a = 0; a < block.u.nodes; ++a) at.add_gradient(block, q, a, gradient[element.nodes[a]]);
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
    for (int i = 0; i < dim; ++i) {
      if (held[dim * node + i] != 0) continue;
      mover.normal[i] = g[i] / size;
      share += mover.normal[i] * mover.normal[i];
    }
    if (share < 0.1) continue;  // a roller: what is left is rounding
    for (double& component : mover.normal) component *= freedom[node];
    area += share * freedom[node] * size;
    movers.push_back(mover);
  }
}

std::vector<double> point_volumes(const PointTransfer& t, Geometry geometry, const Positions& x) {
  std::vector<double> volumes(t.old.size() / t.columns, 0.0);
  for (int e : t.mesh.block_elements(t.block.block))
    for (int q = 0; q < t.block.points; ++q)
      volumes[t.mesh.first_row(e, t.block.points) + q] =
          PointMap(t.mesh.elements()[e], t.block, q, x, geometry).volume();
  return volumes;
}

std::vector<Grains> restore_grains(const PointTransfer& t, Geometry geometry, int column, const std::vector<char>& was,
                                   const std::vector<char>& is, std::size_t materials) {
  std::vector<Grains> grains(materials);
  std::vector<double> after(materials, 0.0), moved(materials, 0.0), weight(t.now.size() / t.columns, 0.0);
  const bool layered = t.block.made_of.size() > 1;
  for (int e : t.mesh.block_elements(t.block.block)) {
    const auto& element = t.mesh.elements()[e];
    for (int q = 0; q < t.block.points; ++q) {
      const std::size_t row = t.mesh.first_row(e, t.block.points) + q;
      const PointMap old(element, t.block, q, t.x_old, geometry), now(element, t.block, q, t.x_new, geometry);
      const double had = old.volume() / (1 + t.old[row * t.columns + column]),
                   has = now.volume() / (1 + t.now[row * t.columns + column]);
      grains[was[row]].before += had;
      after[is[row]] += has;
      if (was[row] != is[row]) grains[was[row]].changed += had;
      if (was[row] != is[row]) grains[is[row]].changed += has;
      const double way = std::hypot(now.place[0].v - old.place[0].v, now.place[1].v - old.place[1].v);
      weight[row] = layered ? 1.0 : std::min(1.0, way / std::sqrt(std::abs(old.det)));
      moved[is[row]] += weight[row] * now.volume();
    }
  }
  for (std::size_t k = 0; k < materials; ++k)
    if (moved[k] > 0) grains[k].missing = grains[k].before - after[k];
  for (std::size_t row = 0; row < weight.size(); ++row) {
    double& ratio = t.now[row * t.columns + column];
    const Grains& of = grains[is[row]];
    // of the dry density where a point moved by its element's size
    const double change = weight[row] > 0 ? of.missing / moved[is[row]] : 0.0;
    if (weight[row] > 0) ratio = 1 / (1 / (1 + ratio) + weight[row] * change) - 1;
  }
  return grains;
}

double grains(const WholeMesh& mesh, const SoilBlock& block, const Positions& x, Geometry geometry,
              const std::vector<double>& table, int columns, int column) {
  double sum = 0;
  for (int e : mesh.block_elements(block.block))
    for (int q = 0; q < block.points; ++q)
      sum += PointMap(mesh.elements()[e], block, q, x, geometry).volume() /
             (1 + table[static_cast<std::size_t>(mesh.first_row(e, block.points) + q) * columns + column]);
  return sum;
}

double restore_all_grains(const WholeMesh& mesh, const SoilBlock& block, const Positions& x, Geometry geometry,
                          std::vector<double>& table, int columns, int column, double before) {
  const double after = grains(mesh, block, x, geometry, table, columns, column);
  for (std::size_t i = column; i < table.size(); i += columns) table[i] = (1 + table[i]) * (after / before) - 1;
  return (before - after) / before;
}

}  // namespace mudline
