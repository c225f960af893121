#pragma once

#include <algorithm>

namespace mudline {

/// Forcing term of an inexact Newton method: the fraction of the residual that an iterative linear solve may leave (S.
/// C. Eisenstat, H. F. Walker, SIAM J. Sci. Comput. 17, 1996, 16-32, their second choice). It follows from the last
/// contraction of the residual below its least value so far: a residual that only returns to what it was has not
/// converged. Ratios: residual over its tolerance, worst field.
class Forcing {
 public:
  double largest = 0.1;  // 0: off

  void start_step() {
    least_ = 0;
    first_ = true;
  }
  /// Forgets the share learnt from earlier steps.
  void forget() { start_ = 1; }
  /// Fraction of the residual that the next linear solve may leave; 0 where forcing is off. ratio: residual ratio of
  /// the iterate.
  double next(double ratio) {
    if (largest == 0 || !(ratio > 0)) return 0;
    if (least_ > 0) {
      const double contraction = ratio / least_;
      // The part of the contraction that the linear solve did not leave is due to curvature. If it is small, the next
      // step starts with a tighter linear solve instead of linearising again.
      if (first_) start_ = contraction > 2 * share_ ? contraction - share_ : square(contraction);
      first_ = false;
      share_ = square(contraction);
    } else {
      share_ = start_;
    }
    least_ = least_ > 0 ? std::min(least_, ratio) : ratio;
    share_ = std::min(largest, std::max(share_, 0.3 / ratio));  // no further than the end of the iteration needs
    return share_;
  }

 private:
  static double square(double contraction) { return 0.9 * contraction * contraction; }
  double least_ = 0, share_ = 0;
  double start_ = 1;  // share of the first iteration of a step, learnt from the previous step
  bool first_ = true;
};

}  // namespace mudline
