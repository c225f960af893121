#include "contact/parts/leaky_surface.hpp"

#include "framework/side_loop.hpp"

namespace mudline {

namespace {

struct Leak : SideLaw {
  static constexpr bool flows = true, drains = true;
  int points;                // of a side
  double conductance;        // [m/(Pa s)]
  ConstPointView outside;    // [Pa] by row
  Kokkos::View<char*> open;  // by side

  template <class C, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const SidePoint<C, T>& at, SideBalance<C, T>& out) const {
    out.flow = (open(row / points) ? conductance : 0.0) * at.area * (at.value - outside(row, 0));
  }
};

}  // namespace

LeakySurface::LeakySurface(const Space& space, const ContactSurface& surface, double conductance,
                           const Function& outside)
    : space_(space), surface_(surface), conductance_(conductance), outside_(outside) {
  const int field = space.find("pore pressure");
  for (CellShape shape : surface.shapes()) {
    std::vector<std::vector<int>> nodes;
    for (const SurfaceSide& side : surface.sides())
      if (side.shape == shape) nodes.emplace_back(side.node, side.node + side.count);
    const SideBlock block(space, field, shape, nodes, 5);
    parts_[shape] = {block, PointView("outside", block.sides * block.points, 1),
                     Kokkos::View<char*>("open", block.sides)};
  }
}

void LeakySurface::sparsity(Assembler& assembler) {
  for (auto& [shape, part] : parts_) part.block.group = assembler.add_group(part.block.dofs);
}

void LeakySurface::open(const std::vector<char>& flags) {
  for (std::size_t s = 0; s < flags.size(); ++s) {
    const SurfaceSide& side = surface_.sides()[s];
    parts_.at(side.shape).open(side.row) = flags[s];
  }
}

template <class F>
void LeakySurface::for_each_part(const StepView& view, F&& f) const {
  if (!view.flow) return;
  for (const auto& [shape, part] : parts_) {
    const SideBlock& b = part.block;
    for (int s = 0; s < b.sides; ++s) {
      if (!part.open(s)) continue;
      for (int q = 0; q < b.points; ++q)
        part.outside(s * b.points + q, 0) = outside_(view.balance.time, b.place(s, q, view.x_old));
    }
    f(b, side_level(view, b, view.x_old), Leak{{}, b.points, conductance_, part.outside, part.open});
  }
}

void LeakySurface::add(const StepView& view, const ResidualView& f) const {
  for_each_part(view, [&](const SideBlock& block, const SideLevel& level, const Leak& leak) {
    add_side_residual(space_.mesh().geometry(), block, level, leak, f);
  });
}

void LeakySurface::jacobian(const StepView& view, Assembler& assembler) const {
  for_each_part(view, [&](const SideBlock& block, const SideLevel& level, const Leak& leak) {
    add_side_tangent(space_.mesh().geometry(), block, level, leak, assembler.scatter(block.group), 1.0);
  });
}

}  // namespace mudline
