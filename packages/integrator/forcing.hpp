#pragma once

#include <algorithm>

namespace mudline {

/// How much of the residual of a Newton iterate the linear solve of that iteration may leave, where the linear solver
/// is iterative (S. C. Eisenstat, H. F. Walker, SIAM J. Sci. Comput. 17, 1996, 16-32, their second choice): as little
/// as the contraction seen last promises to be of use. Ratios: residual over its tolerance, worst field.
class Forcing {
 public:
  double largest = 0.1;  // 0: off

  void start_step() {
    before_ = 0;
    first_ = true;
  }
  /// Nothing is known of the coming steps.
  void forget() { start_ = 1; }
  /// The share that may be left at the next iterate; 0 where forcing is off.
  double next(double ratio) {
    if (largest == 0 || !(ratio > 0)) return 0;
    if (before_ > 0) {
      const double contraction = ratio / before_;
      // What the linear solve did not leave is curvature. Where there is hardly any, the next step solves further at
      // once instead of linearising again.
      if (first_) start_ = contraction > 2 * share_ ? contraction - share_ : square(contraction);
      first_ = false;
      share_ = square(contraction);
    } else {
      share_ = start_;
    }
    before_ = ratio;
    share_ = std::min(largest, std::max(share_, 0.3 / ratio));  // no further than the end of the iteration needs
    return share_;
  }

 private:
  static double square(double contraction) { return 0.9 * contraction * contraction; }
  double before_ = 0, share_ = 0;
  double start_ = 1;  // share of the first iteration of a step, as learnt from the step before
  bool first_ = true;
};

}  // namespace mudline
