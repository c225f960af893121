// Assembly on several threads keeps the order, and with it the bits, of one thread.
#include "algebra/row_lists.hpp"

#include <gtest/gtest.h>
#include <Tpetra_Core.hpp>

#include <cmath>
#include <numeric>
#include <vector>

#include "algebra/assembler.hpp"
#include "algebra/ordered_sum.hpp"

namespace mudline {
namespace {

/// Numbers of very different sizes and both signs: the sum of a few depends on their order.
double rough(int i) { return std::sin(12.9898 * i) * std::pow(10.0, 6 * std::sin(78.233 * i)); }

Kokkos::View<int**, Kokkos::LayoutRight> tangled_elements(int elements, int nodes) {
  Kokkos::View<int**, Kokkos::LayoutRight> dofs("dofs", elements, 6);
  for (int e = 0; e < elements; ++e)
    for (int a = 0; a < 3; ++a)
      for (int c = 0; c < 2; ++c) dofs(e, 2 * a + c) = 2 * ((5 * e + 7 * a + e / 3) % nodes) + c;
  return dofs;
}

TEST(RowLists, HoldEveryEntryOnceInTheOrderOfElements) {
  const auto dofs = tangled_elements(23, 10);
  const RowLists lists(dofs, 5);
  ASSERT_EQ(lists.first_row.extent(0), 6u);
  int entries = 0;
  for (int batch = 0; batch < 5; ++batch)
    for (int i = lists.first_row(batch); i < lists.first_row(batch + 1); ++i)
      for (int k = lists.begin(i); k < lists.begin(i + 1); ++k, ++entries) {
        EXPECT_EQ(dofs(5 * batch + lists.entries(k) / 6, lists.entries(k) % 6), lists.rows(i));
        if (k > lists.begin(i)) {
          EXPECT_GT(lists.entries(k), lists.entries(k - 1));
        }
      }
  EXPECT_EQ(entries, 23 * 6);
  EXPECT_EQ(RowLists(dofs, 0).batch, 0);
}

/// The kernel on an element: it adds some columns of its matrix, or nothing.
struct Kernel {
  MatrixScatter to;
  KOKKOS_FUNCTION void operator()(int e) const {
    to.open(e);
    if (e % 4 == 1) return;
    double k[6][4], rest[6][2];
    for (int a = 0; a < 6; ++a) {
      for (int b = 0; b < 4; ++b) k[a][b] = rough(36 * e + 6 * a + b);
      for (int b = 0; b < 2; ++b) rest[a][b] = rough(36 * e + 6 * a + 4 + b);
    }
    if (e % 2 == 0)
      to.add(e, 0, 0, k, 0.3);
    else
      to.add(e, 0, 4, rest, 0.7);
  }
};

std::vector<double> assembled(int batch, int first, int last) {
  constexpr int nodes = 30;
  std::vector<GlobalOrdinal> ids(nodes);
  std::iota(ids.begin(), ids.end(), 0);
  const auto dofs = rcp(new DofMap(Tpetra::getDefaultComm(), {{"displacement", 2, ids, nodes}}));
  const auto elements = tangled_elements(200, nodes);
  Assembler assembler(dofs);
  const int group = assembler.add_group(elements);
  assembler.finalise();
  Kokkos::View<char*> constrained("constrained", 2 * nodes);
  constrained(8) = constrained(21) = 1;
  assembler.begin(constrained);
  in_order("rows", RowLists(elements, batch), first, last, assembler.scatter(group),
           [&](int begin, int end, const MatrixScatter& to) {
             for (int e = begin; e < end; ++e) Kernel{to}(e);
           });
  assembler.end();
  const auto values = assembler.matrix()->getLocalMatrixHost().values;
  return std::vector<double>(values.data(), values.data() + values.extent(0));
}

TEST(RowLists, TheMatrixHasTheBitsOfAddingAtOnce) {
  const std::vector<double> at_once = assembled(0, 0, 200);
  for (const int batch : {1, 7, 64, 1000}) EXPECT_EQ(assembled(batch, 0, 200), at_once) << batch;
  EXPECT_EQ(assembled(7, 14, 199), assembled(0, 14, 199));
  EXPECT_NE(at_once, assembled(0, 0, 199));
}

struct Rough {
  KOKKOS_FUNCTION void operator()(int i, double (&sum)[2]) const {
    sum[0] += rough(i);
    sum[1] += 1;
  }
};

TEST(OrderedSum, AddsStretchesInTheirOrder) {
  double sum = 0;
  for (int first = 3; first < 2000; first += items_of_sum) {
    double part = 0;
    for (int i = first; i < std::min(first + items_of_sum, 2000); ++i) part += rough(i);
    sum += part;
  }
  const auto sums = ordered_sum<2>("rough", 3, 2000, Rough{});
  EXPECT_EQ(sums[0], sum);
  EXPECT_EQ(sums[1], 1997);
  EXPECT_EQ(ordered_sum<2>("none", 5, 5, Rough{})[1], 0);
}

}  // namespace
}  // namespace mudline
