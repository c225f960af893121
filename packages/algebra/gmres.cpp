#include "algebra/gmres.hpp"

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace mudline {

namespace {

constexpr int most_directions = 60;

/// The orthonormal search directions.
class Basis {
 public:
  void push(const Vector& v, double norm) {
    vectors_.push_back(rcp(new Vector(v.getMap(), false)));
    vectors_.back()->update(1 / norm, v, 0);
  }
  int size() const { return static_cast<int>(vectors_.size()); }
  const Vector& back() const { return *vectors_.back(); }

  /// Subtracts the components along the directions from w and returns them. Classical Gram-Schmidt is applied twice,
  /// which keeps the directions orthogonal to rounding.
  std::vector<double> orthogonalise(Vector& w) const {
    std::vector<double> all(vectors_.size(), 0.0);
    for (int pass = 0; pass < 2; ++pass) {
      const std::vector<double> part = products(w);
      add(part, -1, w);
      for (std::size_t i = 0; i < all.size(); ++i) all[i] += part[i];
    }
    return all;
  }
  /// y += factor * sum_i c_i v_i
  void add(const std::vector<double>& c, double factor, Vector& y) const {
    const auto to = y.getLocalViewHost(Tpetra::Access::ReadWrite);
    const std::vector<Values> from = values(c.size());
    for (std::size_t begin = 0; begin < to.extent(0); begin += chunk)
      for (std::size_t i = 0; i < c.size(); ++i) {
        const double share = factor * c[i];
        const double* const v = from[i].data();
        double* const sum = to.data();
        for (std::size_t k = begin; k < std::min<std::size_t>(begin + chunk, to.extent(0)); ++k) sum[k] += share * v[k];
      }
  }

 private:
  using Values = Vector::dual_view_type::t_host::const_type;
  static constexpr std::size_t chunk = 2048;  // rows per block: they stay in the cache for all directions

  std::vector<Values> values(std::size_t count) const {
    std::vector<Values> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(vectors_[i]->getLocalViewHost(Tpetra::Access::ReadOnly));
    return result;
  }
  std::vector<double> products(const Vector& w) const {
    std::vector<double> here(vectors_.size(), 0.0), result(vectors_.size());
    const auto from = w.getLocalViewHost(Tpetra::Access::ReadOnly);
    const std::vector<Values> with = values(vectors_.size());
    for (std::size_t begin = 0; begin < from.extent(0); begin += chunk)
      for (std::size_t i = 0; i < with.size(); ++i) {
        const double *const v = with[i].data(), *const other = from.data();
        const std::size_t end = std::min<std::size_t>(begin + chunk, from.extent(0));
        double sums[4] = {};  // four partial sums, independent of each other
        std::size_t k = begin;
        for (; k + 4 <= end; k += 4)
          for (int j = 0; j < 4; ++j) sums[j] += v[k + j] * other[k + j];
        for (; k < end; ++k) sums[0] += v[k] * other[k];
        here[i] += (sums[0] + sums[1]) + (sums[2] + sums[3]);
      }
    Teuchos::reduceAll(*w.getMap()->getComm(), Teuchos::REDUCE_SUM, static_cast<int>(here.size()), here.data(),
                       result.data());
    return result;
  }

  std::vector<RCP<Vector>> vectors_;
};

/// The least squares problem of the Hessenberg matrix, column by column, by Givens rotations.
class LeastSquares {
 public:
  explicit LeastSquares(double norm) : right_{norm} {}
  double residual() const { return std::abs(right_.back()); }
  /// Adds a column, of one entry more than there were columns before, and the entry below it.
  void add(std::vector<double> column, double below) {
    for (std::size_t i = 0; i < rotations_.size(); ++i) rotate(rotations_[i], column[i], column[i + 1]);
    const double length = std::hypot(column.back(), below);
    const Rotation rotation = length > 0 ? Rotation{column.back() / length, below / length} : Rotation{1, 0};
    rotations_.push_back(rotation);
    rotate(rotation, column.back(), below);
    right_.push_back(0);
    rotate(rotation, right_[right_.size() - 2], right_.back());
    columns_.push_back(std::move(column));
  }
  std::vector<double> solution() const {
    std::vector<double> y(columns_.size());
    for (std::size_t i = y.size(); i-- > 0;) {
      y[i] = right_[i];
      for (std::size_t j = i + 1; j < y.size(); ++j) y[i] -= columns_[j][i] * y[j];
      y[i] = columns_[i][i] != 0 ? y[i] / columns_[i][i] : 0;
    }
    return y;
  }

 private:
  struct Rotation {
    double cosine, sine;
  };
  static void rotate(const Rotation& r, double& upper, double& lower) {
    const double before = upper;
    upper = r.cosine * before + r.sine * lower;
    lower = r.cosine * lower - r.sine * before;
  }
  std::vector<std::vector<double>> columns_;
  std::vector<Rotation> rotations_;
  std::vector<double> right_;
};

}  // namespace

int gmres(const Operator& matrix, const Operator& preconditioner, const Vector& b, Vector& x, double tolerance,
          int max_iterations) {
  Vector residual(b, Teuchos::Copy), direction(b.getMap());
  x.putScalar(0);
  int iterations = 0;
  double norm = residual.norm2();
  while (norm > tolerance && iterations < max_iterations) {
    Basis basis;
    LeastSquares problem(norm);
    double length = norm;
    while (problem.residual() > tolerance && iterations < max_iterations && basis.size() < most_directions &&
           length > 0) {
      basis.push(residual, length);
      preconditioner.apply(basis.back(), direction);
      matrix.apply(direction, residual);
      const std::vector<double> column = basis.orthogonalise(residual);
      length = residual.norm2();
      problem.add(column, length);
      ++iterations;
    }
    residual.putScalar(0);
    basis.add(problem.solution(), 1, residual);
    preconditioner.apply(residual, direction);
    x.update(1, direction, 1);
    if (!(problem.residual() > tolerance)) break;
    matrix.apply(x, residual);
    residual.update(1, b, -1);
    norm = residual.norm2();
  }
  return iterations;
}

}  // namespace mudline
