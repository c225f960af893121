#pragma once

#include <array>
#include <cmath>

#include "ale/ghosted_mesh.hpp"
#include "tensor/mat.hpp"

namespace mudline {

/// Sets c to the cofactors of a; returns the determinant of a.
template <int Dim>
double cofactors(const Mat<double, Dim>& a, Mat<double, Dim>& c) {
  if constexpr (Dim == 2) {
    c[0][0] = a[1][1];
    c[0][1] = -a[1][0];
    c[1][0] = -a[0][1];
    c[1][1] = a[0][0];
  } else {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        c[i][j] = a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1];
      }
  }
  double det = 0;
  for (int k = 0; k < Dim; ++k) det += a[0][k] * c[0][k];
  return det;
}

/// Edge of the square or cube of this area or volume.
template <int Dim>
double edge_of_content(double content) {
  return Dim == 2 ? std::sqrt(content) : std::cbrt(content);
}

/// Weights w of the map from the ideal simplex, whose corners are `ideal`: T = sum over the corners v of x_v w_v^T.
template <int Dim>
struct IdealSimplex {
  double w[Dim + 1][Dim];
  explicit IdealSimplex(const std::array<Point, Dim + 1>& ideal) {
    Mat<double, Dim> edges, c;
    for (int i = 0; i < Dim; ++i)
      for (int k = 0; k < Dim; ++k) edges[i][k] = ideal[i + 1][k] - ideal[0][k];
    const double det = cofactors(edges, c), scale = edge_of_content<Dim>(std::abs(det));  // size does not count
    for (int k = 0; k < Dim; ++k) {
      w[0][k] = 0;
      for (int v = 1; v <= Dim; ++v) {
        w[v][k] = c[v - 1][k] / det * scale;
        w[0][k] -= w[v][k];
      }
    }
  }
};

/// Sum of the squared inverse mean ratios mu = |T|^2 / (d det T^(2/d)) of the simplices around one vertex, a convex
/// function of its position, and its derivatives; of the Hessian the upper half is set.
template <int Dim>
struct MeanRatio {
  double value = 0, gradient[Dim] = {};
  Mat<double, Dim> hessian = {};
  bool valid = true;  // no simplex is flat or folded

  /// `corner(v)`: position of corner v; `moving`: the corner that is the vertex.
  template <class Corner>
  void add(const IdealSimplex<Dim>& ideal, int moving, const Corner& corner) {
    constexpr double power = 2.0 / Dim;
    Mat<double, Dim> t = {}, c;
    for (int v = 0; v <= Dim; ++v) {
      const Point& x = corner(v);
      for (int i = 0; i < Dim; ++i)
        for (int k = 0; k < Dim; ++k) t[i][k] += x[i] * ideal.w[v][k];
    }
    const double det = cofactors(t, c);
    if (!(det > 0)) {
      valid = false;
      return;
    }
    // det is linear in the position that moves
    const double* w = ideal.w[moving];
    double n = 0, ddn = 0, dn[Dim] = {}, dd[Dim] = {};
    for (int i = 0; i < Dim; ++i) {
      for (int k = 0; k < Dim; ++k) {
        n += t[i][k] * t[i][k];
        dn[i] += t[i][k] * w[k];
        dd[i] += c[i][k] * w[k];
      }
      dn[i] *= 2;
      ddn += w[i] * w[i];
    }
    ddn *= 2;
    const double size = Dim == 2 ? det : std::pow(std::cbrt(det), 2), mu = n / (Dim * size);
    double dmu[Dim];
    for (int i = 0; i < Dim; ++i) dmu[i] = (dn[i] - Dim * mu * (power * size / det) * dd[i]) / (Dim * size);
    const auto second = [&](int i, int j) {
      return ((i == j ? ddn : 0.0) - power * (dn[i] * dd[j] + dd[i] * dn[j]) / det) / (Dim * size) +
             power * (power + 1) / Dim * n * dd[i] * dd[j] / (size * det * det);
    };
    value += mu * mu;
    for (int i = 0; i < Dim; ++i) {
      gradient[i] += 2 * mu * dmu[i];
      for (int j = i; j < Dim; ++j) hessian[i][j] += 2 * mu * second(i, j) + 2 * dmu[i] * dmu[j];
    }
  }

  /// Newton step; returns false where a simplex is folded or the Hessian's determinant is not positive.
  bool step(double (&to)[Dim]) {
    Mat<double, Dim> c;
    for (int i = 1; i < Dim; ++i)
      for (int j = 0; j < i; ++j) hessian[i][j] = hessian[j][i];
    const double det = cofactors(hessian, c);
    for (int i = 0; i < Dim; ++i) {
      double sum = 0;
      for (int k = 0; k < Dim; ++k) sum += c[k][i] * gradient[k];
      to[i] = -sum / det;
    }
    return valid && det > 0;
  }
};

}  // namespace mudline
