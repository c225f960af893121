#include "physics/error_estimate.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/over_ranks.hpp"
#include "discretisation/cell_map.hpp"
#include "framework/coordinates.hpp"
#include "framework/normal_equations.hpp"
#include "physics/soil_points.hpp"
#include "tensor/mat.hpp"

namespace mudline {

namespace {

constexpr int tensor = 6;              // components xx yy zz yz xz xy
constexpr int recovered = 2 * tensor;  // change of the stress, rate of strain
constexpr int most_corners = 8, most_nodes = 27;

double contract(const double* a, const double* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// Twice the elastic energy per volume [J/m3] of a stress.
double energy_density(const double* s, const ElasticModuli& moduli) {
  const double mean = (s[0] + s[1] + s[2]) / 3;
  const double deviator[tensor] = {s[0] - mean, s[1] - mean, s[2] - mean, s[3], s[4], s[5]};
  return mean * mean / moduli.bulk + contract(deviator, deviator) / (2 * moduli.shear);
}

/// Edge of the cell with edges of one length that has this area or volume.
double side_length(CellShape shape, double content) {
  return dimension(shape) == 3 ? std::cbrt(equilateral(shape) * content) : std::sqrt(equilateral(shape) * content);
}

/// Shape functions of a cell's linear partner at the cell's quadrature points: (point, corner).
std::vector<double> linear_shapes(const FieldBlock& b) {
  const int corners = num_corners(b.shape);
  std::vector<double> N(static_cast<std::size_t>(b.points) * corners);
  double dN[most_corners * 3];
  for (int q = 0; q < b.points; ++q) {
    double xi[3] = {};
    for (int a = 0; a < b.u.nodes; ++a)
      for (int i = 0; i < 3; ++i) xi[i] += b.u.N(q, a) * reference_node(b.shape, a)[i];
    evaluate_shape(linear_partner(b.shape), xi, &N[static_cast<std::size_t>(q) * corners], dN);
  }
  return N;
}

/// Matrix (sample, point) that turns values at the quadrature points into samples. A sample is the value of their
/// linear least squares fit at a reduced quadrature point; in a linear cell it is their mean.
template <int corners>
std::vector<double> quadratic_sampler(const FieldBlock& b, const std::vector<double>& N) {
  const QuadratureRule reduced = cell_quadrature(linear_partner(b.shape), simplex_coordinates(b.shape) > 0 ? 2 : 3);
  double a[corners][corners] = {};
  std::vector<double> right;  // (point, corner)
  for (int q = 0; q < b.points; ++q)
    for (int r = 0; r < corners; ++r) {
      right.push_back(b.u.weights(q) * N[q * corners + r]);
      for (int s = 0; s < corners; ++s) a[r][s] += b.u.weights(q) * N[q * corners + r] * N[q * corners + s];
    }
  solve_normal<corners>(a, right);
  std::vector<double> sampler;
  for (const auto& xi : reduced.points) {
    double at[corners], dN[corners * 3];
    evaluate_shape(linear_partner(b.shape), xi.data(), at, dN);
    for (int q = 0; q < b.points; ++q) {
      double sum = 0;
      for (int r = 0; r < corners; ++r) sum += at[r] * right[q * corners + r];
      sampler.push_back(sum);
    }
  }
  return sampler;
}

std::vector<double> make_sampler(const FieldBlock& b, const std::vector<double>& N) {
  const int corners = num_corners(b.shape);
  if (order(b.shape) == 1 || b.points < corners) {
    double sum = 0;
    for (int q = 0; q < b.points; ++q) sum += b.u.weights(q);
    std::vector<double> mean;
    for (int q = 0; q < b.points; ++q) mean.push_back(b.u.weights(q) / sum);
    return mean;
  }
  return corners == 3   ? quadratic_sampler<3>(b, N)
         : corners == 4 ? quadratic_sampler<4>(b, N)
         : corners == 6 ? quadratic_sampler<6>(b, N)
                        : quadratic_sampler<most_corners>(b, N);
}

}  // namespace

struct ErrorEstimator::BlockTables {
  const SoilBlock& block;
  int corners;
  std::vector<double> N, sampler;  // (point, corner), (sample, point)
  // rows: (element, point)
  std::vector<Point> places;
  std::vector<double> values;           // (row, components of stress change and strain rate)
  std::vector<double> volume, area;     // [m3]; [m2] or [m3] without the length out of the plane
  std::vector<double> pressure;         // [Pa] excess pore pressure
  std::vector<Point> slope;             // [Pa/m] gradient of that
  FieldBlock fine;                      // with enough points for the square of a quadratic
  std::vector<double> fine_N;           // (fine point, corner)
  std::vector<double> corner_pressure;  // (element, corner)
  std::vector<Point> corner_places;
};

struct ErrorEstimator::Sums {
  double error = 0, change = 0, whole = 0;  // [J] twice the energies: of the error, the change, the stress itself
  double flow_error = 0, flow = 0;          // [W]
  double power = 0;                         // [W]
  double elements = 0;
};

ErrorEstimator::ErrorEstimator(const Soil& soil, StateStore& store)
    : soil_(soil), mesh_(soil.space->mesh()), exchange_(mesh_) {
  std::map<std::string, Region> regions;
  for (std::size_t k = 0; k < soil.blocks.size(); ++k) {
    const SoilBlock& b = soil.blocks[k];
    regions[mesh_.blocks()[b.block].region].push_back(static_cast<int>(k));
    const std::string name = "effective stress at the start";
    start_.push_back(store.declare(
        ArrayInfo::at_points(name + "#" + std::to_string(b.block), {{name, tensor, "Pa"}}, mesh_, b.block, b.points)));
  }
  for (const auto& [name, region] : regions) regions_.push_back(region);
}

void ErrorEstimator::start(const State& state) const {
  for (std::size_t k = 0; k < start_.size(); ++k)
    Kokkos::deep_copy(state.arrays[start_[k]], state.arrays[soil_.blocks[k].stress]);
}

namespace {

/// Position, map and shape gradients at a quadrature point; false where the element is folded.
template <int Dim>
bool map_point(const FieldBlock& b, int e, int q, const ConstCoordinateView& x, CellMap<Dim>& map, Point& place) {
  double nodes[most_nodes][Dim] = {};
  place = {};
  for (int a = 0; a < b.u.nodes; ++a)
    for (int i = 0; i < Dim; ++i) {
      nodes[a][i] = x(b.nodes(e, a), i);
      place[i] += b.u.N(q, a) * nodes[a][i];
    }
  Mat<double, Dim> slope = {};
  for (int a = 0; a < b.u.nodes; ++a)
    for (int i = 0; i < Dim; ++i)
      for (int k = 0; k < Dim; ++k) slope[i][k] += nodes[a][i] * b.u.dN(q, a, k);
  map.compute(slope);
  return map.det > 0;
}

/// Rate of strain (tensor components) from the velocities.
template <int Dim>
void strain_rate(const FieldBlock& b, int e, int q, const CellMap<Dim>& map, const ConstNodalView& rate, bool hoop,
                 double radius, double* d) {
  Mat<double, 3> grad = {};
  double radial = 0;
  for (int a = 0; a < b.u.nodes; ++a) {
    double g[Dim];
    for (int j = 0; j < Dim; ++j) {
      g[j] = 0;
      for (int k = 0; k < Dim; ++k) g[j] += b.u.dN(q, a, k) * map.inverse[k][j];
    }
    for (int i = 0; i < Dim; ++i) {
      const double v = rate(b.dofs(e, Dim * a + i));
      for (int j = 0; j < Dim; ++j) grad[i][j] += v * g[j];
      if (i == 0) radial += b.u.N(q, a) * v;
    }
  }
  if (hoop) grad[2][2] = radial / radius;
  for (int i = 0; i < 3; ++i) d[i] = grad[i][i];
  d[3] = 0.5 * (grad[1][2] + grad[2][1]);
  d[4] = 0.5 * (grad[0][2] + grad[2][0]);
  d[5] = 0.5 * (grad[0][1] + grad[1][0]);
}

/// Value and gradient of the pore pressure at a point.
template <int Dim>
void pressure_at(const FieldBlock& b, int e, int q, const CellMap<Dim>& map, const NodalView& excess, double& value,
                 Point& slope) {
  value = 0;
  slope = {};
  for (int c = 0; c < b.p.nodes; ++c) {
    const double p = excess(b.dofs(e, Dim * b.u.nodes + c));
    value += b.p.N(q, c) * p;
    for (int i = 0; i < Dim; ++i)
      for (int k = 0; k < Dim; ++k) slope[i] += p * b.p.dN(q, c, k) * map.inverse[k][i];
  }
}

}  // namespace

ErrorEstimator::BlockTables ErrorEstimator::tabulate_block(int k, const State& state, const NodalView& excess) const {
  const SoilBlock& b = soil_.blocks[k];
  BlockTables t{b, num_corners(b.shape), linear_shapes(b), {}, {}, {}, {}, {}, {}, {}, {}, {}, {}, {}};
  t.sampler = make_sampler(b, t.N);
  if (b.porous()) {
    t.fine = b.with_quadrature(4);
    t.fine_N = linear_shapes(t.fine);
  }
  const std::size_t rows = static_cast<std::size_t>(b.elements) * b.points;
  t.places.resize(rows);
  t.values.resize(rows * recovered);
  t.volume.assign(rows, 0.0);
  t.area.assign(rows, 0.0);
  t.pressure.assign(b.porous() ? rows : 0, 0.0);
  t.slope.assign(b.porous() ? rows : 0, Point{});
  const PointView stress = state.arrays[b.stress], start = state.arrays[start_[k]];
  with_coordinates(soil_.geometry, [&](auto coordinates) {
    using C = decltype(coordinates);
    for (int e = 0; e < b.elements; ++e)
      for (int q = 0; q < b.points; ++q) {
        const int row = e * b.points + q;
        CellMap<C::dim> map;
        double* values = &t.values[static_cast<std::size_t>(row) * recovered];
        for (int i = 0; i < tensor; ++i) values[i] = stress(row, i) - start(row, i);
        // a folded point has no weight
        if (!map_point(b, e, q, state.coordinates, map, t.places[row])) continue;
        t.area[row] = b.u.weights(q) * map.det;
        t.volume[row] = t.area[row] * C::measure(t.places[row].data());
        strain_rate(b, e, q, map, state.rate, C::hoop, t.places[row][0], values + tensor);
        if (b.porous()) pressure_at(b, e, q, map, excess, t.pressure[row], t.slope[row]);
      }
    if (b.porous())
      for (int e = 0; e < b.elements; ++e)
        for (int c = 0; c < t.corners; ++c) {
          t.corner_pressure.push_back(excess(b.dofs(e, C::dim * b.u.nodes + c)));
          t.corner_places.push_back(place_of(state.coordinates, b.nodes(e, c)));
        }
  });
  return t;
}

double ErrorEstimator::pressure_error(const BlockTables& t, int e, const State& state,
                                      const PatchRecovery& pressure) const {
  double square = 0, volume = 0;
  with_coordinates(soil_.geometry, [&](auto coordinates) {
    using C = decltype(coordinates);
    for (int q = 0; q < t.fine.points; ++q) {
      CellMap<C::dim> map;
      Point place;
      if (!map_point(t.fine, e, q, state.coordinates, map, place)) continue;
      const double dv = t.fine.u.weights(q) * map.det * C::measure(place.data());
      const double* N = &t.fine_N[static_cast<std::size_t>(q) * t.corners];
      double error = 0;
      pressure.evaluate(&t.block.nodes(e, 0), t.corners, N, place, &error);
      for (int c = 0; c < t.corners; ++c) error -= N[c] * t.corner_pressure[e * t.corners + c];
      square += dv * error * error;
      volume += dv;
    }
  });
  return volume > 0 ? std::sqrt(square / volume) : 0.0;
}

void ErrorEstimator::add_samples(const BlockTables& t, PatchRecovery& to) const {
  const int points = t.block.points, samples = static_cast<int>(t.sampler.size()) / points;
  for (int e = 0; e < t.block.elements; ++e) {
    to.begin_element(&t.block.nodes(e, 0), t.corners);
    for (int s = 0; s < samples; ++s) {
      // positions and values are treated alike, so that a field that is linear in space stays linear
      Point place{};
      double values[recovered] = {};
      for (int q = 0; q < points; ++q) {
        const double share = t.sampler[s * points + q];
        const std::size_t row = static_cast<std::size_t>(e) * points + q;
        for (int i = 0; i < 3; ++i) place[i] += share * t.places[row][i];
        for (int c = 0; c < recovered; ++c) values[c] += share * t.values[row * recovered + c];
      }
      to.add(place, values);
    }
  }
}

void ErrorEstimator::add_corners(const BlockTables& t, PatchRecovery& to) const {
  for (int e = 0; e < t.block.elements; ++e) {
    to.begin_element(&t.block.nodes(e, 0), t.corners);
    for (int c = 0; c < t.corners; ++c)
      to.add(t.corner_places[e * t.corners + c], &t.corner_pressure[e * t.corners + c]);
  }
}

void ErrorEstimator::measure_block(const BlockTables& t, const State& state, const PatchRecovery& stress,
                                   const PatchRecovery* pressure, ErrorEstimate& to, std::vector<double>& energy,
                                   Sums& sums) const {
  const SoilBlock& b = t.block;
  const SoilPoints soil(soil_, b, state);
  const int dim = mesh_.dimension();
  for (int e = 0; e < b.elements; ++e) {
    double square = 0, volume = 0, area = 0, own = 0, power = 0;
    for (int q = 0; q < b.points; ++q) {
      const int row = e * b.points + q;
      const double dv = t.volume[row];
      if (dv == 0) continue;
      const double *N = &t.N[static_cast<std::size_t>(q) * t.corners],
                   *change = &t.values[static_cast<std::size_t>(row) * recovered];
      double error[recovered], p = 0, slope[3] = {};
      stress.evaluate(&b.nodes(e, 0), t.corners, N, t.places[row], error);
      for (int c = 0; c < recovered; ++c) error[c] -= change[c];
      const ElasticModuli moduli = soil.moduli(row);
      own += dv * energy_density(error, moduli);
      sums.change += dv * energy_density(change, moduli);
      sums.whole += dv * energy_density(soil.stress(row), moduli);
      if (pressure != nullptr) {
        pressure->evaluate(&b.nodes(e, 0), t.corners, N, t.places[row], &p, slope);
        p -= t.pressure[row];
        const double mobility = dv * soil.mobility(row), *found = t.slope[row].data();
        for (int i = 0; i < dim; ++i) slope[i] -= found[i];
        sums.flow_error += mobility * soil.along_ratios(row, slope, slope, dim);
        sums.flow += mobility * soil.along_ratios(row, found, found, dim);
      }
      const double* rate = error + tensor;
      power += dv * (contract(error, rate) - soil.material(row).biot_coefficient * p * (rate[0] + rate[1] + rate[2]));
      square += dv * contract(error, error);
      volume += dv;
      area += t.area[row];
    }
    const double per_volume = volume > 0 ? 1 / volume : 0.0;
    to.stress.push_back(std::sqrt(square * per_volume));
    if (soil_.pressure >= 0) to.pressure.push_back(pressure == nullptr ? 0.0 : pressure_error(t, e, state, *pressure));
    to.size.push_back(side_length(b.shape, area));
    energy.push_back(own);
    sums.error += own;
    sums.power += std::abs(power);
    sums.elements += 1;
  }
}

ErrorEstimate ErrorEstimator::estimate(const State& state, const NodalView& excess, double target) const {
  ErrorEstimate to;
  std::vector<double> energy;  // [J] of each element's error
  Sums local;
  std::vector<BlockTables> tables;
  for (std::size_t k = 0; k < soil_.blocks.size(); ++k)
    tables.push_back(tabulate_block(static_cast<int>(k), state, excess));
  std::vector<std::unique_ptr<PatchRecovery>> stress(tables.size()), pressure(tables.size());
  std::vector<int> region_of(tables.size());
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    int degree = 1;
    bool porous = false;
    for (int k : regions_[r]) {
      degree = std::max(degree, order(soil_.blocks[k].shape));
      porous = porous || soil_.blocks[k].porous();
      region_of[k] = static_cast<int>(r);
    }
    stress[r] = std::make_unique<PatchRecovery>(mesh_, exchange_, state.coordinates, degree, recovered);
    if (porous) pressure[r] = std::make_unique<PatchRecovery>(mesh_, exchange_, state.coordinates, 2, 1);
    for (int k : regions_[r]) {
      add_samples(tables[k], *stress[r]);
      if (porous) add_corners(tables[k], *pressure[r]);
    }
    stress[r]->fit();
    if (porous) pressure[r]->fit();
  }
  for (std::size_t k = 0; k < tables.size(); ++k)
    measure_block(tables[k], state, *stress[region_of[k]], pressure[region_of[k]].get(), to, energy, local);

  const std::vector<double> sum =
      sum_over_ranks(*mesh_.comm(), std::vector<double>{local.error, local.change, local.whole, local.flow_error,
                                                        local.flow, local.power, local.elements});
  // a change at the level of the stress's rounding counts as zero
  const double whole = sum[1] > 1e-16 * sum[2] ? sum[0] + sum[1] : 0.0;
  if (whole > 0) to.stress_share = std::sqrt(sum[0] / whole);
  if (sum[3] + sum[4] > 0) to.flow_share = std::sqrt(sum[3] / (sum[3] + sum[4]));
  to.power = sum[5];
  const double share = target * target * whole / std::max(1.0, sum[6]);
  std::size_t i = 0;
  for (const BlockTables& t : tables)
    for (int e = 0; e < t.block.elements; ++e, ++i) {
      // the stress error is of order p in the size; the size changes by a factor of ten at most
      const double ratio = energy[i] > 0 && whole > 0 ? std::pow(share / energy[i], 0.5 / order(t.block.shape)) : 10.0;
      to.wanted.push_back(to.size[i] * (whole > 0 ? std::clamp(ratio, 0.1, 10.0) : 1.0));
    }
  return to;
}

}  // namespace mudline
