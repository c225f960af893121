#include "framework/vector_scatter.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace mudline {
namespace {

/// A chain of elements with two dofs each, neighbours sharing one.
ElementDofs chain(int elements) {
  Kokkos::View<int**, Kokkos::LayoutRight> dofs("dofs", elements, 2);
  for (int e = 0; e < elements; ++e)
    for (int a = 0; a < 2; ++a) dofs(e, a) = e + a;
  return dofs;
}

struct Sums {
  NodalView sum, acting, whole;
  explicit Sums(int dofs) : sum("sum", dofs), acting("acting", dofs), whole("whole", dofs) {}
};

/// Adds two pieces to each row of every element: 10 + e and -e, of which 1 acts.
Sums assemble(int elements, int batch) {
  const Sums sums(elements + 1);
  const ElementDofs dofs = chain(elements);
  const RowLists rows = batch == 0 ? RowLists() : RowLists(dofs, batch);
  std::vector<int> calls;
  in_order("rows", rows, 0, elements, VectorScatter{{sums.sum, sums.acting, sums.whole}, dofs, 2},
           [&](int first, int last, const VectorScatter& to) {
             calls.push_back(last - first);
             for (int e = first; e < last; ++e) {
               to.open(e);
               for (int a = 0; a < 2; ++a) {
                 to.add(e, a, 10 + e, 1, 10 + e, 0);
                 to.add(e, a, -e, 1, e, 1);
               }
             }
           });
  EXPECT_EQ(calls.size(), batch == 0 ? 1u : (elements + batch - 1u) / batch);
  return sums;
}

TEST(VectorScatter, RowsGetTheirSumsAndSizes) {
  constexpr int elements = 7;
  for (const int batch : {0, 1, 3, 7, 20}) {
    const Sums sums = assemble(elements, batch);
    for (int dof = 0; dof <= elements; ++dof) {
      double whole = 0;
      for (const int e : {dof - 1, dof})
        if (e >= 0 && e < elements) whole += 10 + 2 * e;
      const int sharing = dof == 0 || dof == elements ? 1 : 2;
      EXPECT_EQ(sums.sum(dof), 10 * sharing) << batch;
      EXPECT_EQ(sums.acting(dof), 2 * sharing) << batch;
      EXPECT_EQ(sums.whole(dof), whole) << batch;
    }
  }
}

TEST(VectorScatter, ARowThatAnElementSkipsGetsNothing) {
  const ElementDofs dofs = chain(4);
  for (const int batch : {0, 2}) {
    const Sums sums(5);
    const RowLists rows = batch == 0 ? RowLists() : RowLists(dofs, batch);
    in_order("rows", rows, 0, 4, VectorScatter{{sums.sum, sums.acting, sums.whole}, dofs},
             [&](int first, int last, const VectorScatter& to) {
               for (int e = first; e < last; ++e) {
                 to.open(e);
                 if (e != 2) to.add(e, 0, 1 + e, 0, 0);
               }
             });
    const double exact[] = {1, 2, 0, 4, 0};
    for (int dof = 0; dof < 5; ++dof) EXPECT_EQ(sums.sum(dof), exact[dof]) << batch;
  }
}

TEST(ResidualView, KeepsTheSizesOfWhatCancels) {
  const Sums sums(2);
  const ResidualView view(sums.sum, sums.acting, sums.whole);
  view.add(0, 3);
  view.add(0, -5, 1);
  view.add(1, 4, -2);
  view.cancelled(1, 100);
  EXPECT_EQ(sums.sum(0), -2);
  EXPECT_EQ(sums.acting(0), 4);
  EXPECT_EQ(sums.whole(0), 8);
  EXPECT_EQ(sums.acting(1), 2);
  EXPECT_EQ(sums.whole(1), 104);
  const NodalView only("only", 2);
  ResidualView(only).add(1, 7, 1);
  EXPECT_EQ(only(1), 7);
}

}  // namespace
}  // namespace mudline
