#include "physics/conditions/side_terms.hpp"
#include "core/pi.hpp"
#include "discretisation/mesh_topology.hpp"

#include <cmath>

namespace mudline {

void SideLoad::declare_set(Parameters& p) { p.required("set", set_, "side set on which it acts"); }

int SideLoad::side_dofs(const LoadedSide& side) const {
  const Field& field = space_->field(field_);
  const int nodes = field.support == Support::all_nodes ? static_cast<int>(side.nodes.size()) : 2;
  return nodes * field.components;
}

void SideLoad::bind(const ConditionContext& context, const Section& section) {
  space_ = &context.space;
  axisymmetric_ = space_->mesh().geometry() == Geometry::axisymmetric;
  field_ = space_->find(field_name());
  const std::vector<std::string> fields = space_->mesh_fields();
  if (field_ < 0 || space_->field(field_).support == Support::apart)
    section.fail("this model has no field '" + field_name() + "'" + suggestion(field_name(), fields), "type");
  const Mesh& mesh = space_->mesh();
  require_boundary(mesh, section, "set", set_);
  for (const Side& side : mesh.side_sets().at(set_)) {
    const ElementBlock& block = mesh.blocks()[side.block];
    LoadedSide loaded{{}, side.block, side.element};
    for (int local : side_nodes(block.shape, side.side)) loaded.nodes.push_back(block.nodes(side.element, local));
    sides_.push_back(loaded);
  }
  const int width = sides_.empty() ? 0 : side_dofs(sides_.front());
  Kokkos::View<int**, Kokkos::LayoutRight> dofs("side dofs", sides_.size(), width);
  const int components = space_->field(field_).components;
  for (std::size_t s = 0; s < sides_.size(); ++s)
    for (int a = 0; a < width / components; ++a)
      for (int c = 0; c < components; ++c)
        dofs(s, a * components + c) = space_->node_dof(field_)(sides_[s].nodes[a]) + c;
  dofs_ = dofs;
  rule_ = line_quadrature(5);
}

void SideLoad::sparsity(Assembler& assembler) { group_ = assembler.add_group(dofs_); }

SidePoint SideLoad::evaluate(const LoadedSide& side, const ConstCoordinateView& x, double xi, double weight) const {
  SidePoint p{};
  const int n = static_cast<int>(side.nodes.size());
  evaluate_line(n, xi, p.N, p.dN);
  double unused[2];
  evaluate_line(2, xi, p.Np, unused);
  const auto& initial = space_->mesh().coordinates();
  double r = 0;
  for (int a = 0; a < n; ++a) {
    r += p.N[a] * x(side.nodes[a], 0);
    for (int i = 0; i < 2; ++i) {
      p.tangent[i] += p.dN[a] * x(side.nodes[a], i);
      p.initial[i] += p.N[a] * initial(side.nodes[a], i);
      p.present[i] += p.N[a] * x(side.nodes[a], i);
    }
  }
  p.r = axisymmetric_ ? r : 1 / (2 * pi);
  p.weight = weight * 2 * pi * p.r;
  return p;
}

void SideLoad::scatter(const MatrixScatter& to, int s, const double (&k)[6][6], double weight) const {
  const int n = side_dofs(sides_[s]);
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) to.add(s, a, b, weight * k[a][b]);
}

void Traction::parameters(Parameters& p) {
  declare_set(p);
  p.add("x", component_[0], "Pa", "force per current area in direction x (r)");
  p.add("y", component_[1], "Pa", "force per current area in direction y (z)");
}

int Traction::residual(const StepView& view, const ResidualView& f) {
  for (std::size_t s = 0; s < sides_.size(); ++s)
    for_each_point(sides_[s], view.momentum.x, [&](const SidePoint& p) {
      const double ds = std::hypot(p.tangent[0], p.tangent[1]);
      for (int i = 0; i < 2; ++i) {
        const double area = ds * p.weight, t = component_[i](view.momentum.time, p.initial) * area,
                     old = component_[i](view.time_old, p.initial) * area;
        for (std::size_t a = 0; a < sides_[s].nodes.size(); ++a)
          f.add(dofs_(s, 2 * a + i), -p.N[a] * t, p.N[a] * (old - t));
      }
    });
  return 0;
}

