#include "algebra/absolute_product.hpp"

#include <math.h>  // the unqualified functions exist on every device

namespace mudline {

namespace {

template <class Matrix, class From, class To>
struct AbsoluteRow {
  Matrix matrix;
  From x;
  To product;
  KOKKOS_FUNCTION void operator()(int row) const {
    double sum = 0;
    for (auto k = matrix.graph.row_map(row); k < matrix.graph.row_map(row + 1); ++k)
      sum += ::fabs(matrix.values(k) * x(matrix.graph.entries(k), 0));
    product(row, 0) = sum;
  }
};

template <class Matrix, class From, class To>
void multiply(const Matrix& matrix, const From& x, const To& product) {
  Kokkos::parallel_for("absolute product", Kokkos::RangePolicy<>(0, matrix.numRows()),
                       AbsoluteRow<Matrix, From, To>{matrix, x, product});
}

}  // namespace

Vector absolute_product(const CrsMatrix& A, const Vector& x) {
  Vector columns(A.getColMap());
  if (const auto importer = A.getGraph()->getImporter(); !importer.is_null())
    columns.doImport(x, *importer, Tpetra::INSERT);
  else
    Tpetra::deep_copy(columns, x);
  Vector product(A.getRowMap());
  multiply(A.getLocalMatrixDevice(), columns.getLocalViewDevice(Tpetra::Access::ReadOnly),
           product.getLocalViewDevice(Tpetra::Access::OverwriteAll));
  return product;
}

}  // namespace mudline
