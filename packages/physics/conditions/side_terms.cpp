#include "physics/conditions/side_terms.hpp"

#include <cmath>
#include <map>

#include "discretisation/mesh_topology.hpp"
#include "framework/side_loop.hpp"
#include "physics/conditions/prescribed.hpp"

namespace mudline {

namespace {

struct FixedTraction : SideLaw {
  static constexpr bool moves = true;
  ConstPointView load;

  template <class C, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const SidePoint<C, T>& at, SideBalance<C, T>& out) const {
    for (int i = 0; i < C::dim; ++i) {
      out.force[i] = -load(row, i) * at.area;
      out.standing[i] = -load(row, C::dim + i) * value(at.area);
    }
  }
};

struct FollowingPressure : SideLaw {
  static constexpr bool moves = true;
  ConstPointView load;

  template <class C, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const SidePoint<C, T>& at, SideBalance<C, T>& out) const {
    T pressure = T(load(row, 0));
    for (int i = 0; i < C::dim; ++i) pressure += load(row, 2 + i) * (at.x[i] - value(at.x[i]));
    for (int i = 0; i < C::dim; ++i) {
      out.force[i] = pressure * at.normal[i];
      out.standing[i] = load(row, 1) * value(at.normal[i]);
    }
  }
};

struct Outflow : SideLaw {
  static constexpr bool flows = true;
  ConstPointView load;

  template <class C, class T>
  KOKKOS_INLINE_FUNCTION void operator()(int row, const SidePoint<C, T>& at, SideBalance<C, T>& out) const {
    out.flow = load(row, 0) * at.area;
  }
};

}  // namespace

void SideLoad::declare_set(Parameters& p) { p.required("set", set_, "side set on which it acts"); }

void SideLoad::bind(const ConditionContext& context, const Section& section) {
  space_ = &context.space;
  const int field = conditioned_field(*space_, section, field_name());
  const Mesh& mesh = space_->mesh();
  require_boundary(mesh, section, "set", set_);
  const std::vector<Side>& sides = mesh.side_sets().at(set_);
  parts_.clear();
  std::map<CellShape, std::vector<int>> of_shape;
  for (std::size_t s = 0; s < sides.size(); ++s)
    of_shape[side_shape(mesh.blocks()[sides[s].block].shape, sides[s].side)].push_back(static_cast<int>(s));
  for (auto& [shape, own] : of_shape) {
    std::vector<std::vector<int>> nodes;
    for (const int s : own) {
      const ElementBlock& block = mesh.blocks()[sides[s].block];
      nodes.emplace_back();
      for (int local : side_nodes(block.shape, sides[s].side))
        nodes.back().push_back(block.nodes(sides[s].element, local));
    }
    const SideBlock block(*space_, field, shape, nodes, 5);
    parts_.push_back({block, PointView("load", block.sides * block.points, columns()), std::move(own)});
  }
}

void SideLoad::tabulate(const Function& function, double time, const ConstCoordinateView& x, int column) const {
  for (const Part& part : parts_)
    for (int s = 0; s < part.block.sides; ++s)
      for (int q = 0; q < part.block.points; ++q)
        part.load(s * part.block.points + q, column) = function(time, part.block.place(s, q, x));
}

void Traction::parameters(Parameters& p) {
  declare_set(p);
  const char* words[] = {"x (r)", "y (z)", "z, in space"};
  for (int i = 0; i < p.dimension(); ++i)
    p.add(axis_names[i], component_[i], "Pa", std::string("force per current area in direction ") + words[i]);
}

void Traction::tabulate_components(const StepView& view) const {
  for (int i = 0; i < dimension(); ++i) {
    tabulate(component_[i], view.momentum.time, initial(), i);
    tabulate(component_[i], view.time_old, initial(), dimension() + i);
  }
}

int Traction::residual(const StepView& view, const ResidualView& f) {
  tabulate_components(view);
  for (const auto& [block, load, sides] : parts_)
    add_side_residual(geometry(), block, side_level(view, block, view.momentum.x), FixedTraction{{}, load}, f);
  return 0;
}

void Traction::jacobian(const StepView& view, Assembler& assembler, double weight) {
  tabulate_components(view);
  for (const auto& [block, load, sides] : parts_)
    add_side_tangent(geometry(), block, side_level(view, block, view.momentum.x, view.momentum.geometry_weight),
                     FixedTraction{{}, load}, assembler.scatter(block.group), weight);
}

void SurfacePressure::parameters(Parameters& p) {
  declare_set(p);
  p.required("value", value_, "Pa",
             "pressure on the current surface, positive against the body; a function of time and position");
  p.choice("position", position_, {{"initial", Position::initial}, {"present", Position::present}},
           "where a point is for the function: where it stood in the mesh as it was made, or where it is now");
}

void SurfacePressure::tabulate_values(const StepView& view) const {
  const ConstCoordinateView x = position_ == Position::present ? view.momentum.x : initial();
  tabulate(value_, view.momentum.time, x, 0);
  tabulate(value_, view.time_old, x, 1);
}

void SurfacePressure::tabulate_gradient(const StepView& view) const {
  if (position_ == Position::initial || value_.is_constant()) return;  // the gradient stays 0
  const ConstCoordinateView& x = view.momentum.x;
  for (const auto& [block, load, sides] : parts_)
    for (int s = 0; s < block.sides; ++s) {
      double square = 0;  // square of the distance between two corners
      for (int i = 0; i < dimension(); ++i) square += std::pow(x(block.nodes(s, 1), i) - x(block.nodes(s, 0), i), 2);
      const double h = 5e-7 * std::sqrt(square);
      for (int q = 0; q < block.points; ++q)
        for (int i = 0; i < dimension(); ++i) {
          Point low = block.place(s, q, x), high = low;
          low[i] -= h;
          high[i] += h;
          load(s * block.points + q, 2 + i) =
              (value_(view.momentum.time, high) - value_(view.momentum.time, low)) / (2 * h);
        }
    }
}

int SurfacePressure::residual(const StepView& view, const ResidualView& f) {
  tabulate_values(view);
  for (const auto& [block, load, sides] : parts_)
    add_side_residual(geometry(), block, side_level(view, block, view.momentum.x), FollowingPressure{{}, load}, f);
  return 0;
}

void SurfacePressure::jacobian(const StepView& view, Assembler& assembler, double weight) {
  tabulate_values(view);
  tabulate_gradient(view);
  for (const auto& [block, load, sides] : parts_)
    add_side_tangent(geometry(), block, side_level(view, block, view.momentum.x, view.momentum.geometry_weight),
                     FollowingPressure{{}, load}, assembler.scatter(block.group), weight);
}

void NormalFlux::parameters(Parameters& p) {
  declare_set(p);
  p.add("field", name_, "scalar field whose flux is prescribed");
  p.required("value", value_, "m/s",
             "outward flux per initial area (discharge of pore water; heat flux density of a temperature)");
}

// The flux is measured per initial area: the discharge through a surface does not change because the surface is
// stretched.
int NormalFlux::residual(const StepView& view, const ResidualView& f) {
  tabulate(value_, view.balance.time, initial(), 0);
  for (const auto& [block, load, sides] : parts_)
    add_side_residual(geometry(), block, side_level(view, block, initial()), Outflow{{}, load}, f);
  return 0;
}

}  // namespace mudline
