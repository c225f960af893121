#include "ale/conservation.hpp"

#include <algorithm>
#include <cmath>

#include "discretisation/cell_map.hpp"
#include "framework/coordinates.hpp"
#include "tensor/dual.hpp"
#include "tensor/mat.hpp"

namespace mudline {

namespace {

/// Map of one element at one quadrature point, whose volume is factor times det.
template <int dim>
struct PointMap : CellMap<dim> {
  Dual<dim> around, place[dim];  // measure at the point, and its place [m], with derivatives by the place
  double factor = 0;

  PointMap(const GhostedMesh::Element& element, const SoilBlock& block, int q, const Positions& x, Geometry geometry) {
    Mat<double, dim> gradient = {};
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
  void add_gradient(const SoilBlock& block, int q, int a, Vec<double, dim>& to) const {
    double slope[1][dim];
    this->gradients(&block.u.dN(q, a, 0), slope);
    for (int i = 0; i < dim; ++i)
      to[i] += volume() * slope[0][i] + around.d[i] * block.u.weights(q) * block.u.N(q, a) * this->det;
  }
};

/// The part of the soil that a quadrature point represents.
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
  long double sum = 0;
  for (const SoilBlock& block : soil.blocks)
    for (int e : mesh.own_elements(block.block))
      for (int q = 0; q < block.points; ++q) sum += part(mesh.elements()[e], block, q, x, soil.geometry).volume;
  return mesh.sum(sum);
}

std::vector<double> point_volumes(const BlockPoints& at, Geometry geometry) {
  const GhostedMesh& mesh = at.mesh;
  const SoilBlock& block = at.block;
  std::vector<double> result(mesh.block_elements(block.block).size() * block.points);
  for (int e : mesh.block_elements(block.block))
    for (int q = 0; q < block.points; ++q)
      result[mesh.first_row(e, block.points) + q] = part(mesh.elements()[e], block, q, at.x, geometry).volume;
  return result;
}

FreeBoundary::FreeBoundary(const GhostedMesh& mesh, const Soil& soil, const std::vector<double>& freedom,
                           const std::vector<double>& held, const Positions& x) {
  mesh.dimension() == 2 ? find<2>(mesh, soil, freedom, held, x) : find<3>(mesh, soil, freedom, held, x);
}

template <int dim>
void FreeBoundary::find(const GhostedMesh& mesh, const Soil& soil, const std::vector<double>& freedom,
                        const std::vector<double>& held, const Positions& x) {
  const auto length = [](const Vec<double, dim>& g) {
    return dim == 2 ? std::hypot(g[0], g[1]) : std::hypot(g[0], g[1], g[dim - 1]);
  };
  std::vector<Vec<double, dim>> gradient(mesh.num_nodes(), Vec<double, dim>{});  // of the volume
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
  long double all = 0;
  for (int node : mesh.owned_nodes()) {
    if (!(freedom[node] > 0)) continue;
    const auto& g = gradient[node];
    const double size = length(g);
    if (!(size > 1e-6 * largest)) continue;  // rounding would determine its direction
    Mover mover{node, {}};
    double share = 0;  // square of the normal's part along free components
    for (int i = 0; i < dim; ++i) {
      if (held[dim * node + i] != 0) continue;
      mover.normal[i] = g[i] / size;
      share += mover.normal[i] * mover.normal[i];
    }
    if (share < 0.1) continue;  // a roller: only rounding is left of the normal
    for (double& component : mover.normal) component *= freedom[node];
    all += share * freedom[node] * size;
    movers.push_back(mover);
  }
  area = mesh.sum(all);
}

namespace {

/// Shares of the materials in each point: (row, material of the block).
std::vector<double> shares_of(const BlockPoints& at, const Soil& soil, int origin, const std::vector<double>& table,
                              int columns) {
  const GhostedMesh& mesh = at.mesh;
  const SoilBlock& block = at.block;
  const std::size_t count = block.made_of.size();
  std::vector<double> result(table.size() / columns * count, 1.0);
  std::vector<Point> starts(block.points, Point{});
  for (int e : mesh.own_elements(block.block)) {
    if (count == 1) break;
    const std::size_t first = mesh.first_row(e, block.points);
    for (int q = 0; q < block.points; ++q)
      for (int d = 0; d < mesh.dimension(); ++d) starts[q][d] = table[(first + q) * columns + origin + 1 + d];
    const std::vector<double> shares = soil.layer_shares(block, starts);
    std::copy(shares.begin(), shares.end(), result.begin() + static_cast<std::ptrdiff_t>(first * count));
  }
  return result;
}

/// Contents of this rank's points: by (row, material of the block).
struct HeldGrains {
  std::vector<double> shares;    // [-]
  std::vector<double> soil;      // [m3]
  std::vector<double> grains;    // [m3]
  std::vector<double> smooth;    // [m3] of grains, if every material had its own void ratio there
  std::vector<PointPart> parts;  // (row)

