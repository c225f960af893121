#pragma once

#include <Kokkos_Macros.hpp>

#include <cmath>

#include "tensor/mat.hpp"
#include "tensor/sym6.hpp"

namespace mudline {

/// Index of the tensor component (i, j) among the six xx yy zz yz xz xy.
KOKKOS_FORCEINLINE_FUNCTION constexpr int six(int i, int j) { return i == j ? i : 6 - i - j; }

/// Objective increment of a motion (Hughes and Winget 1980) from its gradient on the midpoint configuration, H =
/// d(Delta u)/d x_{n+1/2}, and the hoop strain Delta u_r/r_{n+1/2} of axial symmetry: strain = sym H, rotation by (1 -
/// W/2)^-1 (1 + W/2) with the spin W = skew H. A pure rotation gives no strain. The trace of the strain increment is
/// replaced by ln J, so that the skeleton's volume strain is the one that the void ratio and the pore water see,
/// whatever the size of the step. sym H refers to the axes of the midpoint; it is rotated by half the rotation to those
/// of the end, where stress and state are. Otherwise the stress would only be first-order accurate in a step with both
/// strain and rotation.
/// Dim: 2 in the plane, with a separate hoop component for the third direction; 3 in space, without hoop component.
template <int Dim>
struct MidpointRule {
  static constexpr int spins = Dim == 3 ? 3 : 1;       // number of rotation components; in the plane about z only
  static constexpr int components = Dim == 3 ? 6 : 4;  // number of strain components that are not always 0
  /// Index of component k among the six.
  KOKKOS_FORCEINLINE_FUNCTION static constexpr int place(int k) { return Dim == 2 && k == 3 ? 5 : k; }
  /// Component of the tensor component (i, j).
  KOKKOS_FORCEINLINE_FUNCTION static constexpr int number(int i, int j) { return Dim == 2 && i != j ? 3 : six(i, j); }
  /// Further displacements: way Dim j + m has the gradient d(u_j)/d(x_m) = 1 in the configuration of the end, and way
  /// Dim Dim in the plane has u_r / r = 1. Rows have an even number of columns, for pairs in vector instructions.
  static constexpr int ways = Dim * Dim + (Dim == 2 ? 1 : 0), width = ways + ways % 2;

  Mat<double, Dim> gradient;
  double hoop_gradient;  // H
  double spin[spins];    // axial vector of skew H [-]
  Mat<double, Dim> rotation, half;
  Mat<double, Dim> strain;
  double hoop;        // strain increment in tensor components, axes of the end
  double log_volume;  // ln J, J = dv_{n+1} / dv_n

  /// `valid`: the configurations are not inverted; otherwise ln J is 0 and the increment means nothing.
  KOKKOS_FORCEINLINE_FUNCTION void evaluate(const Mat<double, Dim>& H, double hoop_of_H, bool valid) {
    double trace = 0;
    for (int i = 0; i < Dim; ++i) {
      trace += H[i][i];
      for (int j = 0; j < Dim; ++j) {
        gradient[i][j] = H[i][j];
        strain[i][j] = 0.5 * (H[i][j] + H[j][i]);
      }
    }
    hoop = hoop_gradient = hoop_of_H;
    // exactly: dx_{n+1} = (I + H/2) dx_{n+1/2} and dx_n = (I - H/2) dx_{n+1/2}
    const double even = 0.25 * second_invariant(H);
    double odd = 0.5 * trace;
    if constexpr (Dim == 3) odd += 0.125 * determinant(H);
    log_volume = valid ? ::log1p(even + odd) - ::log1p(even - odd) : 0.0;
    if constexpr (Dim == 2)
      if (valid) log_volume += ::log1p(0.5 * hoop) - ::log1p(-0.5 * hoop);
    axial(H, spin);
    double v[spins], square = 0;
    for (int k = 0; k < spins; ++k) {
      v[k] = 0.5 * spin[k];
      square += v[k] * v[k];
    }
    rotation_of_quaternion(1.0, v, square, rotation);
    rotation_of_quaternion(1.0 + ::sqrt(1.0 + square), v, square, half);
    set_volume(strain, hoop, log_volume);
    rotate_half(strain);
  }

