#pragma once

#include <cmath>
#include <stdexcept>
#include <vector>

namespace mudline {

/// Decides whether the Jacobian of an earlier iteration may serve once more (a chord instead of a tangent). A chord
/// iteration costs a residual and a solve with factors that exist, about a fifth of assembling and factoring; so it
/// pays when the contraction so far promises convergence within two or three iterations. Ratios: residual over its
/// tolerance, worst field.
class ChordControl {
 public:
  bool enabled = false;

  /// Key: what the matrix depends on apart from the state, that is step size, scheme and free unknowns.
  bool belongs_to(const std::vector<double>& key) const { return key == key_; }
  void start_step(const std::vector<double>& key) {
    key_ = key;
    count_ = 0;
  }
  /// Starts another solve within the step.
  void start_solve() { count_ = 0; }
  /// save() appends all that the next step needs for a checkpoint; restore() reads it and removes it from the end;
  /// std::logic_error if it is incomplete.
  void save(std::vector<double>& to) const {
    to.insert(to.end(), key_.begin(), key_.end());
    to.push_back(valid_ ? 1.0 : 0.0);
    to.push_back(first_contraction_);
    to.push_back(static_cast<double>(key_.size()));
  }
  void restore(std::vector<double>& from) {
    if (from.size() < 3 || !(from.back() >= 0 && from.back() <= static_cast<double>(from.size() - 3)))
      throw std::logic_error("the checkpoint's memory of the last Jacobian is incomplete");
    const auto size = static_cast<std::size_t>(from.back());
    first_contraction_ = from[from.size() - 2];
    valid_ = from[from.size() - 3] != 0;
    key_.assign(from.end() - 3 - size, from.end() - 3);
    from.resize(from.size() - 3 - size);
  }

  /// The matrix no longer belongs to the coming steps (other step size, unknowns, scheme), or must not be relied on.
  void forget() {
    valid_ = false;
    first_contraction_ = 1;
  }
  void refreshed() { valid_ = true; }
  /// Residual ratios of the next iterate and of the one before it, relative to the same tolerance.
  void observe(double ratio, double before) {
    if (count_ > 0) contraction_ = ratio / before;
    if (count_ == 1) first_contraction_ = contraction_;
    last_ = ratio;
    ++count_;
  }
  bool may_reuse() const { return serves(expected_contraction(), last_); }
  /// Whether a new Jacobian is likely to be needed at the next iterate. It is not if the residual, falling at the
  /// present rate, will then have converged or be small enough for the present Jacobian, if that is `usable`.
  bool expects_jacobian(bool usable) const {
    const double c = expected_contraction();
    if (count_ == 0) return !(usable && serves(c, 1));
    return !(last_ * c <= 1) && !(usable && serves(c, last_ * c));
  }

 private:
  /// The first iteration of a step is judged by the first one of the previous step, because later ones always contract
  /// well.
  double expected_contraction() const { return count_ <= 1 ? first_contraction_ : contraction_; }
  bool serves(double contraction, double ratio) const {
    if (!enabled || !valid_ || !(contraction < 0.1)) return false;
    return ratio <= 1 || std::log(ratio) <= -2.5 * std::log(contraction);
  }

  std::vector<double> key_;
  bool valid_ = false;
  int count_ = 0;
  double last_ = 0, contraction_ = 1, first_contraction_ = 1;
};

}  // namespace mudline
