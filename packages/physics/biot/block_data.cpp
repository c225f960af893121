#include "physics/biot/block_data.hpp"

#include <algorithm>
#include <cmath>

#include "algebra/over_ranks.hpp"
#include "discretisation/element_map.hpp"
#include "framework/element_loop.hpp"
#include "physics/mixture.hpp"
#include "physics/soil_points.hpp"

namespace mudline {

namespace {

/// Parents of the nodes that are no cell corners: the corners of which such a node is the centre.
std::vector<std::vector<GlobalOrdinal>> node_parents(const Soil& soil) {
  const Mesh& mesh = soil.space->mesh();
  std::vector<std::vector<GlobalOrdinal>> parents(mesh.num_owned_nodes());
  for (const SoilBlock& b : soil.blocks) {
    if (order(b.shape) == 1) continue;
    const int corners = num_corners(b.shape);
    std::vector<std::vector<int>> around;
    for (int a = 0; a < b.u.nodes; ++a) around.push_back(corners_around(b.shape, a));
    for (int e = 0; e < b.elements; ++e)
      for (int a = corners; a < b.u.nodes; ++a) {
        const int node = b.nodes(e, a);
        if (node >= mesh.num_owned_nodes() || !parents[node].empty()) continue;
        for (int c : around[a]) parents[node].push_back(mesh.node_ids()[b.nodes(e, c)]);
      }
  }
  return parents;
}

/// `sums`: this rank's, for volume means: volume, constrained modulus, drained modulus, density, 1/Q, kappa.
template <class Loop>
void add_block(const Soil& soil, const SoilBlock& b, const StepView& view, const Loop& loop, std::vector<double>& sums,
               CrsMatrix* mass, CrsMatrix* laplacian) {
  constexpr int NP = Loop::NS;
  constexpr double sideways =
      Loop::D == 2 ? 1.0 / 3 : 0.0;  // the drained modulus where the soil yields in every direction
  const RCP<const Map>& overlap = soil.space->dofs()->overlap();
  const SoilPoints points(soil, b, *view.committed);
  const int pressure = place_of_scalar(b, soil.pressure);
  const auto open = [&](int e, int c) {
    return view.open.extent(0) > 0 && view.open(b.dofs(e, Loop::D * Loop::NU + c)) != 0;
  };
  for (int e = 0; e < b.elements; ++e) {
    double q_e[Loop::NQ][Loop::NQ] = {}, l_e[Loop::NQ][Loop::NQ] = {};
    loop.template for_each_point<false, true>(
        e, [&](int q, const typename Loop::Shape& s, const typename Loop::Fields& at) {
          const int row = e * b.points + q;
          const ElasticModuli m = points.moduli(row);
          double mobility = b.porous() ? points.mobility(row) : 0.0, storage = points.storage(row);
          if constexpr (Loop::S > 0)
            if (const Retention& retention = points.material(row).retention; retention.acts()) {
              const double p = at.value[pressure];
              mobility *= retention.relative_permeability(p);
              storage += points.porosity(row) * retention.saturation(Dual<1>(p, 0)).d[0];
            }
          const double values[6] = {
              1, m.bulk + 4.0 / 3 * m.shear, m.bulk + sideways * m.shear, points.density(row), storage, mobility};
          for (int i = 0; i < 6; ++i) sums[i] += s.dv * values[i];
          const double compliance = values[1] > 0 ? 1 / values[1] : 0.0;
          for (int c = 0; c < NP; ++c)
            for (int d = 0; d < NP; ++d) {
              q_e[c][d] += s.dv * compliance * s.Np[c] * s.Np[d];
              if (c == d || !(open(e, c) || open(e, d)))
                l_e[c][d] += s.dv * points.along_ratios(row, s.gp[c], s.gp[d], Loop::D);
            }
        });
    if constexpr (NP > 0) {
      GlobalOrdinal ids[NP];
      for (int c = 0; c < NP; ++c) ids[c] = overlap->getGlobalElement(b.dofs(e, Loop::D * Loop::NU + c));
      for (int c = 0; c < NP; ++c) {
        mass->insertGlobalValues(ids[c], NP, q_e[c], ids);
        laplacian->insertGlobalValues(ids[c], NP, l_e[c], ids);
      }
    }
  }
}

/// Largest aspect ratio (longest edge over height) of this rank's elements, relative to the equilateral element [-].
double worst_aspect_ratio(const Soil& soil, const StepView& view) {
  double worst = 1;
  for (const SoilBlock& b : soil.blocks) {
    double largest = mudline::equilateral(side_shape(b.shape, 0));  // of its sides, as a factor
    for (int s = 1; s < num_sides(b.shape); ++s)
      largest = std::min(largest, mudline::equilateral(side_shape(b.shape, s)));
    const double equilateral = mudline::equilateral(b.shape) / largest;
    for (int e = 0; e < b.elements; ++e) {
      const ElementMap element(b.shape, [&](int a) { return &view.x_end(b.nodes(e, a), 0); });
      const ElementSize size = element.size();
      worst = std::max(worst, size.longest_edge / (size.height * equilateral));
    }
  }
  return worst;
}

/// An empty matrix on the pressure map with room for each pair of neighbours.
RCP<CrsMatrix> pressure_matrix(const Soil& soil) {
  const DofMap& dofs = *soil.space->dofs();
  const int begin = dofs.owned_begin(soil.pressure), end = dofs.owned_end(soil.pressure);
  std::vector<std::vector<int>> neighbours(end - begin);
  for (const SoilBlock& b : soil.blocks) {
    const int first = b.u.nodes * soil.space->mesh().dimension(), end_column = first + b.p.nodes;
    for (int e = 0; e < b.elements; ++e)
      for (int c = first; c < end_column; ++c) {
        const int row = b.dofs(e, c) - begin;
        if (row < 0 || row >= end - begin) continue;
        for (int d = first; d < end_column; ++d) neighbours[row].push_back(b.dofs(e, d));
      }
  }
  std::vector<std::size_t> counts;
  for (std::vector<int>& row : neighbours) {
    std::sort(row.begin(), row.end());
    counts.push_back(std::unique(row.begin(), row.end()) - row.begin());
  }
  return rcp(new CrsMatrix(dofs.field_map(soil.pressure), Teuchos::arrayViewFromVector(counts)));
}

}  // namespace

BlockData soil_block_data(const Soil& soil, const StepView& view, Kokkos::View<const char*> constrained) {
  BlockData data;
  const Space& space = *soil.space;
  const DofMap& dofs = *space.dofs();
  data.displacement = soil.displacement;
  data.pressure = soil.pressure;
  for (int node = 0; node < space.mesh().num_owned_nodes(); ++node)
    for (int i = 0; i < space.mesh().dimension(); ++i) data.coordinates.push_back(view.x_end(node, i));
  data.parents = node_parents(soil);
  RCP<CrsMatrix> mass, laplacian;
  if (soil.pressure >= 0) {
    mass = pressure_matrix(soil);
    laplacian = pressure_matrix(soil);
    for (int i = dofs.owned_begin(soil.pressure); i < dofs.owned_end(soil.pressure); ++i)
      data.pressure_constrained.push_back(constrained(i));
  }
  std::vector<double> sums(6, 0.0);
  for (const SoilBlock& b : soil.blocks) {
    const LoopLevel level = loop_level(view, {view.time_end, view.x_end, 0.0}, b);
    with_element<1>(soil.geometry, b, [&](auto coordinates, auto shapes) {
      const ElementLoop<decltype(coordinates), decltype(shapes)> loop{b, level};
      add_block(soil, b, view, loop, sums, mass.get(), laplacian.get());
    });
  }
  data.aspect_ratio = max_over_ranks(*dofs.comm(), worst_aspect_ratio(soil, view));
  std::vector<double> mean = sum_over_ranks(*dofs.comm(), sums);
  for (int i = 1; i < 6; ++i) mean[i] /= mean[0];
  if (!mass.is_null()) {
    mass->fillComplete();
    mass->resumeFill();  // a matrix can be scaled only when its fill is complete
    mass->scale(mean[1]);
    mass->fillComplete();
    laplacian->fillComplete();
    data.pressure_mass = mass;
    data.pressure_laplacian = laplacian;
  }
  // Coefficients of the Jacobian: see StepView; history terms enter with the weight of the new level, which for the
  // integrators here is the sensitivity of the alpha-level displacement.
  const Sensitivity& u = view.sensitivity[soil.displacement];
  const double alpha = soil.blocks.empty() ? 1.0 : soil.any_of(soil.blocks.front()).biot_coefficient;
  data.constrained_modulus = u.value * mean[1];
  data.drained_modulus = u.value * mean[2];
  data.inertia = view.inertia ? u.acceleration * mean[3] : 0.0;
  data.coupling_u = u.value * alpha;
  data.coupling_p = u.rate * alpha;
  if (soil.pressure >= 0) {
    data.storage = view.sensitivity[soil.pressure].rate * mean[4];
    data.conduction = view.sensitivity[soil.pressure].value * mean[5];
  }
  return data;
}

}  // namespace mudline
