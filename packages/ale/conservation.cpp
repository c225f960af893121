#include "ale/conservation.hpp"

#include <algorithm>
#include <cmath>

#include "discretisation/cell_map.hpp"
#include "framework/coordinates.hpp"
#include "tensor/dual.hpp"

namespace mudline {

namespace {

/// Map of one element at one quadrature point; factor det: volume.
template <int dim>
struct PointMap : CellMap<dim> {
  Dual<dim> around, place[dim];  // measure at the point, the point [m], with derivatives by the point
  double factor = 0;

  PointMap(const GhostedMesh::Element& element, const SoilBlock& block, int q, const Positions& x, Geometry geometry) {
    double gradient[dim][dim] = {};
    for (int i = 0; i < dim; ++i) {
      place[i] = Dual<dim>(0, i);
      for (int a = 0; a < block.u.nodes; ++a) {
        const double at = x[element.nodes[a]][i];
        place[i] += block.u.N(q, a) * at;
        for (int k = 0; k < dim; ++k) gradient[i][k] += at * block.u.dN(q, a, k);
      }
    }
    this->compute(gradient);
    around = measure(geometry, place);
    factor = block.u.weights(q) * around.v;
  }
  double volume() const { return factor * this->det; }
  /// Adds the derivative of the volume by the place of node a.
  void add_gradient(const SoilBlock& block, int q, int a, std::array<double, dim>& to) const {
    double slope[1][dim];
    this->gradients(&block.u.dN(q, a, 0), slope);
    for (int i = 0; i < dim; ++i)
      to[i] += volume() * slope[0][i] + around.d[i] * block.u.weights(q) * block.u.N(q, a) * this->det;
  }
};

/// What a quadrature point stands for.
struct PointPart {
  double volume;  // [m3; plane strain: per metre]
  double size;    // root of the map's determinant [m]
  Point place;
};

template <int dim>
PointPart part_in(const GhostedMesh::Element& element, const SoilBlock& block, int q, const Positions& x,
                  Geometry geometry) {
  const PointMap<dim> map(element, block, q, x, geometry);
  PointPart part{map.volume(), dim == 2 ? std::sqrt(std::abs(map.det)) : std::cbrt(std::abs(map.det)), {}};
  for (int i = 0; i < dim; ++i) part.place[i] = map.place[i].v;
  return part;
}

PointPart part(const GhostedMesh::Element& element, const SoilBlock& block, int q, const Positions& x,
               Geometry geometry) {
  return geometry == Geometry::space ? part_in<3>(element, block, q, x, geometry)
                                     : part_in<2>(element, block, q, x, geometry);
}

}  // namespace

double soil_volume(const GhostedMesh& mesh, const Soil& soil, const Positions& x) {
  double sum = 0;
  for (const SoilBlock& block : soil.blocks)
    for (int e : mesh.own_elements(block.block))
      for (int q = 0; q < block.points; ++q) sum += part(mesh.elements()[e], block, q, x, soil.geometry).volume;
  return mesh.sum(sum);
}

FreeBoundary::FreeBoundary(const GhostedMesh& mesh, const Soil& soil, const std::vector<double>& freedom,
                           const std::vector<double>& held, const Positions& x) {
  mesh.dimension() == 2 ? find<2>(mesh, soil, freedom, held, x) : find<3>(mesh, soil, freedom, held, x);
}

template <int dim>
void FreeBoundary::find(const GhostedMesh& mesh, const Soil& soil, const std::vector<double>& freedom,
                        const std::vector<double>& held, const Positions& x) {
  const auto length = [](const std::array<double, dim>& g) {
    return dim == 2 ? std::hypot(g[0], g[1]) : std::hypot(g[0], g[1], g[dim - 1]);
  };
  std::vector<std::array<double, dim>> gradient(mesh.num_nodes(), std::array<double, dim>{});  // of the volume
  for (const SoilBlock& block : soil.blocks)
    for (int e : mesh.block_elements(block.block)) {
      const auto& element = mesh.elements()[e];
      if (std::none_of(element.nodes.begin(), element.nodes.begin() + block.u.nodes,
                       [&](int node) { return freedom[node] > 0; }))
        continue;
      for (int q = 0; q < block.points; ++q) {
        const PointMap<dim> at(element, block, q, x, soil.geometry);
        for (int a = 0; a < block.u.nodes; ++a) at.add_gradient(block, q, a, gradient[element.nodes[a]]);
      }
    }
  double largest = 0;
  for (int node : mesh.owned_nodes())
    if (freedom[node] > 0) largest = std::max(largest, length(gradient[node]));
  largest = mesh.largest(largest);
  for (int node : mesh.owned_nodes()) {
    if (!(freedom[node] > 0)) continue;
    const auto& g = gradient[node];
    const double size = length(g);
    if (!(size > 1e-6 * largest)) continue;  // rounding would choose its direction
    Mover mover{node, {}};
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
  area = mesh.sum(area);
}

namespace {

/// (row, material of the block) what each material has of each point.
std::vector<double> shares_of(const PointTransfer& t, const Soil& soil, int origin, const std::vector<double>& table) {
  const std::size_t count = t.block.made_of.size();
  std::vector<double> result(table.size() / t.columns * count, 1.0);
  std::vector<Point> starts(t.block.points, Point{});
  for (int e : t.mesh.own_elements(t.block.block)) {
    if (count == 1) break;
    const std::size_t first = t.mesh.first_row(e, t.block.points);
    for (int q = 0; q < t.block.points; ++q)
      for (int d = 0; d < t.mesh.dimension(); ++d) starts[q][d] = table[(first + q) * t.columns + origin + 1 + d];
    const std::vector<double> shares = soil.layer_shares(t.block, starts);
    std::copy(shares.begin(), shares.end(), result.begin() + static_cast<std::ptrdiff_t>(first * count));
  }
  return result;
}

/// Solves A x = b for a small matrix that is symmetric and nearly diagonal (Gauss and Seidel).
std::vector<double> solve_small(const std::vector<double>& A, const std::vector<double>& b) {
  const std::size_t n = b.size();
  std::vector<double> x(n, 0.0);
  double change = 1, size = 0;
  for (int sweep = 0; sweep < 200 && change > 1e-16 * size; ++sweep) {
    change = size = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (!(A[i * n + i] > 0)) continue;
      double rest = b[i];
      for (std::size_t k = 0; k < n; ++k) rest -= k != i ? A[i * n + k] * x[k] : 0.0;
      change = std::max(change, std::abs(rest / A[i * n + i] - x[i]));
      x[i] = rest / A[i * n + i];
      size = std::max(size, std::abs(x[i]));
    }
  }
  return x;
}

/// Adds `missing` grains to the materials of a block: the dry density of a point changes by its weight times one factor
/// for each material. `volumes`, `weights`: (row), `shares`: (row, material). What finds no weight is set to 0.
void add_grains(const PointTransfer& t, int void_ratio, const std::vector<double>& volumes,
                const std::vector<double>& weights, const std::vector<double>& shares, std::vector<double>& missing) {
  const std::size_t count = missing.size();
  std::vector<double> gained(count * count, 0.0);
  for (std::size_t row = 0; row < volumes.size(); ++row)
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < count; ++k)
        gained[i * count + k] += shares[row * count + i] * shares[row * count + k] * weights[row] * volumes[row];
  for (double& entry : gained) entry = t.mesh.sum(entry);
  for (std::size_t i = 0; i < count; ++i)
    if (!(gained[i * count + i] > 0)) missing[i] = 0;
  const std::vector<double> change = solve_small(gained, missing);
  for (std::size_t row = 0; row < volumes.size(); ++row) {
    double& ratio = t.now[row * t.columns + void_ratio];
    double more = 0;
    for (std::size_t i = 0; i < count; ++i) more += shares[row * count + i] * change[i];
    if (weights[row] > 0) ratio = 1 / (1 / (1 + ratio) + weights[row] * more) - 1;
  }
}

}  // namespace

