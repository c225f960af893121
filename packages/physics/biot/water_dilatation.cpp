#include "physics/biot/water_dilatation.hpp"

#include <Teuchos_LAPACK.hpp>

#include <algorithm>
#include <cmath>

#include "algebra/over_ranks.hpp"
#include "framework/element_loop.hpp"
#include "physics/mixture.hpp"
#include "physics/soil_points.hpp"

namespace mudline {

namespace {

/// Moments by node, and volumes and volume strains of the points by block.
struct Moments {
  std::vector<PointView> volume, strain;  // (point, 0) [m3], [-]
  std::vector<double> lumped, swell;      // int N dv, int N times volume strain dv [m3]
  std::vector<double> flow;               // int grad(N) . c_v grad(N) dv [m3/s]

  explicit Moments(std::size_t nodes) : lumped(nodes), swell(nodes), flow(nodes) {}
};

/// middle: coordinates in the middle of the step, on which the divergence of the displacement is the volume strain to
/// third order, and exactly that of the balance of the water in a step of the theta method.
void add_moments(const Soil& soil, const SoilBlock& b, const StepView& view, const CoordinateView& middle,
                 Moments& to) {
  const SoilPoints points(soil, b, *view.committed);
  const PointView volume("volume", b.elements * b.points, 1), strain("volume strain", b.elements * b.points, 1);
  to.volume.push_back(volume);
  to.strain.push_back(strain);
  with_element<1>(soil.geometry, b, [&](auto coordinates, auto shapes) {
    using Loop = ElementLoop<decltype(coordinates), decltype(shapes)>;
    const Loop loop{b, loop_level(view, {0.5 * (view.time_old + view.time_end), middle, 0.5}, b)};
    for (int e = 0; e < b.elements; ++e)
      loop.template for_each_point<false, true>(
          e, [&](int q, const typename Loop::Shape& s, const typename Loop::Fields& at) {
            const int row = e * b.points + q;
            double swell = 2 * at.hoop_moved;  // the level has half of the motion
            for (int i = 0; i < Loop::D; ++i) swell += 2 * at.moved[i][i];
            const double consolidation = points.figures(row).consolidation;
            volume(row, 0) = s.dv;
            strain(row, 0) = swell;
            for (int c = 0; c < Loop::NS; ++c) {
              const int node = b.nodes(e, c);
              to.lumped[node] += s.dv * s.Np[c];
              to.swell[node] += s.dv * s.Np[c] * swell;
              to.flow[node] += s.dv * consolidation * points.along_ratios(row, s.gp[c], s.gp[c], Loop::D);
            }
          });
  });
}

double at_point(const SoilBlock& b, int e, int q, const std::vector<double>& nodal) {
  double sum = 0;
  for (int c = 0; c < b.p.nodes; ++c) sum += b.p.N(q, c) * nodal[b.nodes(e, c)];
  return sum;
}

/// Calls f(row of the point, material, mass of the grains of that material which follows the volume strain [kg]) for
/// the points of a block. A point at the interface of two layers has a share of both, as in take_inventory().
template <class F>
void for_each_grain(const Soil& soil, const SoilBlock& b, const StepView& view, F&& f) {
  const ByMaterial<Mixture> mixture_of = mixtures_of(soil, b, *view.committed);
  const PointView void_ratio = view.trial->arrays[b.void_ratio];
  const std::size_t made_of = b.made_of.size();
  std::vector<double> shares(b.points, 1.0);
  with_moving_element(soil.geometry, b, [&](auto coordinates, auto shapes) {
    using Loop = ElementLoop<decltype(coordinates), decltype(shapes)>;
    const Loop loop{b, end_level(view, b)};
    for (int e = 0; e < b.elements; ++e) {
      if (made_of > 1) shares = soil.layer_shares(b, *view.committed, e);
      loop.template for_each_point<false, false>(
          e, [&](int q, const typename Loop::Shape& s, const typename Loop::Fields& at) {
            const int row = e * b.points + q;
            const Mixture& mixture = mixture_of(row);
            const double n = void_ratio(row, 0) / (1 + void_ratio(row, 0));
            double warmth = mixture.reference;
            if constexpr (Loop::S > 0)
              if (mixture.temperature >= 0) warmth = at.value[mixture.temperature];
            for (std::size_t k = 0; k < made_of; ++k)
              f(row, b.made_of[k],
                shares[q * made_of + k] * (mixture.alpha - n) * s.dv *
                    mixture_of.of(b.made_of[k]).grain_density_at(warmth));
          });
    }
  });
}

/// Mass of the grains of one material at a point which follows the volume strain there.
struct Grains {
  std::size_t block;
  int row, material, own;  // row of the point, and the material that it is of
  double mass;             // [kg]
};

std::vector<Grains> grains_of(const Soil& soil, const StepView& view) {
  std::vector<Grains> result;
  for (std::size_t k = 0; k < soil.blocks.size(); ++k) {
    const SoilBlock& b = soil.blocks[k];
    if (!b.sees_water) continue;
    const PointView which = soil.which(b, *view.committed);
    for_each_grain(soil, b, view, [&](int row, int material, double mass) {
      result.push_back({k, row, material, static_cast<int>(which(row, 0)), mass});
    });
  }
  return result;
}

CoordinateView middle_of(const StepView& view) {
  const CoordinateView x("middle of the step", view.x_old.extent(0), view.x_old.extent(1));
  for (std::size_t node = 0; node < x.extent(0); ++node)
    for (std::size_t i = 0; i < x.extent(1); ++i) x(node, i) = 0.5 * (view.x_old(node, i) + view.x_end(node, i));
  return x;
}

}  // namespace

double WaterDilatation::product(const Values& a, const Values& b) const {
  const Mesh& mesh = soil_.space->mesh();
  double here = 0;
  for (int i = 0; i < mesh.num_owned_nodes(); ++i) here += a[i] * b[i];
  return sum_over_ranks(*mesh.comm(), here);
}

WaterDilatation::Values WaterDilatation::project(const std::vector<PointView>& volume, const Values& lumped,
                                                 const Values& load) const {
  constexpr int most = 100;            // iterations; some 25 are needed
  constexpr double tolerance = 1e-24;  // of the square of the residual
  const std::size_t nodes = load.size();
  Values found(nodes), residual = load, direction(nodes), image(nodes), scaled(nodes);
  const auto scale = [&] {
    for (std::size_t i = 0; i < nodes; ++i) scaled[i] = lumped[i] > 0 ? residual[i] / lumped[i] : 0.0;
    return product(residual, scaled);
  };
  double square = scale();
  const double enough = tolerance * square;
  direction = scaled;
  for (int k = 0; k < most && square > enough; ++k) {
    image.assign(nodes, 0.0);
    for (std::size_t n = 0; n < volume.size(); ++n) {
      const SoilBlock& b = soil_.blocks[n];
      for (int e = 0; e < b.elements; ++e)
        for (int q = 0; q < b.points; ++q) {
          const double part = volume[n](e * b.points + q, 0) * at_point(b, e, q, direction);
          for (int c = 0; c < b.p.nodes; ++c) image[b.nodes(e, c)] += b.p.N(q, c) * part;
        }
    }
    exchange_.sum_shared(image);
    const double step = square / product(direction, image);
    for (std::size_t i = 0; i < nodes; ++i) {
      found[i] += step * direction[i];
      residual[i] -= step * image[i];
    }
    const double before = square;
    square = scale();
    for (std::size_t i = 0; i < nodes; ++i) direction[i] = scaled[i] + square / before * direction[i];
  }
  return found;
}

void WaterDilatation::keep_grains(const StepView& view, const std::vector<PointView>& shares,
                                  const std::vector<PointView>& beyond) const {
  constexpr int most = 5;              // steps of Newton's method; two are needed
  constexpr double tolerance = 1e-15;  // of the mass
  const int n = static_cast<int>(soil_.materials.size());
  const std::vector<Grains> grains = grains_of(soil_, view);
  std::vector<double> here(n * (n + 2));  // changes of mass, masses, derivatives of the changes
  for (int k = 0; k < most; ++k) {
    std::fill(here.begin(), here.end(), 0.0);
    for (const Grains& g : grains) {
      const double strain = beyond[g.block](g.row, 0);
      here[g.material] += g.mass * std::expm1(-strain);
      here[n + g.material] += g.mass;
      here[n * (2 + g.own) + g.material] -= g.mass * std::exp(-strain) * shares[g.block](g.row, 0);
    }
    std::vector<double> all = sum_over_ranks(*soil_.space->mesh().comm(), here);
    double* const change = all.data();
    double* const derivative = change + 2 * n;  // column by column
    bool enough = true;
    for (int m = 0; m < n; ++m) {
      enough = enough && std::abs(change[m]) <= tolerance * change[n + m];
      if (std::abs(derivative[n * m + m]) > 1e-6 * change[n + m]) continue;  // else its soil drains at once
      for (int other = 0; other < n; ++other) derivative[n * other + m] = other == m ? 1 : 0;
      change[m] = 0;
    }
    if (enough) return;
    std::vector<int> pivots(n);
    int problem = 0;
    Teuchos::LAPACK<int, double>().GESV(n, 1, derivative, n, pivots.data(), change, n, &problem);
    if (problem != 0) return;
    for (std::size_t i = 0; i < soil_.blocks.size(); ++i) {
      const SoilBlock& b = soil_.blocks[i];
      const PointView which = soil_.which(b, *view.committed);
      for (int row = 0; row < b.elements * b.points && b.sees_water; ++row)
        beyond[i](row, 0) -= change[static_cast<int>(which(row, 0))] * shares[i](row, 0);
    }
  }
}

std::vector<PointView> WaterDilatation::find(const StepView& view) const {
  const CoordinateView middle = middle_of(view);
  Moments m(middle.extent(0));
  for (const SoilBlock& b : soil_.blocks) add_moments(soil_, b, view, middle, m);
  for (Values* nodal : {&m.lumped, &m.swell, &m.flow}) exchange_.sum_shared(*nodal);
  Values undrained(m.lumped.size());
  for (std::size_t i = 0; i < undrained.size(); ++i)
    if (m.lumped[i] > 0) undrained[i] = m.lumped[i] / (m.lumped[i] + view.dt * m.flow[i]);
  const Values strain = project(m.volume, m.lumped, m.swell);
  std::vector<PointView> result, shares;
  for (const SoilBlock& b : soil_.blocks) {
    const std::size_t k = result.size();
    const PointView to("beyond the motion", b.elements * b.points, 1), share("share", b.elements * b.points, 1);
    result.push_back(to);
    shares.push_back(share);
    for (int e = 0; e < b.elements && b.sees_water; ++e)
      for (int q = 0; q < b.points; ++q) {
        const int row = e * b.points + q;
        share(row, 0) = at_point(b, e, q, undrained);
        to(row, 0) = share(row, 0) * (at_point(b, e, q, strain) - m.strain[k](row, 0));
      }
  }
  keep_grains(view, shares, result);
  return result;
}

}  // namespace mudline
