#pragma once

#include <stdexcept>
#include <type_traits>

#include "discretisation/compiled_shapes.hpp"
#include "framework/coordinates.hpp"
#include "framework/field_block.hpp"

namespace mudline {

/// Compile-time sizes of an element: nodes of the cell and of the scalar fields, number of scalar fields, and whether
/// the displacement is among the unknowns.
template <int NU_, int NS_, int S_, bool Moves = true>
struct ElementShapes {
  static constexpr int NU = NU_, NS = NS_, S = S_;
  static constexpr bool moves = Moves;
};

/// Calls f(coordinate system, ElementShapes) of a block. The displacement has values at all nodes; scalar fields at the
/// corners or, without a displacement, at all nodes. Scalars: the number of scalar fields that f uses at most, the
/// first ones of the block.
template <int Scalars = max_scalars, class F>
auto with_element(Geometry geometry, const FieldBlock& block, F&& f) {
  using Result = decltype(f(PlaneStrain{}, ElementShapes<6, 0, 0>{}));
  const auto of_cell = [&](auto coordinates, auto counts) -> Result {
    constexpr int N = decltype(counts)::nodes, P = decltype(counts)::corners;
    const bool corners = block.p.nodes < N;
    const auto of_scalars = [&](auto scalars) -> Result {
      constexpr int S = decltype(scalars)::value;
      if (!block.moves())
        return corners ? f(coordinates, ElementShapes<N, P, S, false>{})
                       : f(coordinates, ElementShapes<N, N, S, false>{});
      if constexpr (S < 2 || P < N)  // compiled for what physics allow
        if (corners || P == N) return f(coordinates, ElementShapes<N, P, S>{});
      throw std::logic_error(
          "beside the displacement no kernel is compiled for two scalar fields on linear cells, nor for fields at all "
          "nodes of quadratic cells");
    };
    static_assert(max_scalars == 2);
    if constexpr (Scalars > 1)
      if (block.scalars > 1) return of_scalars(std::integral_constant<int, 2>{});
    if constexpr (Scalars > 0)
      if (block.scalars > 0) return of_scalars(std::integral_constant<int, 1>{});
    if (block.moves()) return f(coordinates, ElementShapes<N, 0, 0>{});
    throw std::logic_error("a loop without scalar fields needs a block with the displacement");
  };
  return with_coordinates(geometry, [&](auto coordinates) -> Result {
    using Cells = std::conditional_t<decltype(coordinates)::dim == 3, SpaceCells, PlaneCells>;
    return with_node_counts<Result>(Cells{}, num_nodes(block.shape),
                                    [&](auto counts) { return of_cell(coordinates, counts); });
  });
}

/// The same for a block whose displacement is among the unknowns, as that of soil is: f is compiled for no other.
template <int Scalars = max_scalars, class F>
auto with_moving_element(Geometry geometry, const FieldBlock& block, F&& f) {
  using Result = decltype(f(PlaneStrain{}, ElementShapes<6, 0, 0>{}));
  return with_element<Scalars>(geometry, block, [&](auto coordinates, auto shapes) -> Result {
    if constexpr (decltype(shapes)::moves) return f(coordinates, shapes);
    throw std::logic_error("the displacement is not among the unknowns of the block");
  });
}

}  // namespace mudline
