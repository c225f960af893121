#include "framework/patch_recovery.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "algebra/over_ranks.hpp"
#include "framework/normal_equations.hpp"

namespace mudline {

namespace {

constexpr int most_terms = 10;  // terms of a quadratic polynomial in space

int number_of_terms(int dimension, int degree) {
  return degree == 1 ? 1 + dimension : (dimension + 1) * (dimension + 2) / 2;
}

}  // namespace

PatchRecovery::PatchRecovery(const Mesh& mesh, const NodalExchange& exchange, const ConstCoordinateView& x, int degree,
                             int columns)
    : mesh_(mesh),
      exchange_(exchange),
      x_(x),
      dimension_(mesh.dimension()),
      degree_(degree),
      columns_(columns),
      terms_(number_of_terms(dimension_, degree)),
      width_(1 + terms_ * (terms_ + 1) / 2 + terms_ * columns),
      vertex_(mesh.num_nodes(), -1) {
  if (degree != 1 && degree != 2) throw std::logic_error("a recovered polynomial has the degree 1 or 2");
  for (int node = 0; node < mesh.num_nodes(); ++node)
    if (mesh.is_vertex()[node]) {
      vertex_[node] = static_cast<int>(node_.size());
      node_.push_back(node);
    }
  moments_.assign(node_.size() * width_, 0.0);
}

void PatchRecovery::begin_element(const int* corners, int count) {
  for (int a = 0; a < count; ++a) corners_.push_back(vertex_[corners[a]]);
  ends_.push_back(static_cast<int>(corners_.size()));
}

void PatchRecovery::basis(int vertex, const Point& x, double* powers) const {
  const Point centre = place_of(x_, node_[vertex]);
  double d[3];
  for (int i = 0; i < dimension_; ++i) d[i] = x[i] - centre[i];
  *powers++ = 1;
  for (int i = 0; i < dimension_; ++i) *powers++ = d[i];
  if (degree_ == 2)
    for (int i = 0; i < dimension_; ++i)
      for (int j = i; j < dimension_; ++j) *powers++ = (i == j ? 0.5 : 1.0) * d[i] * d[j];
}

void PatchRecovery::add(const Point& x, const double* values) {
  const int begin = ends_.size() > 1 ? ends_[ends_.size() - 2] : 0;
  double powers[most_terms];
  for (int k = begin; k < ends_.back(); ++k) {
    basis(corners_[k], x, powers);
    double* to = &moments_[static_cast<std::size_t>(corners_[k]) * width_];
    *to++ += 1;
    for (int r = 0; r < terms_; ++r)
      for (int s = r; s < terms_; ++s) *to++ += powers[r] * powers[s];
    for (int c = 0; c < columns_; ++c)
      for (int r = 0; r < terms_; ++r) *to++ += powers[r] * values[c];
  }
}

template <int n>
int PatchRecovery::solve_terms(const double* moments, double* coefficients) const {
  double a[n][n], scale[n];
  const double samples = *moments++;
  for (int r = 0; r < n; ++r)
    for (int s = r; s < n; ++s) a[r][s] = a[s][r] = *moments++;
  for (int r = 0; r < n; ++r) scale[r] = a[r][r] > 0 ? 1 / std::sqrt(a[r][r]) : 0.0;
  // Where all samples lie in planes through the vertex, a product of two offsets is zero or, on a slightly deformed
  // mesh, tiny. Such a term is dropped, because scaling would amplify noise.
  int term = 1 + dimension_;
  if (degree_ == 2)
    for (int i = 0; i < dimension_; ++i)
      for (int j = i; j < dimension_; ++j, ++term)
        if (samples * a[term][term] < 1e-8 * a[1 + i][1 + i] * a[1 + j][1 + j]) scale[term] = 0;
  for (int r = 0; r < n; ++r)
    for (int s = 0; s < n; ++s) a[r][s] *= scale[r] * scale[s];
  std::vector<double> b(moments, moments + n * columns_);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] *= scale[i % n];
  const int resolved = solve_normal<n>(a, b);
  for (std::size_t i = 0; i < b.size(); ++i) coefficients[i] = b[i] * scale[i % n];
  return resolved;
}

int PatchRecovery::solve(const double* moments, double* coefficients) const {
  switch (terms_) {
    case 3:
      return solve_terms<3>(moments, coefficients);
    case 4:
      return solve_terms<4>(moments, coefficients);
    case 6:
      return solve_terms<6>(moments, coefficients);
    default:
      return solve_terms<most_terms>(moments, coefficients);
  }
}

void PatchRecovery::sum_shared(std::vector<double>& rows, int width) const {
  if (mesh_.comm()->getSize() == 1) return;
  std::vector<double> column;
  for (int c = 0; c < width; ++c) {
    column.assign(mesh_.num_nodes(), 0.0);
    for (std::size_t v = 0; v < node_.size(); ++v) column[node_[v]] = rows[v * width + c];
    exchange_.sum_shared(column);
    for (std::size_t v = 0; v < node_.size(); ++v) rows[v * width + c] = column[node_[v]];
  }
}

