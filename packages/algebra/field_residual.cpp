#include "algebra/field_residual.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace mudline {

namespace {
constexpr double rounding_floor = 1e-6;  // at a tolerance of 1e-8 this is 100 times the rounding of a product
}

double FieldResidual::relative() const {
  double worst = 0;
  for (std::size_t f = 0; f < norm.size(); ++f) {
    if (norm[f] == 0) continue;
    const double ratio = norm[f] / reference[f];
    if (!(ratio <= worst)) worst = ratio;
    if (std::isnan(worst)) return worst;
  }
  return worst;
}

void FieldResidual::loosen(const LinearTolerance& tolerance) {
  for (std::size_t f = 0; f < tolerance.enough.size(); ++f)
    reference[f] = std::max(reference[f], tolerance.enough[f] / tolerance.relative);
}

FieldResidualEvaluator::FieldResidualEvaluator(RCP<const DofMap> dofs)
    : dofs_(std::move(dofs)), part_(dofs_->owned()), product_(dofs_->owned()) {}

std::vector<double> FieldResidualEvaluator::field_norms(const Vector& v) const {
  const int num_fields = dofs_->num_fields();
  std::vector<double> here(num_fields, 0.0), sums(num_fields);
  const auto values = v.getLocalViewHost(Tpetra::Access::ReadOnly);
  for (int f = 0; f < num_fields; ++f)
    for (int i = dofs_->owned_begin(f); i < dofs_->owned_end(f); ++i) here[f] += values(i, 0) * values(i, 0);
  Teuchos::reduceAll(*dofs_->comm(), Teuchos::REDUCE_SUM, num_fields, here.data(), sums.data());
  for (double& sum : sums) sum = std::sqrt(sum);
  return sums;
}

void FieldResidualEvaluator::absolute_product(const CrsMatrix& matrix, const Vector& x) {
  const RCP<const Import> importer = matrix.getGraph()->getImporter();
  Vector columns(matrix.getColMap());
  if (importer.is_null())
    columns.assign(x);
  else
    columns.doImport(x, *importer, Tpetra::INSERT);
  const auto a = matrix.getLocalMatrixHost();
  const auto from = columns.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = product_.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (int row = 0; row < dofs_->num_owned_dofs(); ++row) {
    double sum = 0;
    for (auto k = a.graph.row_map(row); k < a.graph.row_map(row + 1); ++k)
      sum += std::abs(a.values(k)) * std::abs(from(a.graph.entries(k), 0));
    to(row, 0) = sum;
  }
}

FieldResidual FieldResidualEvaluator::operator()(const CrsMatrix& matrix, const Vector& b, const Vector& x,
                                                 Vector& residual) {
  FieldResidual result;
  result.reference = field_norms(b);
  residual.assign(b);
  for (int g = 0; g < dofs_->num_fields(); ++g) {
    part_.putScalar(0);
    {
      const auto all = x.getLocalViewHost(Tpetra::Access::ReadOnly);
      const auto part = part_.getLocalViewHost(Tpetra::Access::ReadWrite);
      for (int i = dofs_->owned_begin(g); i < dofs_->owned_end(g); ++i) part(i, 0) = all(i, 0);
    }
    matrix.apply(part_, product_);
    residual.update(-1, product_, 1);
    const std::vector<double> terms = field_norms(product_);
    for (std::size_t f = 0; f < terms.size(); ++f) result.reference[f] = std::max(result.reference[f], terms[f]);
  }
  // A uniform pressure or a rigid motion leaves only rounding in A x, and no solver is accurate relative to that. The
  // floor is therefore a small fraction of the products before they cancel, just above their rounding.
  absolute_product(matrix, x);
  const std::vector<double> uncancelled = field_norms(product_);
  for (std::size_t f = 0; f < uncancelled.size(); ++f)
    result.reference[f] = std::max(result.reference[f], rounding_floor * uncancelled[f]);
  result.norm = field_norms(residual);
  return result;
}

}  // namespace mudline
