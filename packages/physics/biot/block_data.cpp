#include "physics/biot/block_data.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <cmath>

#include "physics/element.hpp"

namespace mudline {

namespace {

/// Parents of the nodes that are no cell corners: the two ends of an edge, the four corners of a quad9's centre.
std::vector<std::vector<GlobalOrdinal>> node_parents(const Soil& soil) {
  const Mesh& mesh = soil.space->mesh();
  std::vector<std::vector<GlobalOrdinal>> parents(mesh.num_owned_nodes());
  for (const SoilBlock& b : soil.blocks) {
    if (order(b.shape) == 1) continue;
    const int corners = num_corners(b.shape);
    for (int e = 0; e < b.elements; ++e)
      for (int a = corners; a < b.u.nodes; ++a) {
        const int node = b.nodes(e, a);
        if (node >= mesh.num_owned_nodes() || !parents[node].empty()) continue;
        if (a < 2 * corners)
          parents[node] = {mesh.node_ids()[b.nodes(e, a - corners)],
                           mesh.node_ids()[b.nodes(e, (a - corners + 1) % corners)]};
        else
          for (int c = 0; c < corners; ++c) parents[node].push_back(mesh.node_ids()[b.nodes(e, c)]);
      }
  }
  return parents;
}

/// Volume means of the coefficients, this rank's sums: volume, constrained modulus, drained modulus, density, 1/Q,
/// kappa.
struct Means {
  double sum[6] = {0, 0, 0, 0, 0, 0};
};

template <int NU, int NP>
void add_block(const Soil& soil, const SoilBlock& b, const StepView& view, Means& means, CrsMatrix* mass,
               CrsMatrix* laplacian) {
  const RCP<const Map>& overlap = soil.space->dofs()->overlap();
  for (int e = 0; e < b.elements; ++e) {
    double x[NU][2], q_e[NP > 0 ? NP : 1][NP > 0 ? NP : 1] = {{0}}, l_e[NP > 0 ? NP : 1][NP > 0 ? NP : 1] = {{0}};
    gather<NU>(b.nodes, e, view.x_end, x);
    for (int q = 0; q < b.points; ++q) {
      PointGeometry<NU> at;
      at.compute(x, &b.u.dN(q, 0, 0), &b.u.N(q, 0), soil.axisymmetric);
      const double dv = at.volume(b.u.weights(q));
      const int row = e * b.points + q;
      const double void_ratio = view.committed->arrays[b.void_ratio](row, 0), n = void_ratio / (1 + void_ratio);
      const ElasticModuli m = b.material->skeleton->moduli(
          &view.committed->arrays[b.stress](row, 0), void_ratio,
          view.committed->arrays[b.law].data() + row * view.committed->arrays[b.law].extent(1));
      const double mobility =
          b.porous()
              ? b.material->permeability->conductivity(void_ratio, view.committed->arrays[b.void_ratio](row, 1)).k /
                    b.material->fluid->unit_weight()
              : 0.0;
      const double values[6] = {
          1,       m.bulk + 4.0 / 3 * m.shear, m.bulk + m.shear / 3, b.material->density(n), b.material->storage(n),
          mobility};
      for (int i = 0; i < 6; ++i) means.sum[i] += dv * values[i];
      if constexpr (NP > 0) {
        double j[2][2] = {{0, 0}, {0, 0}}, gp[NP][2];
        for (int a = 0; a < NU; ++a)
          for (int i = 0; i < 2; ++i)
            for (int k = 0; k < 2; ++k) j[i][k] += x[a][i] * b.u.dN(q, a, k);
        for (int c = 0; c < NP; ++c) {
          gp[c][0] = (j[1][1] * b.p.dN(q, c, 0) - j[1][0] * b.p.dN(q, c, 1)) / at.det;
          gp[c][1] = (-j[0][1] * b.p.dN(q, c, 0) + j[0][0] * b.p.dN(q, c, 1)) / at.det;
        }
        for (int c = 0; c < NP; ++c)
          for (int d = 0; d < NP; ++d) {
            q_e[c][d] += dv * b.p.N(q, c) * b.p.N(q, d);
            l_e[c][d] += dv * (gp[c][0] * gp[d][0] + gp[c][1] * gp[d][1]);
          }
      }
    }
    if constexpr (NP > 0) {
      GlobalOrdinal ids[NP];
      for (int c = 0; c < NP; ++c) ids[c] = overlap->getGlobalElement(b.dofs(e, 2 * NU + c));
      for (int c = 0; c < NP; ++c) {
        mass->insertGlobalValues(ids[c], NP, q_e[c], ids);
        laplacian->insertGlobalValues(ids[c], NP, l_e[c], ids);
      }
    }
  }
}

}  // namespace

BlockData soil_block_data(const Soil& soil, const StepView& view, Kokkos::View<const char*> constrained) {
  BlockData data;
  const Space& space = *soil.space;
  const DofMap& dofs = *space.dofs();
  data.displacement = soil.displacement;
  data.pressure = soil.pressure;
  for (int node = 0; node < space.mesh().num_owned_nodes(); ++node)
    for (int i = 0; i < 2; ++i) data.coordinates.push_back(view.x_end(node, i));
  data.parents = node_parents(soil);
  RCP<CrsMatrix> mass, laplacian;
  if (soil.pressure >= 0) {
    mass = rcp(new CrsMatrix(dofs.field_map(soil.pressure), 16));
    laplacian = rcp(new CrsMatrix(dofs.field_map(soil.pressure), 16));
    for (int i = dofs.owned_begin(soil.pressure); i < dofs.owned_end(soil.pressure); ++i)
      data.pressure_constrained.push_back(constrained(i));
  }
  Means means;
  for (const SoilBlock& b : soil.blocks)
    dispatch_pair(b.shape, b.porous(), [&](auto pair) {
      add_block<decltype(pair)::NU, decltype(pair)::NP>(soil, b, view, means, mass.get(), laplacian.get());
    });
  if (!mass.is_null()) {
    mass->fillComplete();
    laplacian->fillComplete();
    data.pressure_mass = mass;
    data.pressure_laplacian = laplacian;
  }
  double total[6];
  Teuchos::reduceAll(*dofs.comm(), Teuchos::REDUCE_SUM, 6, means.sum, total);
  for (int i = 1; i < 6; ++i) total[i] /= total[0];
  // Coefficients of the Jacobian: see StepView; history terms enter with the weight of the new level, which for the
  // integrators here is the sensitivity of the alpha-level displacement.
  const Sensitivity& u = view.sensitivity[soil.displacement];
  const double alpha = soil.blocks.empty() ? 1.0 : soil.blocks.front().material->biot_coefficient;
  data.constrained_modulus = u.value * total[1];
  data.drained_modulus = u.value * total[2];
  data.inertia = view.inertia ? u.acceleration * total[3] : 0.0;
  data.coupling_u = u.value * alpha;
  data.coupling_p = u.rate * alpha;
  if (soil.pressure >= 0) {
    data.storage = view.sensitivity[soil.pressure].rate * total[4];
    data.conduction = view.sensitivity[soil.pressure].value * total[5];
  }
  return data;
}

}  // namespace mudline