void PatchRecovery::fit() {
  sum_shared(moments_, width_);
  polynomials_.assign(node_.size() * terms_ * columns_, 0.0);
  std::vector<int> resolved(node_.size(), 0);
  std::vector<int> mine(2, 0);  // terms resolved, samples
  for (std::size_t v = 0; v < node_.size(); ++v) {
    const double* moments = &moments_[v * width_];
    if (moments[0] > 0) resolved[v] = solve(moments, polynomial(static_cast<int>(v)));
    mine[0] = std::max(mine[0], resolved[v]);
    mine[1] = std::max(mine[1], static_cast<int>(moments[0]));
  }
  const std::vector<int> most = max_over_ranks(*mesh_.comm(), mine);
  // With fewer samples than twice the number of terms they lie on one side of the vertex, or the fit follows noise. A
  // mesh one element thick has no more samples, hence the minimum.
  std::vector<char> fitted;
  for (std::size_t v = 0; v < node_.size(); ++v)
    fitted.push_back(resolved[v] == most[0] && moments_[v * width_] >= std::min(2 * terms_, most[1]));
  spread(fitted);
  moments_.clear();
}

void PatchRecovery::recentre(int from, int to, double* coefficients) const {
  const Point a = place_of(x_, node_[from]), b = place_of(x_, node_[to]);
  double d[3] = {}, powers[most_terms];
  for (int i = 0; i < dimension_; ++i) d[i] = b[i] - a[i];
  basis(from, b, powers);
  for (int c = 0; c < columns_; ++c, coefficients += terms_) {
    double value = 0;
    for (int k = 0; k < terms_; ++k) value += powers[k] * coefficients[k];
    coefficients[0] = value;
    int term = 1 + dimension_;
    if (degree_ == 2)
      for (int i = 0; i < dimension_; ++i)
        for (int j = i; j < dimension_; ++j, ++term) {
          coefficients[1 + i] += coefficients[term] * d[j];
          if (j != i) coefficients[1 + j] += coefficients[term] * d[i];
        }
  }
}

void PatchRecovery::spread(std::vector<char>& fitted) {
  const int size = terms_ * columns_;
  for (int layer = 0; layer < 2; ++layer) {
    std::vector<double> sums(node_.size() * (size + 1), 0.0), own(size);
    for (std::size_t e = 0, begin = 0; e < ends_.size(); begin = ends_[e++])
      for (int i = static_cast<int>(begin); i < ends_[e]; ++i) {
        if (fitted[corners_[i]]) continue;
        for (int j = static_cast<int>(begin); j < ends_[e]; ++j) {
          if (!fitted[corners_[j]]) continue;
          std::copy_n(polynomial(corners_[j]), size, own.begin());
          recentre(corners_[j], corners_[i], own.data());
          double* to = &sums[static_cast<std::size_t>(corners_[i]) * (size + 1)];
          to[0] += 1;
          for (int k = 0; k < size; ++k) to[1 + k] += own[k];
        }
      }
    sum_shared(sums, size + 1);
    for (std::size_t v = 0; v < node_.size(); ++v) {
      const double* sum = &sums[v * (size + 1)];
      if (fitted[v] || sum[0] == 0) continue;
      for (int k = 0; k < size; ++k) polynomial(static_cast<int>(v))[k] = sum[1 + k] / sum[0];
      fitted[v] = 1;
    }
  }
}

void PatchRecovery::evaluate(const int* corners, int count, const double* N, const Point& x, double* values,
                             double* gradients) const {
  std::fill_n(values, columns_, 0.0);
  if (gradients != nullptr) std::fill_n(gradients, columns_ * dimension_, 0.0);
  double powers[most_terms];
  for (int a = 0; a < count; ++a) {
    const int vertex = vertex_[corners[a]];
    basis(vertex, x, powers);
    const double* p = polynomial(vertex);
    for (int c = 0; c < columns_; ++c, p += terms_) {
      double value = 0;
      for (int k = 0; k < terms_; ++k) value += powers[k] * p[k];
      values[c] += N[a] * value;
      if (gradients == nullptr) continue;
      double* slope = gradients + c * dimension_;
      for (int i = 0; i < dimension_; ++i) slope[i] += N[a] * p[1 + i];
      int term = 1 + dimension_;
      if (degree_ == 2)
        for (int i = 0; i < dimension_; ++i)
          for (int j = i; j < dimension_; ++j, ++term) {
            slope[i] += N[a] * p[term] * powers[1 + j];
            if (j != i) slope[j] += N[a] * p[term] * powers[1 + i];
          }
    }
  }
}

}  // namespace mudline
