#pragma once

#include <algorithm>

namespace mudline {

/// Share of the elastic stiffness in the tangents of soil laws, where Newton's method fails without it. Such a step
/// often has no solution near its start: a non-associated soil snaps to another equilibrium. With elastic stiffness
/// mixed in, an iterate creeps there in a pseudo time, as a viscous soil would, and the last iterates are Newton's. The
/// pseudo time step grows while the residual falls or changes little, and shrinks where the residual grows
/// ("switched evolution relaxation" of pseudo-transient continuation: C. T. Kelley, D. E. Keyes, SIAM J. Numer. Anal.
/// 35, 1998, 508-523). Ratios: residual over its tolerance, worst field.
class ElasticShare {
 public:
  bool enabled = false;

  void start() { before_ = weight_ = 0; }
  /// The share in [0, 1) for the next iteration; 0: Newton's method as it is. ratio: residual ratio of the iterate.
  double next(double ratio) {
    if (!enabled) return 0;
    constexpr double first = 1, least = 1e-4;        // weights of the elastic stiffness beside the tangent
    constexpr double same = 1.1, easy = 0.8;         // changes of the residual between which it changes little
    constexpr double longer = 0.6, shortest = 10.0;  // factors of the weight: it changes little, it grows at most
    if (!(before_ > 0)) {
      weight_ = first;
    } else {
      const double change = ratio / before_;
      weight_ *= change > same ? std::min(change * change, shortest) : change < easy ? std::max(change, 0.1) : longer;
      if (weight_ < least) weight_ = 0;
    }
    before_ = ratio;
    return weight_ / (1 + weight_);
  }

 private:
  double before_ = 0, weight_ = 0;
};

}  // namespace mudline
