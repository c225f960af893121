#include "physics/conditions/side_terms.hpp"

#include <cmath>

#include "discretisation/mesh_topology.hpp"
#include "framework/side_loop.hpp"

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
  const int field = space_->find(field_name());
  if (field < 0 || space_->field(field).support == Support::apart)
    section.fail("this model has no field '" + field_name() + "'" + suggestion(field_name(), space_->mesh_fields()),
                 "type");
  const Mesh& mesh = space_->mesh();
  require_boundary(mesh, section, "set", set_);
  std::vector<std::vector<int>> nodes;
  CellShape shape = CellShape::line2;  // for a rank without sides, where the shape does not matter
  for (const Side& side : mesh.side_sets().at(set_)) {
    const ElementBlock& block = mesh.blocks()[side.block];
    shape = side_shape(block.shape);
    nodes.emplace_back();
    for (int local : side_nodes(block.shape, side.side)) nodes.back().push_back(block.nodes(side.element, local));
  }
  block_ = SideBlock(*space_, field, shape, nodes, 5);
  load_ = PointView("load", block_.sides * block_.points, columns());
}

void SideLoad::tabulate(const Function& function, double time, const ConstCoordinateView& x, int column) const {
  for (int s = 0; s < block_.sides; ++s)
    for (int q = 0; q < block_.points; ++q)
      load_(s * block_.points + q, column) = function(time, block_.place(s, q, x));
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
  add_side_residual(geometry(), block_, side_level(view, block_, view.momentum.x), FixedTraction{{}, load_}, f);
  return 0;
}

void Traction::jacobian(const StepView& view, Assembler& assembler, double weight) {
  tabulate_components(view);
  add_side_tangent(geometry(), block_, side_level(view, block_, view.momentum.x, view.momentum.geometry_weight),
                   FixedTraction{{}, load_}, assembler.scatter(block_.group), weight);
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
  for (int s = 0; s < block_.sides; ++s) {
    double square = 0;  // square of the distance between two corners
    for (int i = 0; i < dimension(); ++i) square += std::pow(x(block_.nodes(s, 1), i) - x(block_.nodes(s, 0), i), 2);
    const double h = 5e-7 * std::sqrt(square);
    for (int q = 0; q < block_.points; ++q)
      for (int i = 0; i < dimension(); ++i) {
        Point low = block_.place(s, q, x), high = low;
        low[i] -= h;
        high[i] += h;
        load_(s * block_.points + q, 2 + i) =
            (value_(view.momentum.time, high) - value_(view.momentum.time, low)) / (2 * h);
      }
  }
}

int SurfacePressure::residual(const StepView& view, const ResidualView& f) {
  tabulate_values(view);
  add_side_residual(geometry(), block_, side_level(view, block_, view.momentum.x), FollowingPressure{{}, load_}, f);
  return 0;
}

void SurfacePressure::jacobian(const StepView& view, Assembler& assembler, double weight) {
  tabulate_values(view);
  tabulate_gradient(view);
  add_side_tangent(geometry(), block_, side_level(view, block_, view.momentum.x, view.momentum.geometry_weight),
                   FollowingPressure{{}, load_}, assembler.scatter(block_.group), weight);
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
  add_side_residual(geometry(), block_, side_level(view, block_, initial()), Outflow{{}, load_}, f);
  return 0;
}

}  // namespace mudline
