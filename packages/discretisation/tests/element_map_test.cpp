#include "discretisation/element_map.hpp"
#include "tensor/mat.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mudline {
namespace {

const CellShape all[] = {CellShape::tri3,  CellShape::tri6,   CellShape::quad4,   CellShape::quad8,
                         CellShape::quad9, CellShape::tet4,   CellShape::tet10,   CellShape::hex8,
                         CellShape::hex27, CellShape::wedge6, CellShape::wedge15, CellShape::wedge18};

/// A cell under a smooth map that bends its sides.
ElementMap bent(CellShape shape) {
  return {shape, [=](int a) {
            const auto xi = reference_node(shape, a);
            const int dim = dimension(shape);
            Vec<double, 3> x{3 + 2 * xi[0] + 0.3 * xi[1], -1 + 0.2 * xi[0] + xi[1], 0};
            if (dim == 3) x = {x[0] + 0.1 * xi[2], x[1] - 0.2 * xi[2], 0.7 + 0.4 * xi[0] + 1.5 * xi[2]};
            for (int i = 0; i < dim; ++i) x[i] += 0.05 * xi[(i + 1) % dim] * xi[0];
            return x;
          }};
}

TEST(ElementMap, InvertFindsThePlaceAgain) {
  for (CellShape shape : all) {
    const ElementMap map = bent(shape);
    const double inside[3] = {0.21, 0.34, 0.17}, outside[3] = {1.2, -0.1, 0.1};
    for (const auto& xi : {inside, outside}) {
      const Vec<double, 3> x = map.at(xi);
      double found[3] = {0, 0, 0};
      ASSERT_TRUE(map.invert(x.data(), found)) << name(shape);
      for (int d = 0; d < dimension(shape); ++d) EXPECT_NEAR(found[d], xi[d], 1e-12) << name(shape);
    }
  }
}

TEST(ElementMap, DeterminantEqualsThatOfDifferences) {
  const double h = 1e-5, at[3] = {0.21, 0.34, 0.17};
  for (CellShape shape : all) {
    const int dim = dimension(shape);
    const ElementMap map = bent(shape);
    Mat<double, 3> slope = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (int k = 0; k < dim; ++k) {
      double above[3] = {at[0], at[1], at[2]}, below[3] = {at[0], at[1], at[2]};
      above[k] += h;
      below[k] -= h;
      for (int i = 0; i < dim; ++i) slope[i][k] = (map.at(above)[i] - map.at(below)[i]) / (2 * h);
    }
    EXPECT_NEAR(map.determinant(at), determinant(slope), 1e-8) << name(shape);
  }
}

TEST(ElementMap, SidesAndCentre) {
  for (CellShape shape : all) {
    EXPECT_LT(outside_cell(shape, cell_centre(shape).data()), 0) << name(shape);
    for (int s = 0; s < num_sides(shape); ++s) {
      for (const Vec<double, 2>& place : {Vec<double, 2>{0.2, 0.3}, {0.6, 0.1}}) {
        const auto xi = on_side(shape, s, place);
        EXPECT_NEAR(beyond_side(shape, s, xi.data()), 0, 1e-15) << name(shape) << " " << s;
        EXPECT_NEAR(outside_cell(shape, xi.data()), 0, 1e-15) << name(shape) << " " << s;
      }
      EXPECT_LT(beyond_side(shape, s, cell_centre(shape).data()), 0);
      // check node by node that the coordinates are those of the side's own shape
      const CellShape own = side_shape(shape, s);
      for (int a = 0; a < num_nodes(own); ++a) {
        const auto xi = reference_node(own, a), there = reference_node(shape, side_nodes(shape, s)[a]);
        EXPECT_EQ(on_side(shape, s, {xi[0], xi[1]}), there) << name(shape) << " " << s << " " << a;
      }
    }
  }
}

TEST(ElementMap, ScaledJacobian) {
  const double h = std::sqrt(3.0) / 2;
  const Vec<double, 3> regular[] = {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0.5, h / 3, std::sqrt(2.0 / 3)}};
  const auto node = [&](const Vec<double, 3>* corners, int a) {
    Vec<double, 3> x{};
    const auto around = corners_around(CellShape::tet10, a);
    for (int c : around)
      for (int i = 0; i < 3; ++i) x[i] += corners[c][i] / around.size();
    return x;
  };
  EXPECT_NEAR(ElementMap(CellShape::tet4, [&](int a) { return regular[a]; }).scaled_jacobian(), 1, 1e-14);
  EXPECT_NEAR(ElementMap(CellShape::tet10, [&](int a) { return node(regular, a); }).scaled_jacobian(), 1, 1e-14);
  for (CellShape shape : {CellShape::hex8, CellShape::hex27})
    EXPECT_NEAR(ElementMap(shape, [&](int a) { return reference_node(shape, a); }).scaled_jacobian(), 1, 1e-14);
  for (CellShape shape : {CellShape::wedge6, CellShape::wedge15, CellShape::wedge18}) {
    // equilateral triangles at a distance of one edge
    const auto equilateral = [&](int a, double height) {
      const auto xi = reference_node(shape, a);
      return Vec<double, 3>{xi[0] + 0.5 * xi[1], h * xi[1], 0.5 * height * xi[2]};
    };
    EXPECT_NEAR(ElementMap(shape, [&](int a) { return equilateral(a, 1); }).scaled_jacobian(), 1, 1e-14);
    EXPECT_NEAR(ElementMap(shape, [&](int a) { return equilateral(a, 0.1); }).scaled_jacobian(), 1, 1e-14);
    EXPECT_NEAR(ElementMap(shape, [&](int a) { return equilateral(a, -1); }).scaled_jacobian(), -1, 1e-14);
    const ElementSize size = ElementMap(shape, [&](int a) { return equilateral(a, 2); }).size();
    EXPECT_NEAR(size.height, h / 2, 1e-14) << "the volume over the area of a quadrilateral";
    EXPECT_NEAR(size.shortest_edge, 1, 1e-14);
    EXPECT_NEAR(size.longest_edge, 2, 1e-14);
  }
  // a mid-side node nearer to a corner than a quarter of its edge folds that corner
  const ElementMap folded(CellShape::tet10, [&](int a) {
    auto x = node(regular, a);
    if (a == 4) x[0] = 0.2;
    return x;
  });
  EXPECT_LT(folded.scaled_jacobian(), 0);
  const ElementMap flat(CellShape::tet4, [&](int a) { return a == 3 ? Vec<double, 3>{0.3, 0.3, 0.0} : regular[a]; });
  EXPECT_NEAR(flat.scaled_jacobian(), 0, 1e-14);
  const ElementMap undefined(CellShape::hex8, [&](int a) {
    auto x = reference_node(CellShape::hex8, a);
    if (a == 5) x[2] = std::nan("");
    return x;
  });
  EXPECT_EQ(undefined.scaled_jacobian(), -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace mudline
