#pragma once

#include "materials/point/material_point.hpp"

namespace mudline {

/// Ties strains to one of them: while the component `driver` changes by x, the others change by x `follow` more. What
/// is stress-controlled there is the stress that does work on this, sigma_driver + follow . sigma: at constant volume
/// along y, with follow = (-1/2, 0, -1/2), the stress difference.
struct StrainTie {
  int driver = -1;  // none
  Six follow{};     // 0 for the driver itself

  Six strain(const Six& change) const {
    Six all = change;
    if (driver >= 0)
      for (int c = 0; c < 6; ++c) all[c] += follow[c] * change[driver];
    return all;
  }
  Six stress(const Six& sigma) const {
    Six controlled = sigma;
    if (driver >= 0)
      for (int c = 0; c < 6; ++c) controlled[driver] += follow[c] * sigma[c];
    return controlled;
  }
};

/// One increment under mixed control: each component follows a strain or a stress. Signs and order as in
/// SkeletonWorkset. Strains are logarithmic along fixed axes. Sliding: strain xy is instead the horizontal displacement
/// of the upper face over the *initial* height, the faces y = constant stay parallel to x, and the rotation is part of
/// the motion.
struct PointIncrement {
  std::array<bool, 6> stress_controlled{};
  Six strain{};  // increments of the strain-controlled components
  Six stress{};  // values at the end of the stress-controlled ones [Pa]
  StrainTie tie;
  bool sliding = false;  // not with a tie
  double dt = 0.0;       // [s]
};

/// Drives a material point by Newton's method with the law's own tangent. An increment that does not converge, or that
/// the law refuses, is halved again and again.
class PointControl {
 public:
  explicit PointControl(MaterialPoint& point) : point_(point) {}

  /// False when even the smallest part fails; the point then stands where it got to.
  bool advance(const PointIncrement& increment) { return advance(increment, 0); }

  const MaterialPoint& point() const { return point_; }
  const Six& strain() const { return strain_; }  // accumulated; of a sliding point see PointIncrement
  int iterations() const { return iterations_; }
  int cuts() const { return cuts_; }
  /// What the law answered where it failed last; "" where it never has.
  const std::string& failure() const { return failure_; }

 private:
  bool advance(const PointIncrement& increment, int depth);
  bool solve(const PointIncrement& increment, const Six& guess);
  PointMotion motion_of(const PointIncrement& increment, const Six& change) const;
  bool correct(const PointIncrement& increment, const PointTrial& trial, Six& change) const;

  MaterialPoint& point_;
  Six strain_{}, rate_{};  // rate of the last increment without what is tied, from which the next is guessed [1/s]
  int iterations_ = 0, cuts_ = 0;
  std::string failure_;
};

}  // namespace mudline
