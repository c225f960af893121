#include "discretisation/msh_element.hpp"

#include <algorithm>

#include "discretisation/cells/cell.hpp"

namespace mudline {

namespace {

constexpr MshElement elements[] = {{1, "Line 2", 1, 2, 2},
                                   {2, "Triangle 3", 2, 3, 3},
                                   {3, "Quadrilateral 4", 2, 4, 4},
                                   {4, "Tetrahedron 4", 3, 4, 4},
                                   {5, "Hexahedron 8", 3, 8, 8},
                                   {6, "Prism 6", 3, 6, 6},
                                   {7, "Pyramid 5", 3, 5, 5},
                                   {8, "Line 3", 1, 3, 2},
                                   {9, "Triangle 6", 2, 6, 3},
                                   {10, "Quadrilateral 9", 2, 9, 4},
                                   {11, "Tetrahedron 10", 3, 10, 4},
                                   {12, "Hexahedron 27", 3, 27, 8},
                                   {13, "Prism 18", 3, 18, 6},
                                   {14, "Pyramid 14", 3, 14, 5},
                                   {15, "Point", 0, 1, 1},
                                   {16, "Quadrilateral 8", 2, 8, 4},
                                   {17, "Hexahedron 20", 3, 20, 8},
                                   {18, "Prism 15", 3, 15, 6},
                                   {19, "Pyramid 13", 3, 13, 5},
                                   {20, "Triangle 9", 2, 9, 3},
                                   {21, "Triangle 10", 2, 10, 3},
                                   {22, "Triangle 12", 2, 12, 3},
                                   {23, "Triangle 15", 2, 15, 3},
                                   {24, "Triangle 15", 2, 15, 3},
                                   {25, "Triangle 21", 2, 21, 3},
                                   {26, "Line 4", 1, 4, 2},
                                   {27, "Line 5", 1, 5, 2},
                                   {28, "Line 6", 1, 6, 2},
                                   {29, "Tetrahedron 20", 3, 20, 4},
                                   {30, "Tetrahedron 35", 3, 35, 4},
                                   {31, "Tetrahedron 56", 3, 56, 4},
                                   {36, "Quadrilateral 16", 2, 16, 4},
                                   {37, "Quadrilateral 25", 2, 25, 4},
                                   {38, "Quadrilateral 36", 2, 36, 4},
                                   {39, "Quadrilateral 12", 2, 12, 4},
                                   {40, "Quadrilateral 16", 2, 16, 4},
                                   {92, "Hexahedron 64", 3, 64, 8},
                                   {93, "Hexahedron 125", 3, 125, 8}};

}  // namespace

const MshElement* msh_element(int type) {
  const auto* const found =
      std::find_if(std::begin(elements), std::end(elements), [&](const MshElement& e) { return e.type == type; });
  return found == std::end(elements) ? nullptr : found;
}

std::optional<CellShape> cell_of(int type) {
  for (int s = 0; s < num_shapes; ++s) {
    const auto shape = static_cast<CellShape>(s);
    const std::vector<int>& types = cell(shape).msh_types;
    if (std::find(types.begin(), types.end(), type) != types.end()) return shape;
  }
  return {};
}

std::vector<int> order_of_nodes(int type, CellShape shape) {
  const int given = msh_element(type)->nodes, corners = num_corners(shape);
  const std::vector<std::vector<int>>& all = cell(shape).msh_around;
  std::vector<int> order;
  for (int a = 0; a < num_nodes(shape); ++a) {
    int place = a;
    if (a >= corners && !all.empty()) {
      std::vector<int> around = corners_around(shape, a);
      std::sort(around.begin(), around.end());
      place = corners + static_cast<int>(std::find(all.begin(), all.end(), around) - all.begin());
    }
    order.push_back(place < given ? place : -1);
  }
  return order;
}

}  // namespace mudline
