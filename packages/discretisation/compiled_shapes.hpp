#pragma once

#include <stdexcept>

namespace mudline {

/// Numbers of nodes and corners of a shape, at compile time.
template <int Nodes, int Corners>
struct NodeCounts {
  static constexpr int nodes = Nodes, corners = Corners;
};
template <class... Counts>
struct CompiledShapes {};

/// Cells and sides for which the loops over points are compiled. In either list no two shapes have as many nodes.
using PlaneCells = CompiledShapes<NodeCounts<6, 3>, NodeCounts<9, 4>, NodeCounts<3, 3>, NodeCounts<4, 4>>;
using SpaceCells = CompiledShapes<NodeCounts<4, 4>, NodeCounts<10, 4>, NodeCounts<8, 8>, NodeCounts<27, 8>,
                                  NodeCounts<6, 6>, NodeCounts<15, 6>, NodeCounts<18, 6>>;
using PlaneSides = CompiledShapes<NodeCounts<2, 2>, NodeCounts<3, 2>>;
using SpaceSides =
    CompiledShapes<NodeCounts<3, 3>, NodeCounts<6, 3>, NodeCounts<4, 4>, NodeCounts<9, 4>, NodeCounts<8, 4>>;

/// The result of f(NodeCounts) for the shape of a list with that many nodes. std::logic_error where there is none.
template <class Result, class First, class... Rest, class F>
Result with_node_counts(CompiledShapes<First, Rest...>, int nodes, F&& f) {
  if (First::nodes == nodes) return f(First{});
  if constexpr (sizeof...(Rest) > 0) return with_node_counts<Result>(CompiledShapes<Rest...>{}, nodes, f);
  throw std::logic_error("no kernel is compiled for the shape");
}

}  // namespace mudline
