#include "algebra/absolute_product.hpp"

#include <cmath>

namespace mudline {

Vector absolute_product(const CrsMatrix& A, const Vector& x) {
  Vector columns(A.getColMap());
  if (const auto importer = A.getGraph()->getImporter(); !importer.is_null())
    columns.doImport(x, *importer, Tpetra::INSERT);
  else
    Tpetra::deep_copy(columns, x);
  Vector product(A.getRowMap());
  const auto from = columns.getLocalViewHost(Tpetra::Access::ReadOnly);
  auto to = product.getLocalViewHost(Tpetra::Access::OverwriteAll);
  const auto local = A.getLocalMatrixHost();
  for (int row = 0; row < local.numRows(); ++row) {
    double sum = 0;
    for (auto k = local.graph.row_map(row); k < local.graph.row_map(row + 1); ++k)
      sum += std::abs(local.values(k) * from(local.graph.entries(k), 0));
    to(row, 0) = sum;
  }
  return product;
}

}  // namespace mudline