void Traction::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const MatrixScatter to = assembler.scatter(group_);
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    double k[6][6] = {{0}};
    const std::size_t n = sides_[s].nodes.size();
    for_each_point(sides_[s], view.momentum.x, [&](const SidePoint& p) {
      const double ds = std::hypot(p.tangent[0], p.tangent[1]);
      for (int i = 0; i < 2; ++i) {
        const double t = component_[i](view.momentum.time, p.initial) * view.momentum.geometry_weight * p.weight;
        for (std::size_t b = 0; b < n; ++b)
          for (int j = 0; j < 2; ++j) {
            double change = p.tangent[j] / ds * p.dN[b];
            if (axisymmetric_ && j == 0) change += ds * p.N[b] / p.r;
            for (std::size_t a = 0; a < n; ++a) k[2 * a + i][2 * b + j] -= p.N[a] * t * change;
          }
      }
    });
    scatter(to, static_cast<int>(s), k, weight);
  }
}

void SurfacePressure::parameters(Parameters& p) {
  declare_set(p);
  p.required("value", value_, "Pa",
             "pressure on the current surface, positive against the body; a function of time and position");
  p.choice("position", position_, {{"initial", Position::initial}, {"present", Position::present}},
           "where a point is for the function: where it stood in the mesh as it was made, or where it is now");
}

double SurfacePressure::value(double time, const SidePoint& p) const {
  return value_(time, position_ == Position::present ? p.present : p.initial);
}

std::array<double, 2> SurfacePressure::gradient(const StepView& view, const SidePoint& p) const {
  std::array<double, 2> result{};
  if (position_ == Position::initial || value_.is_constant()) return result;
  const double h = 1e-6 * std::hypot(p.tangent[0], p.tangent[1]);
  for (int i = 0; i < 2; ++i) {
    SidePoint low = p, high = p;
    low.present[i] -= h;
    high.present[i] += h;
    result[i] = (value(view.momentum.time, high) - value(view.momentum.time, low)) / (2 * h);
  }
  return result;
}

int SurfacePressure::residual(const StepView& view, const ResidualView& f) {
  for (std::size_t s = 0; s < sides_.size(); ++s)
    for_each_point(sides_[s], view.momentum.x, [&](const SidePoint& p) {
      const double load = value(view.momentum.time, p) * p.weight, old = value(view.time_old, p) * p.weight;
      const double n[2] = {p.tangent[1], -p.tangent[0]};
      for (std::size_t a = 0; a < sides_[s].nodes.size(); ++a)
        for (int i = 0; i < 2; ++i) f.add(dofs_(s, 2 * a + i), p.N[a] * load * n[i], p.N[a] * (load - old) * n[i]);
    });
  return 0;
}

void SurfacePressure::jacobian(const StepView& view, Assembler& assembler, double weight) {
  const MatrixScatter to = assembler.scatter(group_);
  for (std::size_t s = 0; s < sides_.size(); ++s) {
    double k[6][6] = {{0}};
    const std::size_t nodes = sides_[s].nodes.size();
    for_each_point(sides_[s], view.momentum.x, [&](const SidePoint& p) {
      const double share = view.momentum.geometry_weight * p.weight, load = value(view.momentum.time, p) * share;
      const double n[2] = {p.tangent[1], -p.tangent[0]};
      const auto slope = gradient(view, p);
      for (std::size_t a = 0; a < nodes; ++a)
        for (std::size_t b = 0; b < nodes; ++b) {
          k[2 * a][2 * b + 1] += p.N[a] * load * p.dN[b];
          k[2 * a + 1][2 * b] -= p.N[a] * load * p.dN[b];
          if (axisymmetric_)
            for (int i = 0; i < 2; ++i) k[2 * a + i][2 * b] += p.N[a] * load * n[i] * p.N[b] / p.r;
          for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j) k[2 * a + i][2 * b + j] += p.N[a] * share * n[i] * slope[j] * p.N[b];
        }
    });
    scatter(to, static_cast<int>(s), k, weight);
  }
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
  const ConstCoordinateView initial = space_->mesh().coordinates();
  const bool linear = space_->field(field_).support == Support::vertices;
  for (std::size_t s = 0; s < sides_.size(); ++s)
    for_each_point(sides_[s], initial, [&](const SidePoint& p) {
      const double q = value_(view.balance.time, p.initial) * std::hypot(p.tangent[0], p.tangent[1]) * p.weight;
      for (std::size_t a = 0; a < dofs_.extent(1); ++a) f.add(dofs_(s, a), (linear ? p.Np[a] : p.N[a]) * q);
    });
  return 0;
}

void NormalFlux::jacobian(const StepView&, Assembler&, double) {}

}  // namespace mudline
