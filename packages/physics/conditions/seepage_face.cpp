#include "physics/conditions/seepage_face.hpp"

#include "algebra/over_ranks.hpp"
#include "discretisation/element_map.hpp"
#include "framework/side_loop.hpp"
#include "physics/soil_points.hpp"

namespace mudline {

namespace {

struct OneWay : SideLaw {
  static constexpr bool flows = true, drains = true;
  ConstPointView conductance;

  template <class C, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const SidePoint<C, T>& at, SideBalance<C, T>& out) const {
    out.flow = value(at.value) > 0 ? conductance(row, 0) * at.area * at.value : T(0.0);
  }
};

}  // namespace

void SeepageFace::parameters(Parameters& p) {
  declare_set(p);
  p.add("conductance", factor_, "-", positive(),
        "of the surface over that of the cell behind it; the larger, the closer the pressure comes to zero where water "
        "leaves");
}

void SeepageFace::bind(const ConditionContext& context, const Section& section) {
  SideLoad::bind(context, section);
  soil_ = context.shared.find<Soil>();
  if (!soil_ || soil_->temperature >= 0) section.fail("a seepage face is for the pore water of 'biot'", "type");
  if (soil_->excess)
    section.fail(
        "pore pressures are in excess of water at rest, and water meets no air; allowed with 'pore pressure' "
        "= total of the physics",
        "type");
}

void SeepageFace::begin(const StepView& view) {
  const std::vector<Side>& sides = space_->mesh().side_sets().at(set_);
  for (const Part& part : parts_)
    for (int s = 0; s < part.block.sides; ++s) {
      const Side& side = sides[part.sides[s]];
      const SoilBlock& b = soil_->blocks[side.block];
      const SoilPoints points(*soil_, b, *view.committed);
      double mobility = 0;
      for (int q = 0; q < b.points; ++q) mobility += points.mobility(side.element * b.points + q) / b.points;
      const ElementMap cell(b.shape, [&](int a) { return &view.x_old(b.nodes(side.element, a), 0); });
      for (int q = 0; q < part.block.points; ++q)
        part.load(s * part.block.points + q, 0) = factor_ * mobility / cell.size().height;
    }
}

int SeepageFace::residual(const StepView& view, const ResidualView& f) {
  const std::size_t acting = view.flow ? parts_.size() : 0;
  for (std::size_t k = 0; k < acting; ++k)
    add_side_residual(geometry(), parts_[k].block, side_level(view, parts_[k].block, view.x_old),
                      OneWay{{}, parts_[k].load}, f);
  return 0;
}

void SeepageFace::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const std::size_t acting = view.flow ? parts_.size() : 0;
  for (std::size_t k = 0; k < acting; ++k)
    add_side_tangent(geometry(), parts_[k].block, side_level(view, parts_[k].block, view.x_old),
                     OneWay{{}, parts_[k].load}, assembler.scatter(parts_[k].block.group), weight);
}

void SeepageFace::histories(const StepView& view, Report& report) {
  const NodalView flows("discharge", space_->dofs()->num_overlap_dofs());
  residual(view, ResidualView(flows));
  double here = 0;
  for (std::size_t i = 0; i < flows.extent(0); ++i) here += flows(i);
  report["discharge/" + Condition::name] = {"m3/s", sum_over_ranks(*space_->dofs()->comm(), here)};
}

}  // namespace mudline
