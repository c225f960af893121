#include "framework/field_block.hpp"

#include <algorithm>
#include <stdexcept>

namespace mudline {

FieldBlock::FieldBlock(const Space& space, int block, int displacement_field, const std::vector<int>& scalar_fields,
                       int degree)
    : displacement(displacement_field), scalars(static_cast<int>(scalar_fields.size())) {
  if (scalars > max_scalars) throw std::logic_error("too many scalar fields in one block");
  std::copy(scalar_fields.begin(), scalar_fields.end(), scalar);
  const ElementBlock& cells = space.mesh().blocks()[block];
  shape = cells.shape;
  elements = cells.num_elements;
  nodes = cells.nodes;
  const QuadratureRule rule = cell_quadrature(shape, degree);
  u = tabulate(shape, rule);
  points = u.points;
  std::vector<int> fields;
  if (moves()) fields.push_back(displacement);
  for (int field : scalar_fields) {
    fields.push_back(field);
    if (space.shape(field, block) != space.shape(scalar_fields[0], block))
      throw std::logic_error("scalar fields of one block have different nodes");
  }
  if (scalars > 0) p = tabulate(space.shape(scalar_fields[0], block), rule);
  dofs = space.element_dofs(block, fields);
}

}  // namespace mudline
