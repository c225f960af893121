#include "framework/side_block.hpp"

namespace mudline {

SideBlock::SideBlock(const Space& space, int field_, CellShape side, const std::vector<std::vector<int>>& of_sides,
                     int degree)
    : sides(static_cast<int>(of_sides.size())), field(field_) {
  const QuadratureRule rule = cell_quadrature(side, degree);
  const Field& unknown = space.field(field);
  const CellShape carrier = unknown.support == Support::vertices ? linear_partner(side) : side;
  const int count = num_nodes(side), carrier_nodes = num_nodes(carrier);
  points = static_cast<int>(rule.weights.size());
  shape = tabulate(side, rule);
  partner = tabulate(carrier, rule);
  nodes = Kokkos::View<int**, Kokkos::LayoutRight>("side nodes", sides, count);
  Kokkos::View<int**, Kokkos::LayoutRight> table("side dofs", sides, carrier_nodes * unknown.components);
  for (int s = 0; s < sides; ++s) {
    for (int a = 0; a < count; ++a) nodes(s, a) = of_sides[s][a];
    space.write_dofs(field, of_sides[s].data(), carrier_nodes, &table(s, 0));
  }
  dofs = table;
  rows = RowLists(dofs);
}

Point SideBlock::place(int s, int q, const ConstCoordinateView& x) const {
  Point at{};
  for (int a = 0; a < shape.nodes; ++a)
    for (std::size_t i = 0; i < x.extent(1); ++i) at[i] += shape.N(q, a) * x(nodes(s, a), i);
  return at;
}

}  // namespace mudline
