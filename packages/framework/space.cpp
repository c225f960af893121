#include "framework/space.hpp"

#include <stdexcept>

namespace mudline {

namespace {

std::vector<FieldLayout> layouts(const Mesh& mesh, const std::vector<Field>& fields) {
  std::vector<FieldLayout> result;
  for (const Field& field : fields) {
    FieldLayout layout{field.name, field.components, {}, 0};
    if (field.support == Support::apart) {
      for (int point = 0; point < field.count; ++point) layout.node_ids.push_back(point);
      layout.num_owned = mesh.comm()->getRank() == 0 ? field.count : 0;
      layout.apart = true;
      result.push_back(std::move(layout));
      continue;
    }
    for (int node = 0; node < mesh.num_nodes(); ++node) {
      if (field.support == Support::vertices && !mesh.is_vertex()[node]) continue;
      layout.node_ids.push_back(mesh.node_ids()[node]);
      if (node < mesh.num_owned_nodes()) ++layout.num_owned;
    }
    result.push_back(std::move(layout));
  }
  return result;
}

std::vector<Field> with_components(const Mesh& mesh, std::vector<Field> fields) {
  for (Field& field : fields)
    if (field.components == vector_components) field.components = mesh.dimension();
  return fields;
}

}  // namespace

Space::Space(const Mesh& mesh, std::vector<Field> fields)
    : mesh_(mesh),
      fields_(with_components(mesh, std::move(fields))),
      dofs_(rcp(new DofMap(mesh.comm(), layouts(mesh, fields_)))) {
  for (int f = 0; f < num_fields(); ++f) {
    Kokkos::View<int*> table("node dof", mesh.num_nodes());
    int carrying = 0;
    for (int node = 0; node < mesh.num_nodes(); ++node) {
      const bool carries = fields_[f].support == Support::all_nodes ||
                           (fields_[f].support == Support::vertices && mesh.is_vertex()[node]);
      table(node) = carries ? dofs_->dof(f, carrying++) : -1;
    }
    node_dof_.push_back(table);
  }
}

std::vector<std::string> Space::mesh_fields() const {
  std::vector<std::string> names;
  for (const Field& field : fields_)
    if (field.support != Support::apart) names.push_back(field.name);
  return names;
}

CellShape Space::shape(int f, int block) const {
  const CellShape cell = mesh_.blocks()[block].shape;
  return fields_[f].support == Support::all_nodes ? cell : linear_partner(cell);
}

int* Space::write_dofs(int f, const int* nodes, int count, int* to) const {
  for (int a = 0; a < count; ++a) {
    const int first = node_dof_[f](nodes[a]);
    if (first < 0) throw std::logic_error("a node does not carry field " + fields_[f].name);
    for (int c = 0; c < fields_[f].components; ++c) *to++ = first + c;
  }
  return to;
}

ElementDofs Space::element_dofs(int block, const std::vector<int>& fields) const {
  const ElementBlock& elements = mesh_.blocks()[block];
  int width = 0;
  for (int f : fields) width += num_nodes(shape(f, block)) * fields_[f].components;
  Kokkos::View<int**, Kokkos::LayoutRight> dofs("element dofs", elements.num_elements, width);
  for (int e = 0; e < elements.num_elements; ++e) {
    int* to = &dofs(e, 0);
    for (int f : fields)  // the corners, which are the linear partner's nodes, come first
      to = write_dofs(f, &elements.nodes(e, 0), num_nodes(shape(f, block)), to);
  }
  return dofs;
}

}  // namespace mudline
