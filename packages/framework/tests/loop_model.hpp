#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "discretisation/tests/mesh_fixture.hpp"
#include "framework/element_loop.hpp"
#include "framework/side_loop.hpp"

namespace mudline {

/// A box with a displacement at all nodes and a scalar field at the vertices, and one level of a step on it: 2 m x 1 m
/// in the plane, 2 m x 1 m x 1.5 m in space.
struct LoopModel {
  enum { displacement, scalar };

  LoopModel(Geometry geometry, const std::string& cell, int nx, int ny, const std::string& more = "")
      : mesh(mesh_test::make(entries(geometry, cell, nx, ny) + more)),
        space(*mesh, {{"displacement", "m", "N", vector_components, Support::all_nodes, 2},
                      {"scalar", "-", "1/s", 1, Support::vertices, 1}}),
        x("x", mesh->num_nodes(), mesh->dimension()) {
    for (NodalView* view : {&value_old, &value, &rate, &acceleration, &sum, &acting, &whole})
      *view = NodalView("nodal", space.dofs()->num_overlap_dofs());
    Kokkos::deep_copy(x, mesh->coordinates());
  }

  static std::string entries(Geometry geometry, const std::string& cell, int nx, int ny) {
    using namespace mesh_test;
    if (geometry == Geometry::space) return box3(cell, nx, ny, 1);
    return box(cell, nx, ny) + parameter("geometry", "string", name(geometry));
  }
  double volume() const {
    return mesh->geometry() == Geometry::space ? 3 : mesh->geometry() == Geometry::axisymmetric ? 4 * pi : 2;
  }

  FieldBlock block(int degree = 4) const { return {space, 0, displacement, {scalar}, degree}; }
  /// The sides of a set, with the unknowns of a field.
  SideBlock sides(const std::string& set, int field, int degree = 4) const {
    std::vector<std::vector<int>> nodes;
    CellShape shape = CellShape::line2;
    for (const Side& side : mesh->side_sets().at(set)) {
      const ElementBlock& cells = mesh->blocks()[side.block];
      shape = side_shape(cells.shape, side.side);
      nodes.emplace_back();
      for (const int a : side_nodes(cells.shape, side.side)) nodes.back().push_back(cells.nodes(side.element, a));
    }
    return {space, field, shape, nodes, degree};
  }
  ResidualView residual() const { return {sum, acting, whole}; }

  int dof(int field, int node, int component = 0) const { return space.node_dof(field)(node) + component; }
  /// Sets the displacement's part of a nodal vector by the place in the original mesh.
  void set(const NodalView& to, const std::function<Point(const Point&)>& f) const {
    for (int node = 0; node < mesh->num_nodes(); ++node)
      for (int i = 0; i < mesh->dimension(); ++i) to(dof(displacement, node, i)) = f(mesh->place(node))[i];
  }
  void set_scalar(const NodalView& to, const std::function<double(const Point&)>& f) const {
    for (int node = 0; node < mesh->num_nodes(); ++node)
      if (mesh->is_vertex()[node]) to(dof(scalar, node)) = f(mesh->place(node));
  }
  /// Work of the residual on a displacement, and on a scalar.
  double work(const std::function<Point(const Point&)>& f) const {
    double total = 0;
    for (int node = 0; node < mesh->num_nodes(); ++node)
      for (int i = 0; i < mesh->dimension(); ++i) total += sum(dof(displacement, node, i)) * f(mesh->place(node))[i];
    return total;
  }
  double work_on_scalar(const std::function<double(const Point&)>& f) const {
    double total = 0;
    for (int node = 0; node < mesh->num_nodes(); ++node)
      if (mesh->is_vertex()[node]) total += sum(dof(scalar, node)) * f(mesh->place(node));
    return total;
  }

  /// The level, with the sensitivities of a step in which every level follows from the values at its end.
  LoopLevel level() const {
    LoopLevel at;
    at.x = x;
    at.value_old = value_old;
    at.value_end = at.value = value;
    at.rate = rate;
    at.acceleration = acceleration;
    at.geometry_weight = 1;
    at.displacement = at.scalar[0] = {1, per_step, per_step, per_step * per_step};
    return at;
  }
  /// Moves the mesh and sets the rates by the change of the values.
  void follow() const {
    for (std::size_t i = 0; i < value.extent(0); ++i) {
      rate(i) = per_step * (value(i) - value_old(i));
      acceleration(i) = per_step * rate(i);
    }
    for (int node = 0; node < mesh->num_nodes(); ++node)
      for (int i = 0; i < mesh->dimension(); ++i) {
        const int u = dof(displacement, node, i);
        x(node, i) = mesh->coordinates()(node, i) + value(u) - value_old(u);
      }
  }

  static constexpr double per_step = 2;  // [1/s]
  std::unique_ptr<Mesh> mesh;
  Space space;
  NodalView value_old, value, rate, acceleration, sum, acting, whole;
  CoordinateView x;
};

/// The largest difference between a matrix and central differences of a residual by the values of the model's unknowns,
/// relative to the largest entry. assemble(matrix scatter) adds the matrix of a group, evaluate() the residual to
/// model.sum.
template <class Assemble, class Evaluate>
double tangent_error(const LoopModel& model, const ElementDofs& dofs, Assemble assemble, Evaluate evaluate) {
  const int n = model.space.dofs()->num_overlap_dofs();
  Assembler assembler(model.space.dofs());
  const int group = assembler.add_group(dofs);
  assembler.finalise();
  model.follow();
  assembler.begin(Kokkos::View<char*>("constrained", n));
  assemble(assembler.scatter(group));
  assembler.end();
  std::vector<double> exact(n * n, 0.0), differences(n * n, 0.0);
  const auto local = assembler.matrix()->getLocalMatrixHost();
  for (int row = 0; row < n; ++row)
    for (std::size_t k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k)
      exact[row * n + local.graph.entries(k)] = local.values(k);
  constexpr double h = 1e-6;
  for (int column = 0; column < n; ++column)
    for (const int sign : {1, -1}) {
      model.value(column) += sign * h;
      model.follow();
      Kokkos::deep_copy(model.sum, 0.0);
      evaluate();
      for (int row = 0; row < n; ++row) differences[row * n + column] += sign * model.sum(row) / (2 * h);
      model.value(column) -= sign * h;
    }
  double worst = 0, largest = 0;
  for (int k = 0; k < n * n; ++k) {
    worst = std::max(worst, std::abs(exact[k] - differences[k]));
    largest = std::max(largest, std::abs(exact[k]));
  }
  return worst / largest;
}

}  // namespace mudline
