#include "physics/conditions/absorbing.hpp"

#include <cmath>

#include "framework/dof_ids.hpp"

namespace mudline {

void AbsorbingBoundary::parameters(Parameters& p) {
  declare_set(p);
  p.add("normal factor", normal_factor_, "-", non_negative(), "scales the normal dashpot rho c_p");
  p.add("tangential factor", tangential_factor_, "-", non_negative(), "scales the tangential dashpot rho c_s");
}

void AbsorbingBoundary::bind(const ConditionContext& context, const Section& section) {
  SideLoad::bind(context, section);
  soil_ = context.shared.find<Soil>();
  if (!soil_) section.fail("an absorbing boundary needs a physics with soil", "type");
  const int owned = space_->dofs()->num_owned_dofs();
  for (int node : space_->mesh().nodes_of_set(set_))
    for (int i = 0; i < 2; ++i) {
      const int dof = space_->node_dof(field_)(node) + i;
      if (dof < owned) held_dofs_.push_back(dof);
    }
}

void AbsorbingBoundary::declare_state(StateStore& store) {
  store_ = &store;
  ArrayInfo info{"absorbing/" + Condition::name, {{"held force", 1, "N"}}};
  const std::vector<long long> ids = dof_ids(*space_->dofs());
  for (int dof : held_dofs_) info.ids.push_back(ids[dof]);
  held_ = store.declare(std::move(info), static_cast<int>(held_dofs_.size()));
}

void AbsorbingBoundary::activate(const State& committed, const NodalView& unbalanced) {
  // The held force balances what the soil exerts on the boundary at this instant, and nobody else holds yet.
  for (std::size_t i = 0; i < held_dofs_.size(); ++i) {
    store_->committed().arrays[held_](i, 0) = -unbalanced(held_dofs_[i]);
    unbalanced(held_dofs_[i]) = 0;
  }
}

void AbsorbingBoundary::begin(const StepView& view) {
  impedance_p_.assign(sides_.size(), 0);
  impedance_s_.assign(sides_.size(), 0);
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    const SoilBlock& b = soil_->blocks[sides_[s].block];
    double m = 0, shear = 0, rho = 0;
    for (int q = 0; q < b.points; ++q) {
      const int row = sides_[s].element * b.points + q;
      const double e = view.committed->arrays[b.void_ratio](row, 0), n = e / (1 + e);
      const ElasticModuli moduli = b.material->skeleton->moduli(&view.committed->arrays[b.stress](row, 0), e,
                                                                &view.committed->arrays[b.law](row, 0));
      const double storage = b.material->storage(n), alpha = b.material->biot_coefficient;
      m += (moduli.bulk + 4.0 / 3 * moduli.shear + (b.porous() && storage > 0 ? alpha * alpha / storage : 0.0)) /
           b.points;
      shear += moduli.shear / b.points;
      rho += b.material->density(n) / b.points;
    }
    impedance_p_[s] = normal_factor_ * std::sqrt(rho * m);
    impedance_s_[s] = tangential_factor_ * std::sqrt(rho * shear);
  }
}

void AbsorbingBoundary::side_matrix(int s, const ConstCoordinateView& x, double (&c)[6][6]) const {
  const LoadedSide& side = sides_[s];
  for_each_point(side, x, [&](const SidePoint& p) {
    const double ds = std::hypot(p.tangent[0], p.tangent[1]);
    const double n[2] = {p.tangent[1] / ds, -p.tangent[0] / ds};
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const double normal = n[i] * n[j];
        const double d = (impedance_p_[s] * normal + impedance_s_[s] * ((i == j ? 1 : 0) - normal)) * ds * p.weight;
        for (std::size_t a = 0; a < side.nodes.size(); ++a)
          for (std::size_t b = 0; b < side.nodes.size(); ++b) c[2 * a + i][2 * b + j] += p.N[a] * p.N[b] * d;
      }
  });
}

int AbsorbingBoundary::residual(const StepView& view, const ResidualView& f) {
  if (view.inertia)
    for (std::size_t s = 0; s < sides_.size(); ++s) {
      double c[6][6] = {{0}};
      side_matrix(static_cast<int>(s), view.x_old, c);
      for (std::size_t a = 0; a < dofs_.extent(1); ++a) {
        double force = 0;
        for (std::size_t b = 0; b < dofs_.extent(1); ++b) force += c[a][b] * view.velocity(dofs_(s, b));
        f.add(dofs_(s, a), force);
      }
    }
  for (std::size_t i = 0; i < held_dofs_.size(); ++i) f.add(held_dofs_[i], view.committed->arrays[held_](i, 0), 0);
  return 0;
}

void AbsorbingBoundary::jacobian(const StepView& view, Assembler& assembler, double weight) {
  if (!view.inertia) return;
  const MatrixScatter to = assembler.scatter(group_);
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    double c[6][6] = {{0}};
    side_matrix(static_cast<int>(s), view.x_old, c);
    scatter(to, static_cast<int>(s), c, weight * view.sensitivity[field_].velocity);
  }
}

}  // namespace mudline
