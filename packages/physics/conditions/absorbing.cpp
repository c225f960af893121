#include "physics/conditions/absorbing.hpp"

#include <cmath>

#include "framework/side_loop.hpp"
#include "physics/soil_points.hpp"

namespace mudline {

namespace {

struct Dashpots : SideLaw {
  static constexpr bool damps = true;
  int points;                // points per side
  ConstPointView impedance;  // (side, normal and tangential) [Pa s/m]

  template <class C, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const SidePoint<C, T>& at, SideBalance<C, T>& out) const {
    const double p = impedance(row / points, 0), s = impedance(row / points, 1);
    T through = T(0.0);  // area-weighted normal velocity
    for (int i = 0; i < C::dim; ++i) through += at.velocity[i] * at.normal[i];
    for (int i = 0; i < C::dim; ++i)
      out.force[i] = s * at.area * at.velocity[i] + (p - s) * (through / at.area) * at.normal[i];
  }
};

}  // namespace

void AbsorbingBoundary::parameters(Parameters& p) {
  declare_set(p);
  p.add("normal factor", normal_factor_, "-", non_negative(), "scales the normal dashpot rho c_p");
  p.add("tangential factor", tangential_factor_, "-", non_negative(), "scales the tangential dashpot rho c_s");
}

void AbsorbingBoundary::bind(const ConditionContext& context, const Section& section) {
  SideLoad::bind(context, section);
  soil_ = context.shared.find<Soil>();
  if (!soil_) section.fail("an absorbing boundary needs a physics with soil", "type");
  soil_->require_saturated(section, "type");
  for (const Part& part : parts_) impedance_.emplace_back("impedance", part.block.sides, 2);
}

void AbsorbingBoundary::begin(const StepView& view) {
  const std::vector<Side>& sides = space_->mesh().side_sets().at(set_);
  for (std::size_t p = 0; p < parts_.size(); ++p)
    for (int s = 0; s < parts_[p].block.sides; ++s) {
      const Side& side = sides[parts_[p].sides[s]];
      const SoilBlock& b = soil_->blocks[side.block];
      double m = 0, shear = 0, rho = 0;
      const SoilPoints points(*soil_, b, *view.committed);
      for (int q = 0; q < b.points; ++q) {
        const int row = side.element * b.points + q;
        const ElasticModuli moduli = points.moduli(row);
        const double storage = points.storage(row), alpha = points.material(row).biot_coefficient;
        m += (moduli.bulk + 4.0 / 3 * moduli.shear + (b.porous() && storage > 0 ? alpha * alpha / storage : 0.0)) /
             b.points;
        shear += moduli.shear / b.points;
        rho += points.density(row) / b.points;
      }
      impedance_[p](s, 0) = normal_factor_ * std::sqrt(rho * m);
      impedance_[p](s, 1) = tangential_factor_ * std::sqrt(rho * shear);
    }
}

int AbsorbingBoundary::residual(const StepView& view, const ResidualView& f) {
  const std::size_t acting = view.inertia ? parts_.size() : 0;
  for (std::size_t p = 0; p < acting; ++p) {
    const SideBlock& block = parts_[p].block;
    add_side_residual(geometry(), block, side_level(view, block, view.x_old), Dashpots{{}, block.points, impedance_[p]},
                      f);
  }
  held_.add(view, f);
  return 0;
}

void AbsorbingBoundary::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const std::size_t acting = view.inertia ? parts_.size() : 0;
  for (std::size_t p = 0; p < acting; ++p) {
    const SideBlock& block = parts_[p].block;
    add_side_tangent(geometry(), block, side_level(view, block, view.x_old), Dashpots{{}, block.points, impedance_[p]},
                     assembler.scatter(block.group), weight);
  }
}

}  // namespace mudline