  /// `ratios`: empty where there is one material.
  HeldGrains(const BlockPoints& at, const Soil& soil_of, int void_ratio, int origin, const std::vector<double>& table,
             int columns, const std::vector<double>& ratios)
      : shares(shares_of(at, soil_of, origin, table, columns)) {
    const GhostedMesh& mesh = at.mesh;
    const SoilBlock& block = at.block;
    const std::size_t count = block.made_of.size();
    soil.resize(shares.size(), 0.0);
    grains = smooth = soil;
    parts.resize(shares.size() / count, {0, 1, {}});
    for (int e : mesh.own_elements(block.block))
      for (int q = 0; q < block.points; ++q) {
        const std::size_t row = mesh.first_row(e, block.points) + q;
        parts[row] = part(mesh.elements()[e], block, q, at.x, soil_of.geometry);
        for (std::size_t k = row * count; k < (row + 1) * count; ++k) {
          soil[k] = shares[k] * parts[row].volume;
          grains[k] = soil[k] / (1 + table[row * columns + void_ratio]);
          smooth[k] = ratios.empty() ? grains[k] : soil[k] / (1 + ratios[k]);
        }
      }
  }
};

/// Solves A x = b for a small symmetric, nearly diagonal matrix by Gauss-Seidel iteration.
std::vector<double> solve_small(const std::vector<double>& A, const std::vector<double>& b) {
  const std::size_t n = b.size();
  std::vector<double> x(n, 0.0);
  double change = 1, size = 0;
  for (int sweep = 0; sweep < 200; ++sweep) {
    if (!(change > 1e-16 * size)) break;
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
/// for each material. Entries of `missing` for which no point has weight are set to 0.
void add_grains(const PointTransfer& t, int void_ratio, const HeldGrains& held, const std::vector<double>& weights,
                std::vector<double>& missing) {
  const std::size_t count = missing.size();
  const std::vector<double>& shares = held.shares;
  std::vector<long double> gains(count * count, 0.0);
  for (std::size_t row = 0; row < weights.size(); ++row)
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < count; ++k)
        gains[i * count + k] +=
            shares[row * count + i] * shares[row * count + k] * weights[row] * held.parts[row].volume;
  std::vector<double> gained;
  for (long double entry : gains) gained.push_back(t.after.mesh.sum(entry));
  for (std::size_t i = 0; i < count; ++i)
    if (!(gained[i * count + i] > 0)) missing[i] = 0;
  const std::vector<double> change = solve_small(gained, missing);
  for (std::size_t row = 0; row < weights.size(); ++row) {
    double& ratio = t.now[row * t.columns + void_ratio];
    double more = 0;
    for (std::size_t i = 0; i < count; ++i) more += shares[row * count + i] * change[i];
    if (weights[row] > 0) ratio = 1 / (1 / (1 + ratio) + weights[row] * more) - 1;
  }
}

}  // namespace

std::vector<Grains> restore_grains(const PointTransfer& t, const Soil& soil, int void_ratio, int origin,
                                   const LayerRatios& ratios) {
  const std::size_t count = t.after.block.made_of.size();
  const HeldGrains was(t.before, soil, void_ratio, origin, t.old, t.columns, ratios.before),
      is(t.after, soil, void_ratio, origin, t.now, t.columns, ratios.after);
  // Differences are taken row by row where the rows are the same: a difference of sums would lose digits.
  const auto lost_of = [&](const std::vector<double>& had, const std::vector<double>& has, std::size_t material) {
    long double sum = 0;
    for (std::size_t k = material; k < std::max(had.size(), has.size()); k += count)
      sum += (k < had.size() ? had[k] : 0.0) - (k < has.size() ? has[k] : 0.0);
    return t.after.mesh.sum(sum);
  };
  const std::vector<double> nothing;
  std::vector<Grains> grains(count);
  std::vector<double> lost(count), jumped(count);
  for (std::size_t i = 0; i < count; ++i) {
    grains[i].before = lost_of(was.grains, nothing, i);
    lost[i] = lost_of(was.smooth, is.smooth, i);
    jumped[i] = lost_of(was.grains, is.grains, i) - lost[i];
    const double volume = lost_of(was.soil, nothing, i), grown = -lost_of(was.soil, is.soil, i);
    const double by_shares = count > 1 && volume > 0 ? -grown * grains[i].before / volume : 0.0;
    lost[i] -= by_shares;
    jumped[i] += by_shares;
  }
  std::vector<double> weights(is.parts.size(), 1.0);
  if (t.moved())
    for (std::size_t row = 0; row < weights.size(); ++row)
      weights[row] = std::min(1.0, distance(is.parts[row].place, was.parts[row].place) / was.parts[row].size);
  add_grains(t, void_ratio, is, weights, lost);
  for (std::size_t i = 0; i < count; ++i) {
    grains[i].missing = lost[i];
    grains[i].unresolved = jumped[i];
  }
  return grains;
}

}  // namespace mudline
