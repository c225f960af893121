#include "framework/side_block.hpp"

namespace mudline {

SideBlock::SideBlock(const Space& space, int field_, CellShape side, const std::vector<std::vector<int>>& of_sides,
                     int degree)
    : sides(static_cast<int>(of_sides.size())), field(field_) {
  const QuadratureRule rule = cell_quadrature(side, degree);
  const Field& unknown = space.field(field);
  const CellShape carrier = unknown.support == Support::vertices ? linear_partner(side) : side;
  const int count = num_nodes(side), carry = num_nodes(carrier);
  points = static_cast<int>(rule.weights.size());
  shape = tabulate(side, rule);
  partner = tabulate(carrier, rule);
  nodes = Kokkos::View<int**, Kokkos::LayoutRight>("side nodes", sides, count);
  Kokkos::View<int**, Kokkos::LayoutRight> table("side dofs", sides, carry * unknown.components);
  for (int s = 0; s < sides; ++s) {
    for (int a = 0; a < count; ++a) nodes(s, a) = of_sides[s][a];
    for (int a = 0; a < carry; ++a)
      for (int c = 0; c < unknown.components; ++c)
        table(s, a * unknown.components + c) = space.node_dof(field)(of_sides[s][a]) + c;
  }
  dofs = table;
}

}  // namespace mudline
