#pragma once

#include <array>
#include <string>
#include <vector>

#include "materials/skeleton.hpp"

namespace mudline {

using Six = std::array<double, 6>;

/// Motion of a point in one increment, with signs and order of SkeletonWorkset. Stress and state tensors are first
/// rotated by the angle about z, as in the finite elements (Hughes and Winget 1980).
struct PointMotion {
  Six strain{};
  double cosine = 1.0, sine = 0.0;
};

/// Result of a law for one increment.
struct PointTrial {
  Six stress{};
  std::vector<double> state;
  std::array<double, 36> tangent{};  // row-major, if wanted
  bool ok = false;                   // the law's flag, and only finite numbers
  std::string failure;               // the law's reason, with stress and strain increment
  bool old_untouched = true;         // the law did not change its inputs
  bool flags_agree = true;           // the returned number of failures agrees with the flags
};

/// One material point with its committed state. The void ratio follows the volume strain as in a full run:
/// n = alpha - (alpha - n_old) exp(-ln J), ln J = tr(strain increment).
class MaterialPoint {
 public:
  MaterialPoint(const Skeleton& law, const InitialPoint& start, double biot_coefficient = 1.0);

  /// "" or why the law cannot start here.
  const std::string& refusal() const { return refusal_; }
  const Skeleton& law() const { return law_; }
  const Six& stress() const { return stress_; }
  const std::vector<double>& state() const { return state_; }
  double void_ratio() const { return void_ratio_; }
  double time() const { return time_; }

  /// Evaluates the law; the committed state does not change.
  PointTrial evaluate(const PointMotion& motion, double dt, bool want_tangent) const;
  void commit(const PointMotion& motion, double dt, const PointTrial& trial);
  /// The same point with its stress and its state tensors turned by a rotation (row-major).
  MaterialPoint turned(const std::array<double, 9>& rotation) const;

 private:
  const Skeleton& law_;
  double alpha_, void_ratio_, time_ = 0.0;
  Six stress_;
  std::vector<double> state_;
  std::vector<int> tensors_;  // first components of the tensors of the state
  std::string refusal_;
  Increment increment_;
};

}  // namespace mudline