  /// The increment as six numbers with engineering shear.
  KOKKOS_FORCEINLINE_FUNCTION void increment(double* e) const { to_six(strain, hoop, e); }

  /// R s R^T of a symmetric tensor xx yy zz yz xz xy with stress-like components.
  KOKKOS_FORCEINLINE_FUNCTION void rotate(const double* s, double* out) const {
    if constexpr (Dim == 3) {
      sym6::rotate(&rotation[0][0], s, out);
    } else {
      const double c = rotation[0][0], n = rotation[1][0], cc = c * c, nn = n * n, cn = c * n;
      out[0] = cc * s[0] - 2 * cn * s[5] + nn * s[1];
      out[1] = nn * s[0] + 2 * cn * s[5] + cc * s[1];
      out[2] = s[2];
      out[3] = n * s[4] + c * s[3];
      out[4] = c * s[4] - n * s[3];
      out[5] = cn * (s[0] - s[1]) + (cc - nn) * s[5];
    }
  }

  /// Changes of the increment for the further displacements, without the part due to the rotation of its own axes:
  /// (component k of place(k), with engineering shear; way), the input of an isotropic tangent. `turn`: their
  /// rotations [-], (spin, way). The last column means nothing where `width` is more than `ways`.
  KOKKOS_FORCEINLINE_FUNCTION void variations(double (&e)[components][width], double (&turn)[spins][width]) const {
    double d[tensors][width], across[width] = {}, dw[spins][width], shift[width];
    vary_gradient(d, dw);
    if constexpr (Dim == 2) across[Dim * Dim] = (1 - 0.5 * hoop_gradient) * (1 + 0.5 * hoop_gradient);
    for (int way = 0; way < width; ++way) {
      const double volume = way % (Dim + 1) == 0 && way < Dim * Dim ? 1.0 : way == Dim * Dim && Dim == 2 ? 1.0 : 0.0;
      double trace = across[way];
      for (int i = 0; i < Dim; ++i) trace += d[i][way];
      shift[way] = (volume - trace) / 3;
    }
    for (int i = 0; i < Dim; ++i)
      for (int way = 0; way < width; ++way) d[i][way] += shift[way];
    // linear in the change d of the strain in the axes of the midpoint, and in the change dw of the spin
    double by_strain[tensors][tensors], by_spin[tensors][spins], turn_by_spin[spins][spins];
    find_half_rotation(by_strain);
    find_spin_rates(turn_by_spin, by_spin);
    for (int t = 0; t < tensors; ++t)
      for (int way = 0; way < width; ++way) {
        double sum = by_spin[t][0] * dw[0][way];
        for (int k = 1; k < spins; ++k) sum += by_spin[t][k] * dw[k][way];
        for (int b = 0; b < tensors; ++b) sum += by_strain[t][b] * d[b][way];
        e[number(row(t), column(t))][way] = row(t) == column(t) ? sum : 2 * sum;
      }
    if constexpr (Dim == 2)
      for (int way = 0; way < width; ++way) e[2][way] = across[way] + shift[way];
    for (int k = 0; k < spins; ++k)
      for (int way = 0; way < width; ++way) {
        turn[k][way] = turn_by_spin[k][0] * dw[0][way];
        for (int l = 1; l < spins; ++l) turn[k][way] += turn_by_spin[k][l] * dw[l][way];
      }
  }

  /// W s - s W of a symmetric tensor of six stress-like components, W the skew tensor of a spin.
  KOKKOS_FORCEINLINE_FUNCTION static void stress_rotation_rate(const double (&w)[spins], const double* s, double* out) {
    Mat<double, Dim> full, change;
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) full[i][j] = s[six(i, j)];
    commute(w, full, change);
    for (int c = 0; c < 6; ++c) out[c] = 0;
    for (int i = 0; i < Dim; ++i)
      for (int j = i; j < Dim; ++j) out[six(i, j)] = change[i][j];
  }

