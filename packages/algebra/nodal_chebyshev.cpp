#include "algebra/nodal_chebyshev.hpp"

#include <Teuchos_LAPACK.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "algebra/tpetra_compat.hpp"

namespace mudline {

namespace {

constexpr int power_iterations = 10;
constexpr double safety = 1.1;  // the power method approaches the largest eigenvalue from below

/// A pseudo-random number between -1 and 1 from an id (splitmix64).
double scattered(GlobalOrdinal id) {
  std::uint64_t z = (static_cast<std::uint64_t>(id) + 1) * 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
}

/// Inverts a block, row by row, in place; a singular one becomes the inverse of its diagonal.
void invert(double* block, int n) {
  std::array<double, 9> factors{};
  std::array<int, 3> pivots{};
  std::array<double, 9> work{};
  std::copy_n(block, n * n, factors.begin());
  int info = 0;
  const Teuchos::LAPACK<int, double> lapack;
  lapack.GETRF(n, n, factors.data(), n, pivots.data(), &info);
  if (info == 0) lapack.GETRI(n, factors.data(), n, pivots.data(), work.data(), n, &info);
  const bool regular =
      info == 0 && std::all_of(factors.begin(), factors.end(), [](double v) { return std::isfinite(v); });
  if (!regular) {
    factors.fill(0);
    for (int i = 0; i < n; ++i) factors[i * n + i] = block[i * n + i] != 0 ? 1 / block[i * n + i] : 1;
  }
  std::copy_n(factors.begin(), n * n, block);
}

}  // namespace

NodalChebyshev::NodalChebyshev(RCP<const NodeMatrix> matrix, const Settings& settings, const std::vector<char>& joined)
    : matrix_(matrix),
      settings_(settings),
      joined_(*matrix, joined),
      residual_(matrix->getDomainMap(), 1),
      step_(matrix->getDomainMap(), 1) {
  invert_blocks();
  largest_ = estimate_largest();
}

void NodalChebyshev::invert_blocks() {
  const int n = matrix_->components();
  inverse_.assign(static_cast<std::size_t>(matrix_->nodes()) * n * n, 0);
  for (int node = 0; node < matrix_->nodes(); ++node) {
    double block[9] = {};
    matrix_->for_each_block(node, [&](int column, const float* values) {
      if (column == node) std::copy_n(values, n * n, block);  // owned columns come first, in the order of the rows
    });
    invert(block, n);
    std::copy_n(block, n * n, &inverse_[static_cast<std::size_t>(node) * n * n]);
  }
  for (const int node : joined_.nodes()) std::fill_n(&inverse_[static_cast<std::size_t>(node) * n * n], n * n, 0.0F);
}

double NodalChebyshev::estimate_largest() const {
  MultiVector x(matrix_->getDomainMap(), 1);
  {
    const auto values = x.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < values.extent(0); ++i)
      values(i, 0) = scattered(matrix_->getDomainMap()->getGlobalElement(static_cast<LocalOrdinal>(i)));
  }
  double norm = x.getVector(0)->norm2();
  for (int iteration = 0; iteration < power_iterations; ++iteration) {
    if (!(norm > 0)) break;
    x.scale(1 / norm);
    matrix_->apply(x, residual_);
    add_inverse(1, residual_, 0, x);
    norm = x.getVector(0)->norm2();
  }
  return norm > 0 && std::isfinite(norm) ? norm : 1;
}

void NodalChebyshev::add_inverse(double factor, const MultiVector& x, double share, MultiVector& y) const {
  const int n = matrix_->components();
  const auto from = x.getLocalViewHost(Tpetra::Access::ReadOnly);
  const auto to = y.getLocalViewHost(Tpetra::Access::ReadWrite);
  const float* block = inverse_.data();
  for (std::size_t first = 0; first < from.extent(0); first += n)
    for (int i = 0; i < n; ++i, block += n) {
      double sum = 0;
      for (int j = 0; j < n; ++j) sum += block[j] * from(first + j, 0);
      to(first + i, 0) = (share == 0 ? 0.0 : share * to(first + i, 0)) + factor * sum;
    }
  if (joined_.nodes().empty()) return;
  auto solution = joined_.solve(x).begin();
  for (const int node : joined_.nodes())
    for (int i = 0; i < n; ++i) to(n * node + i, 0) += factor * *solution++;
}

void NodalChebyshev::apply(const MultiVector& x, MultiVector& y, Teuchos::ETransp, double, double) const {
  // three-term recursion of the residual polynomials on [smallest, largest]
  const double largest = safety * largest_, smallest = largest_ / settings_.ratio;
  const double centre = 0.5 * (largest + smallest), half = 0.5 * (largest - smallest), sigma = centre / half;
  double rho = 1 / sigma;
  add_inverse(1 / centre, x, 0, step_);
  y.update(1, step_, 0);
  for (int k = 1; k < settings_.degree; ++k) {
    residual_.update(1, x, 0);
    matrix_->apply(y, residual_, Teuchos::NO_TRANS, -1, 1);
    const double next = 1 / (2 * sigma - rho);
    add_inverse(2 * next / half, residual_, next * rho, step_);
    y.update(1, step_, 1);
    rho = next;
  }
}

}  // namespace mudline
