#pragma once

#include <cmath>

namespace mudline {

/// Decides whether the Jacobian of an earlier iteration may serve once more (a chord instead of a tangent). A chord iteration
/// costs a residual and a solve with factors that exist, about a fifth of assembling and factoring; so it pays when the
/// contraction seen so far promises convergence within two or three. Ratios: residual over its tolerance, worst field.
class ChordControl {
 public:
  bool enabled = false;

  /// The matrix no longer belongs to the coming steps (other step size, unknowns, scheme), or must not be relied on.
  void forget() {
    valid_ = false;
    first_contraction_ = 1;
  }
  void start_step() { count_ = 0; }
  void renewed() { valid_ = true; }
  /// The residual of the next iterate.
  void observe(double ratio) {
    if (count_ > 0) contraction_ = ratio / last_;
    if (count_ == 1) first_contraction_ = contraction_;
    last_ = ratio;
    ++count_;
  }
  bool may_keep() const {
    // the first iteration of a step is judged by that of the step before: later ones always contract well
    const double c = count_ <= 1 ? first_contraction_ : contraction_;
    if (!enabled || !valid_ || !(c < 0.1)) return false;
    return last_ <= 1 || std::log(last_) <= -2.5 * std::log(c);
  }

 private:
  bool valid_ = false;
  int count_ = 0;
  double last_ = 0, contraction_ = 1, first_contraction_ = 1;
};

}  // namespace mudline
