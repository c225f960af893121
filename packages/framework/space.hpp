#pragma once

#include <string>
#include <vector>

#include "algebra/assembler.hpp"
#include "algebra/dof_map.hpp"
#include "discretisation/mesh.hpp"

namespace mudline {

/// The nodes that carry a field: all nodes, the cell corners (the linear partner of a Taylor-Hood pair), or no nodes of
/// the mesh (`apart`) but a few separate points (rigid bodies), known to every rank and owned by the first.
enum class Support { all_nodes, vertices, apart };

/// Stands for the number of components of a vector, 2 or 3; a Space replaces it by the dimension of its mesh.
constexpr int vector_components = 0;

/// One unknown field as a physics declares it.
struct Field {
  std::string name;  // "displacement", "pore pressure", "temperature"
  std::string unit;  // unit of the value
  std::string flux;  // unit of the conjugate residual: "N", "m3/s", "W"
  int components;    // or vector_components
  Support support;
  int time_order;  // 2: value, rate, second rate (inertia); 1: value and rate
  int count = 0;   // number of points of a field apart from the mesh
};

/// Fields on a mesh: the numbering of unknowns and the tables that element loops need.
class Space {
 public:
  Space(const Mesh& mesh, std::vector<Field> fields);

  const Mesh& mesh() const { return mesh_; }
  const RCP<const DofMap>& dofs() const { return dofs_; }
  int num_fields() const { return static_cast<int>(fields_.size()); }
  const Field& field(int f) const { return fields_[f]; }
  /// Index of a field; -1 when absent.
  int find(const std::string& name) const { return dofs_->find(name); }

  /// Local (overlap) dof of component 0 at a local node; -1 where the node does not carry the field. (node)
  const Kokkos::View<int*>& node_dof(int f) const { return node_dof_[f]; }
  /// Writes the local dofs of a field at some nodes, node after node, component after component; returns the end.
  int* write_dofs(int f, const int* nodes, int count, int* to) const;
  /// Local (overlap) dof of component 0 at a point of a field apart from the mesh.
  int point_dof(int f, int point) const { return dofs_->dof(f, point); }
  /// Names of the fields on the mesh, which conditions may prescribe.
  std::vector<std::string> mesh_fields() const;
  /// Local dofs of the elements of a block for the named fields, field after field, node after node, component after
  /// component: (element, dof).
  ElementDofs element_dofs(int block, const std::vector<int>& fields) const;
  /// Shape of a field on a block: the cell's own, or its linear partner.
  CellShape shape(int f, int block) const;

 private:
  const Mesh& mesh_;
  std::vector<Field> fields_;
  RCP<const DofMap> dofs_;
  std::vector<Kokkos::View<int*>> node_dof_;
};

}  // namespace mudline