std::vector<Grains> restore_grains(const PointTransfer& t, const Soil& soil, int void_ratio, int origin,
                                   const LayerRatios& ratios) {
  const std::size_t count = t.block.made_of.size(), rows = t.now.size() / t.columns;
  const std::vector<double> was = shares_of(t, soil, origin, t.old), is = shares_of(t, soil, origin, t.now);
  const bool layered = count > 1;
  std::vector<Grains> grains(count);
  std::vector<double> volumes(rows), ways(rows), lost(count, 0.0), jumped(count, 0.0);
  std::vector<double> grown(count, 0.0), volume(count, 0.0);  // [m3] of soil
  for (int e : t.mesh.own_elements(t.block.block)) {
    const auto& element = t.mesh.elements()[e];
    for (int q = 0; q < t.block.points; ++q) {
      const std::size_t row = t.mesh.first_row(e, t.block.points) + q;
      const PointPart old = part(element, t.block, q, t.x_old, soil.geometry),
                      now = part(element, t.block, q, t.x_new, soil.geometry);
      volumes[row] = now.volume;
      ways[row] = std::min(1.0, distance(now.place, old.place) / old.size);
      const double before = t.old[row * t.columns + void_ratio], after = t.now[row * t.columns + void_ratio];
      for (std::size_t i = 0; i < count; ++i) {
        const std::size_t k = row * count + i;
        const double had = was[k] * old.volume, has = is[k] * now.volume;
        const double loss = had / (1 + before) - has / (1 + after);
        const double smooth = layered ? had / (1 + ratios.before[k]) - has / (1 + ratios.after[k]) : loss;
        grains[i].before += had / (1 + before);
        lost[i] += smooth;
        jumped[i] += loss - smooth;
        grown[i] += has - had;
        volume[i] += had;
      }
    }
  }
  for (std::size_t i = 0; i < count; ++i)
    for (double* sum : {&grains[i].before, &lost[i], &jumped[i], &grown[i], &volume[i]}) *sum = t.mesh.sum(*sum);
  for (std::size_t i = 0; layered && i < count; ++i) {
    const double by_shares = volume[i] > 0 ? -grown[i] * grains[i].before / volume[i] : 0.0;
    lost[i] -= by_shares;
    jumped[i] += by_shares;
  }
  add_grains(t, void_ratio, volumes, ways, is, lost);
  for (std::size_t i = 0; i < count; ++i) grains[i].missing = lost[i];
  if (layered) add_grains(t, void_ratio, volumes, std::vector<double>(rows, 1.0), is, jumped);
  return grains;
}

double grains(const GhostedMesh& mesh, const SoilBlock& block, const Positions& x, Geometry geometry,
              const std::vector<double>& table, int columns, int column) {
  double sum = 0;
  for (int e : mesh.own_elements(block.block))
    for (int q = 0; q < block.points; ++q)
      sum += part(mesh.elements()[e], block, q, x, geometry).volume /
             (1 + table[static_cast<std::size_t>(mesh.first_row(e, block.points) + q) * columns + column]);
  return mesh.sum(sum);
}

double restore_all_grains(const GhostedMesh& mesh, const SoilBlock& block, const Positions& x, Geometry geometry,
                          std::vector<double>& table, int columns, int column, double before) {
  const double after = grains(mesh, block, x, geometry, table, columns, column);
  for (std::size_t i = column; i < table.size(); i += columns) table[i] = (1 + table[i]) * (after / before) - 1;
  return (before - after) / before;
}

}  // namespace mudline
