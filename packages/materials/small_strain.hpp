#pragma once

#include <vector>

#include "core/parameters.hpp"
#include "materials/skeleton.hpp"
#include "tensor/sym6.hpp"

namespace mudline {

/// Small-strain stiffness of a law with an elastic shear modulus G_ur: bricks on strings (Simpson 1992, Geotechnique
/// 42:541; beside plasticity: Cudny & Truty 2020, Acta Geotechnica 15:2031). In place of the strain increment the law
/// gets one with the same volume and a larger deviator:
///     de* = de + sum_i w_i db_i,    |b_i| <= r_i,  |b| = sqrt(2 b:b)
/// b_i is the strain from brick i to the soil. It grows with the strain until the string, of length r_i, is taut; then
/// the brick is pulled along, and b_i turns towards the direction of the strain. So the elastic response is that of
/// parallel elastic and elastic-plastic springs (Iwan 1967, J. Appl. Mech. 34:612): straight cycles follow Masing's
/// rule at any depth of reversals, and no closed path yields energy. Lengths and weights are those of a polygon through
/// the curve of first loading
///     G/G_0 = 1/(1 + 0.385 (gamma/gamma_0.7)^a)    a = 1: Hardin & Drnevich 1972; Santos & Correia 2001
/// as far as its tangent, G_0 d(gamma G/G_0)/dgamma, is above G_ur = G_0/ratio; beyond, the law is alone.
/// An increment is integrated implicitly, each string by a radial return: exact on straight paths.
/// Strains: tension positive; those of the strings as tensors, xx yy zz yz xz xy, that turn with the material. It is a
/// value that a kernel can hold.
class SmallStrainStiffness {
 public:
  void parameters(Parameters& p);
  /// Sets lengths and weights from the numbers; parameters() has called it unless a number is a function of the place.
  void prepare();
  /// Whether the law has a section of this kind; otherwise the rest is not to be called.
  KOKKOS_INLINE_FUNCTION bool acts() const { return acts_; }
  /// G_0/G_ur [-].
  double ratio() const { return ratio_; }
  /// The strings, then the present shear stiffness over G_ur.
  std::vector<StateVariable> state() const;
  int state_size() const { return 6 * bricks_ + 1; }
  /// Writes the state of soil that has rested.
  void start(double* state) const;

  /// Strain increment (6) that the law gets for `strain` (6), engineering shear; fills `now` from `old` (state_size()),
  /// and unless it is null `derivative` (36): d law_strain_i / d strain_j, row-major.
  KOKKOS_INLINE_FUNCTION void amplify(const double* strain, const double* old, double* now, double* law_strain,
                                      double* derivative) const {
    double e[6], more[6] = {}, slack = 0.0, present = 1.0;
    const double mean = sym6::trace(strain) / 3.0;
    for (int c = 0; c < 6; ++c) e[c] = c < 3 ? strain[c] - mean : 0.5 * strain[c];
    if (derivative)
      for (int c = 0; c < 36; ++c) derivative[c] = c % 7 == 0 ? 1.0 : 0.0;
    for (int i = 0; i < bricks_; ++i, old += 6, now += 6) {
      // a string that came out too long in a transfer is shortened without effect on the stress
      const double before = shortened(old, length_[i]);
      for (int c = 0; c < 6; ++c) now[c] = before * old[c] + e[c];
      const double factor = shortened(now, length_[i]), weight = weight_[i] * factor;
      if (derivative) {
        slack += weight;
        if (factor < 1.0) remove_along(now, weight, derivative);
      }
      for (int c = 0; c < 6; ++c) {
        now[c] *= factor;
        more[c] += weight_[i] * (now[c] - before * old[c]);
      }
      if (!taut(now, length_[i])) present += weight_[i];
    }
    *now = present;
    for (int c = 0; c < 6; ++c) law_strain[c] = strain[c] + (c < 3 ? 1.0 : 2.0) * more[c];
    if (!derivative) return;
    for (int c = 0; c < 6; ++c) derivative[7 * c] += slack;
    for (int c = 0; c < 3; ++c)
      for (int d = 0; d < 3; ++d) derivative[6 * c + d] -= slack / 3.0;
  }

 private:
  static constexpr int most = 40;
  /// Factor that brings a string to its length, 1 where it is slack.
  KOKKOS_INLINE_FUNCTION static double shortened(const double* b, double length) {
    const double squared = 2.0 * sym6::norm_squared(b);
    return squared > length * length ? length / ::sqrt(squared) : 1.0;
  }
  /// Whether a string is at its length, but for rounding.
  KOKKOS_INLINE_FUNCTION static bool taut(const double* b, double length) {
    return 2.0 * sym6::norm_squared(b) > (1.0 - 1e-9) * length * length;
  }
  /// Takes the part along a taut string out of the derivative.
  KOKKOS_INLINE_FUNCTION static void remove_along(const double* b, double weight, double* derivative) {
    const double share = weight / sym6::norm_squared(b);
    for (int c = 0; c < 6; ++c)
      for (int d = 0; d < 6; ++d) derivative[6 * c + d] -= share * (c < 3 ? 1.0 : 2.0) * b[c] * b[d];
  }

  bool acts_ = false;
  double ratio_ = 1.0;             // [-] G_0/G_ur
  double reference_strain_ = 0.0;  // [-] gamma_0.7
  double curvature_ = 1.0;         // [-] a
  int bricks_ = 12;
  double length_[most] = {};  // [-] r
  double weight_[most] = {};  // [-] w
};

}  // namespace mudline
