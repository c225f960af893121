#include "contact/body/leaky_surface.hpp"

#include <cmath>

#include "core/pi.hpp"

namespace mudline {

LeakySurface::LeakySurface(const Space& space, const ContactSurface& surface, double conductance,
                           const Function& outside)
    : surface_(surface),
      conductance_(conductance),
      outside_(outside),
      axisymmetric_(space.mesh().geometry() == Geometry::axisymmetric),
      field_(space.find("pore pressure")) {
  const bool vertices = space.field(field_).support == Support::vertices;
  for (int count = 2; count <= 3; ++count) {
    const int nodes = vertices ? 2 : count;
    int rows = 0;
    for (const SurfaceSide& side : surface.sides()) rows += side.count == count;
    Kokkos::View<int**, Kokkos::LayoutRight> table("leaky dofs", rows, nodes);
    for (const SurfaceSide& side : surface.sides())
      for (int a = 0; side.count == count && a < nodes; ++a) table(side.row, a) = space.node_dof(field_)(side.node[a]);
    dofs_[count - 2] = table;
  }
}

void LeakySurface::sparsity(Assembler& assembler) {
  for (int i = 0; i < 2; ++i) group_[i] = assembler.add_group(dofs_[i]);
}

LeakySurface::SideMatrix LeakySurface::side_matrix(const SurfaceSide& side, const StepView& view) const {
  static const QuadratureRule rule = line_quadrature(5);
  const int nodes = static_cast<int>(dofs_[side.count - 2].extent(1));
  SideMatrix result{};
  for (std::size_t q = 0; q < rule.weights.size(); ++q) {
    double N[3], dN[3], P[3], dP[3], x[2] = {0, 0}, along[2] = {0, 0};
    evaluate_line(side.count, rule.points[q][0], N, dN);
    evaluate_line(nodes, rule.points[q][0], P, dP);
    for (int a = 0; a < side.count; ++a)
      for (int i = 0; i < 2; ++i) {
        x[i] += N[a] * view.x_old(side.node[a], i);
        along[i] += dN[a] * view.x_old(side.node[a], i);
      }
    const double weight =
        conductance_ * rule.weights[q] * std::hypot(along[0], along[1]) * (axisymmetric_ ? 2 * pi * x[0] : 1.0);
    const double outside = outside_(view.balance.time, {x[0], x[1], 0});
    for (int a = 0; a < nodes; ++a) {
      result.outside[a] += weight * P[a] * outside;
      for (int b = 0; b < nodes; ++b) result.k[a][b] += weight * P[a] * P[b];
    }
  }
  return result;
}

void LeakySurface::add(const StepView& view, const ResidualView& f) const {
  if (!view.flow) return;
  for (std::size_t s = 0; s < surface_.sides().size(); ++s) {
    if (!leaks(s)) continue;
    const SurfaceSide& side = surface_.sides()[s];
    const ElementDofs& dofs = dofs_[side.count - 2];
    const SideMatrix m = side_matrix(side, view);
    for (std::size_t a = 0; a < dofs.extent(1); ++a) {
      double out = -m.outside[a];
      for (std::size_t b = 0; b < dofs.extent(1); ++b) out += m.k[a][b] * view.value(dofs(side.row, b));
      f.add(dofs(side.row, a), out);
    }
  }
}

void LeakySurface::jacobian(const StepView& view, Assembler& assembler) const {
  if (!view.flow) return;
  const MatrixScatter to[2] = {assembler.scatter(group_[0]), assembler.scatter(group_[1])};
  const double share = view.sensitivity[field_].value;
  for (std::size_t s = 0; s < surface_.sides().size(); ++s) {
    if (!leaks(s)) continue;
    const SurfaceSide& side = surface_.sides()[s];
    const SideMatrix m = side_matrix(side, view);
    const int nodes = static_cast<int>(dofs_[side.count - 2].extent(1));
    for (int a = 0; a < nodes; ++a)
      for (int b = 0; b < nodes; ++b) to[side.count - 2].add(side.row, a, b, share * m.k[a][b]);
  }
}

}  // namespace mudline
