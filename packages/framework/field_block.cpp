#include "framework/field_block.hpp"

#include <algorithm>
#include <stdexcept>

namespace mudline {

FieldBlock::FieldBlock() = default;
FieldBlock::FieldBlock(const FieldBlock&) = default;
FieldBlock& FieldBlock::operator=(const FieldBlock&) = default;
FieldBlock::~FieldBlock() = default;

FieldBlock::FieldBlock(const Space& space, int block, int displacement_field, const std::vector<int>& scalar_fields,
                       int degree)
    : displacement(displacement_field), scalars(static_cast<int>(scalar_fields.size())) {
  if (scalars > max_scalars) throw std::logic_error("too many scalar fields in one block");
  std::copy(scalar_fields.begin(), scalar_fields.end(), scalar);
  const ElementBlock& cells = space.mesh().blocks()[block];
  shape = cells.shape;
  elements = cells.num_elements;
  nodes = cells.nodes;
  std::vector<int> fields;
  if (moves()) fields.push_back(displacement);
  for (int field : scalar_fields) {
    fields.push_back(field);
    if (space.shape(field, block) != space.shape(scalar_fields[0], block))
      throw std::logic_error("scalar fields of one block have different nodes");
  }
  scalar_shape = scalars > 0 ? space.shape(scalar_fields[0], block) : shape;
  dofs = space.element_dofs(block, fields);
  rows = RowLists(dofs);
  *this = with_quadrature(degree);
}

FieldBlock FieldBlock::with_quadrature(int degree) const {
  FieldBlock other = *this;
  const QuadratureRule rule = cell_quadrature(shape, degree);
  other.u = tabulate(shape, rule);
  if (scalars > 0) other.p = tabulate(scalar_shape, rule);
  other.points = other.u.points;
  other.degree = degree;
  return other;
}

Point FieldBlock::place(int e, int q, const ConstCoordinateView& x) const {
  Point at{};
  for (int a = 0; a < u.nodes; ++a)
    for (std::size_t i = 0; i < x.extent(1); ++i) at[i] += u.N(q, a) * x(nodes(e, a), i);
  return at;
}

double FieldBlock::scalar_at(int e, int q, int k, const ConstNodalView& values) const {
  const int first = static_cast<int>(dofs.extent(1)) - (scalars - k) * p.nodes;  // column of the field's first node
  double value = 0;
  for (int a = 0; a < p.nodes; ++a) value += p.N(q, a) * values(dofs(e, first + a));
  return value;
}

}  // namespace mudline