 private:
  /// Symmetric tensors without the component out of the plane: component t is (row(t), column(t)).
  static constexpr int tensors = Dim * (Dim + 1) / 2;
  KOKKOS_FORCEINLINE_FUNCTION static constexpr int row(int t) { return t < Dim ? t : t == 3 ? 1 : 0; }
  KOKKOS_FORCEINLINE_FUNCTION static constexpr int column(int t) { return t < Dim ? t : Dim == 3 && t < 5 ? 2 : 1; }

  KOKKOS_FORCEINLINE_FUNCTION static void axial(const Mat<double, Dim>& a, double (&w)[spins]) {
    if constexpr (Dim == 3) {
      w[0] = 0.5 * (a[2][1] - a[1][2]);
      w[1] = 0.5 * (a[0][2] - a[2][0]);
      w[2] = 0.5 * (a[1][0] - a[0][1]);
    } else {
      w[0] = 0.5 * (a[1][0] - a[0][1]);
    }
  }
  KOKKOS_FORCEINLINE_FUNCTION static void skew(const double (&w)[spins], Mat<double, Dim>& out) {
    const double z = w[spins - 1];
    for (int i = 0; i < Dim; ++i) out[i][i] = 0;
    out[0][1] = -z;
    out[1][0] = z;
    if constexpr (Dim == 3) {
      out[0][2] = w[1];
      out[2][0] = -w[1];
      out[1][2] = -w[0];
      out[2][1] = w[0];
    }
  }
  /// Rotation matrix of the quaternion (s, v), which need not be normalised; square = v.v.
  KOKKOS_FORCEINLINE_FUNCTION static void rotation_of_quaternion(double s, const double (&v)[spins], double square,
                                                                 Mat<double, Dim>& out) {
    Mat<double, Dim> V;
    skew(v, V);
    const double factor = 1.0 / (s * s + square);
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) {
        double sum = (i == j ? s * s - square : 0.0) + 2 * s * V[i][j];
        if constexpr (Dim == 3) sum += 2 * v[i] * v[j];
        out[i][j] = factor * sum;
      }
  }
  /// W a - a W.
  KOKKOS_FORCEINLINE_FUNCTION static void commute(const double (&w)[spins], const Mat<double, Dim>& a,
                                                  Mat<double, Dim>& out) {
    Mat<double, Dim> W;
    skew(w, W);
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) {
        out[i][j] = 0;
        for (int k = 0; k < Dim; ++k) out[i][j] += W[i][k] * a[k][j] - a[i][k] * W[k][j];
      }
  }
  KOKKOS_FORCEINLINE_FUNCTION static void set_volume(Mat<double, Dim>& e, double& out_of_plane, double volume) {
    double trace = Dim == 2 ? out_of_plane : 0.0;
    for (int i = 0; i < Dim; ++i) trace += e[i][i];
    const double shift = (volume - trace) / 3;
    for (int i = 0; i < Dim; ++i) e[i][i] += shift;
    out_of_plane += shift;
  }
  /// Rotates a tensor from the axes of the midpoint to those of the end.
  KOKKOS_FORCEINLINE_FUNCTION void rotate_half(Mat<double, Dim>& e) const {
    Mat<double, Dim> left;
    for (int i = 0; i < Dim; ++i)
      for (int l = 0; l < Dim; ++l) {
        left[i][l] = 0;
        for (int k = 0; k < Dim; ++k) left[i][l] += half[i][k] * e[k][l];
      }
    for (int i = 0; i < Dim; ++i)
      for (int j = 0; j < Dim; ++j) {
        e[i][j] = 0;
        for (int l = 0; l < Dim; ++l) e[i][j] += left[i][l] * half[j][l];
      }
  }
  KOKKOS_FORCEINLINE_FUNCTION static void to_six(const Mat<double, Dim>& e, double out_of_plane, double* out) {
    for (int c = 0; c < 6; ++c) out[c] = 0;
    out[2] = out_of_plane;
    for (int i = 0; i < Dim; ++i) {
      out[i] = e[i][i];
      for (int j = i + 1; j < Dim; ++j) out[six(i, j)] = e[i][j] + e[j][i];
    }
  }
  /// Changes of sym H and of its spin for the further displacements.
  KOKKOS_FORCEINLINE_FUNCTION void vary_gradient(double (&d)[tensors][width], double (&dw)[spins][width]) const {
    // dH = (1 - H/2) G (1 + H/2), exactly: the midpoint moves with half the displacement
    double dH[Dim][Dim][width] = {};
    for (int i = 0; i < Dim; ++i)
      for (int l = 0; l < Dim; ++l)
        for (int j = 0; j < Dim; ++j)
          for (int m = 0; m < Dim; ++m)
            dH[i][l][Dim * j + m] =
                ((i == j ? 1.0 : 0.0) - 0.5 * gradient[i][j]) * ((m == l ? 1.0 : 0.0) + 0.5 * gradient[m][l]);
    for (int t = 0; t < tensors; ++t)
      for (int way = 0; way < width; ++way) {
        const double over = dH[row(t)][column(t)][way], under = dH[column(t)][row(t)][way];
        d[t][way] = 0.5 * (over + under);
      }
    for (int k = 0; k < spins; ++k) {
      const int i = Dim == 3 ? (k + 2) % 3 : 1, l = Dim == 3 ? (k + 1) % 3 : 0;
      for (int way = 0; way < width; ++way) dw[k][way] = 0.5 * (dH[i][l][way] - dH[l][i][way]);
    }
  }
  /// The matrix that rotates a symmetric tensor from the axes of the midpoint to those of the end.
  KOKKOS_FORCEINLINE_FUNCTION void find_half_rotation(double (&matrix)[tensors][tensors]) const {
    for (int t = 0; t < tensors; ++t)
      for (int b = 0; b < tensors; ++b) {
        matrix[t][b] = half[row(t)][row(b)] * half[column(t)][column(b)];
        if (row(b) != column(b)) matrix[t][b] += half[row(t)][column(b)] * half[column(t)][row(b)];
      }
  }
  /// Derivatives by the spin of the rotation, and of the strain, which the half rotation turns less than that.
  KOKKOS_FORCEINLINE_FUNCTION void find_spin_rates(double (&turn)[spins][spins],
                                                   double (&of_strain)[tensors][spins]) const {
    // spin of the rotation of the quaternion (s, v): 2 (s dv - ds v + v x dv) / (s^2 + v.v); of the half rotation too
    double v[spins], square = 0;
    for (int k = 0; k < spins; ++k) {
      v[k] = 0.5 * spin[k];
      square += v[k] * v[k];
    }
    const double root = ::sqrt(1 + square), s = 1 + root;
    const double whole = 2 / (1 + square), part = 2 / (s * s + square);
    for (int l = 0; l < spins; ++l) {  // dv = 1/2 in direction l
      const double ds = 0.5 * v[l] / root;
      double less[spins];
      Mat<double, Dim> change;
      for (int k = 0; k < spins; ++k) {
        const double dv = k == l ? 0.5 : 0.0;
        double cross = 0;
        if constexpr (Dim == 3)
          if (k != l) cross = (l == (k + 2) % 3 ? 0.5 : -0.5) * v[3 - k - l];
        turn[k][l] = whole * (dv + cross);
        less[k] = part * (s * dv - ds * v[k] + cross) - turn[k][l];
      }
      commute(less, strain, change);
      for (int t = 0; t < tensors; ++t) of_strain[t][l] = change[row(t)][column(t)];
    }
  }
};

}  // namespace mudline
